"""Path data: lines and cubic curves, and the polylines that stand for them."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from shapewright.references.readers.svg.coordinates import NUMBER, apply
from shapewright.shapes import Floats

Point = tuple[float, float]
_COMMAND = re.compile(r"([MmZzLlHhVvCcSsQqTtAa])([^MmZzLlHhVvCcSsQqTtAa]*)")
_NUMBER = re.compile(NUMBER)
_CLEAN = re.compile(r"[\s,\d.eE+-]*")
_ARC = re.compile(
    rf"[\s,]*({NUMBER})[\s,]*({NUMBER})[\s,]*({NUMBER})[\s,]*([01])[\s,]*([01])[\s,]*({NUMBER})[\s,]*({NUMBER})"
)
_COUNT = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_FINE = 2000.0
"""A chord departs from its curve by at most the path's extent over this; an arc of 90 degrees gets about 20 chords."""
_MOST = 32
"""Chords to a curve."""


@dataclass(frozen=True, eq=False)
class Path:
    """Parts of lines and cubic curves, K in all, in S parts.

    Attributes:
        cubics: (K, 4, 2), the control points of each piece; the inner ones of a line are its ends.
        straight: (K,) whether a piece is a line.
        corner: (K,) whether a piece ends at a vertex that the path names, not inside an arc.
        first: (S + 1,) where the pieces of each part begin.
        closed: (S,)
    """

    cubics: Floats
    straight: NDArray[np.bool_]
    corner: NDArray[np.bool_]
    first: NDArray[np.int64]
    closed: NDArray[np.bool_]

    def bounds(self) -> Floats:
        """(2, 2): the corners of a box around the path; control points of curves count where they lie outside."""
        lines = [line for line, _ in self.polylines]
        points = np.concatenate(lines) if lines else np.zeros((1, 2))
        return np.stack([points.min(axis=0), points.max(axis=0)])

    def length(self) -> float:
        return sum(float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum()) for line, _ in self.polylines)

    @cached_property
    def polylines(self) -> list[tuple[Floats, bool]]:
        """Each part as points (N, 2) and whether it is closed; a closed one ends where it begins."""
        if not len(self.cubics):
            return []
        points = self.cubics
        if self.straight.all():
            return [self._joined(i, points[:, 3], self.first) for i in range(len(self.closed))]
        bend = np.abs(np.diff(points, 2, axis=1)).max(axis=(1, 2))
        extent = max(float(np.ptp(points, axis=(0, 1)).max()), np.finfo(np.float64).tiny)
        # Wang's bound: a cubic departs from n chords by at most 3/4 of its second differences over n squared.
        count = np.clip(np.ceil(np.sqrt(0.75 * bend * _FINE / extent)), 1, _MOST).astype(np.int64)
        count[self.straight] = 1
        piece = np.repeat(np.arange(len(points)), count)
        ends = np.cumsum(count)
        t = ((np.arange(len(piece)) - (ends - count)[piece] + 1) / count[piece])[:, None]
        p, s = points[piece], 1.0 - t
        curve = s**3 * p[:, 0] + 3 * s * s * t * p[:, 1] + 3 * s * t * t * p[:, 2] + t**3 * p[:, 3]
        curve[ends - 1] = points[:, 3]
        starts = np.concatenate([[0], ends])[self.first]
        return [self._joined(i, curve, starts) for i in range(len(self.closed))]

    def _joined(self, part: int, ends: Floats, starts: NDArray[np.int64]) -> tuple[Floats, bool]:
        """One part, of where it begins and the ends of its chords, and where those of each part begin."""
        begin = self.cubics[self.first[part], :1]
        return np.concatenate([begin, ends[starts[part] : starts[part + 1]]]), bool(self.closed[part])


@dataclass
class Pen:
    """Draws a path. Each method draws from where the last one ended."""

    at: Point = (0.0, 0.0)
    start: Point = (0.0, 0.0)
    fresh: bool = True
    _pieces: list[tuple[float, ...]] = field(default_factory=list)
    _straight: list[bool] = field(default_factory=list)
    _corner: list[bool] = field(default_factory=list)
    _first: list[int] = field(default_factory=list)
    _closed: list[bool] = field(default_factory=list)

    def move(self, to: Point) -> None:
        self.at = self.start = to
        self.fresh = True

    def line(self, to: Point) -> None:
        self._add((*self.at, *self.at, *to, *to), True)
        self.at = to

    def curve(self, one: Point, two: Point, to: Point, corner: bool = True) -> None:
        self._add((*self.at, *one, *two, *to), False, corner)
        self.at = to

    def arc(self, radii: Point, turn: float, large: bool, sweep: bool, to: Point) -> None:
        """An arc of an ellipse whose first radius is turned by an angle in degrees (SVG 2, appendix B.2)."""
        curves = _arc(self.at, radii, turn, large, sweep, to)
        if not curves:
            self.line(to)
        for i, (one, two, end) in enumerate(curves):
            self.curve(one, two, end, i == len(curves) - 1)

    def close(self) -> None:
        self.line(self.start)
        self._closed[-1] = True
        self.fresh = True

    def path(self) -> Path:
        return Path(
            np.array(self._pieces, dtype=np.float64).reshape(-1, 4, 2),
            np.array(self._straight, dtype=bool),
            np.array(self._corner, dtype=bool),
            np.array([*self._first, len(self._pieces)], dtype=np.int64),
            np.array(self._closed, dtype=bool),
        )

    def _add(self, piece: tuple[float, ...], straight: bool, corner: bool = True) -> None:
        if self.fresh:
            self._first.append(len(self._pieces))
            self._closed.append(False)
            self.fresh = False
        self._pieces.append(piece)
        self._straight.append(straight)
        self._corner.append(corner)


def parse(text: str) -> tuple[Path, bool]:
    """The path of the attribute ``d``, and whether all of it was understood; it ends before what was not."""
    pen, last, control = Pen(), "", (0.0, 0.0)
    start = len(text) - len(text.lstrip())
    text = "" if text.strip() == "none" else text
    whole = not text.strip() or text[start] in "Mm"
    for match in _COMMAND.finditer(text, start) if whole else ():
        letter, kind = match[1], match[1].upper()
        rows, clean = _rows(kind, match[2])
        if not last and kind != "M":
            return pen.path(), False
        for i, row in enumerate(rows):
            origin = pen.at if letter.islower() else (0.0, 0.0)
            step = "L" if kind == "M" and i else kind
            if step == last == "Z":
                continue
            control = _drawn(pen, step, row, origin, control if last in _KEEPS.get(step, "") else pen.at)
            last = step
        if not clean or not all(map(math.isfinite, pen.at)):
            return pen.path(), False
    return pen.path(), whole


_KEEPS = {"S": "CS", "T": "QT"}
"""After which commands the control point of a smooth curve is the mirror image of the last one."""


def _rows(kind: str, body: str) -> tuple[list[tuple[float, ...]], bool]:
    """The numbers of each time that a command is carried out, and whether the rest of its text is in order."""
    if kind == "Z":
        return [()], not body.strip(" \t\r\n\f,")
    if kind == "A":
        rows, end = [], 0
        while match := _ARC.match(body, end):
            rows.append(tuple(map(float, match.groups())))
            end = match.end()
        return rows, not body[end:].strip(" \t\r\n\f,") and bool(rows)
    clean = _CLEAN.match(body)
    good = clean.group() if clean else ""
    numbers = list(map(float, _NUMBER.findall(good)))
    count = _COUNT[kind]
    rows = [tuple(numbers[i : i + count]) for i in range(0, len(numbers) - count + 1, count)]
    return rows, len(good) == len(body) and len(numbers) % count == 0 and bool(rows)


def _drawn(pen: Pen, kind: str, row: Sequence[float], origin: Point, control: Point) -> Point:
    """Draws one command; the control point that a smooth curve after it mirrors."""
    dx, dy = origin
    points = [(row[i] + dx, row[i + 1] + dy) for i in range(0, len(row) - 1, 2)] if kind not in "HVA" else []
    mirrored = (2 * pen.at[0] - control[0], 2 * pen.at[1] - control[1])
    match kind:
        case "M":
            pen.move(points[0])
        case "L":
            pen.line(points[0])
        case "H":
            pen.line((row[0] + dx, pen.at[1]))
        case "V":
            pen.line((pen.at[0], row[0] + dy))
        case "C":
            pen.curve(points[0], points[1], points[2])
            return points[1]
        case "S":
            pen.curve(mirrored, points[0], points[1])
            return points[0]
        case "Q" | "T":
            middle = points[0] if kind == "Q" else mirrored
            begin, end = pen.at, points[-1]
            one, two = (tuple((p + 2 * m) / 3 for p, m in zip(side, middle, strict=True)) for side in (begin, end))
            pen.curve((one[0], one[1]), (two[0], two[1]), end)
            return middle
        case "A":
            pen.arc((row[0], row[1]), row[2], row[3] == 1.0, row[4] == 1.0, (row[5] + dx, row[6] + dy))
        case _:
            pen.close()
    return pen.at


def _arc(at: Point, radii: Point, turn: float, large: bool, sweep: bool, to: Point) -> list[tuple[Point, Point, Point]]:
    """Cubic curves of at most 90 degrees, each its controls and its end; they depart by 0.03 % of the radius."""
    rx, ry = abs(radii[0]), abs(radii[1])
    if not (rx > 0.0 and ry > 0.0) or at == to or not all(map(math.isfinite, (*at, *to, rx, ry, turn))):
        return []
    angle = math.radians(turn)
    spin = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    a, b = np.array(at), np.array(to)
    x, y = spin.T @ (a - b) / 2.0
    grow = math.sqrt(max((x / rx) ** 2 + (y / ry) ** 2, 1.0))
    rx, ry = rx * grow, ry * grow
    square = (x / rx) ** 2 + (y / ry) ** 2
    away = math.sqrt(max(1.0 / square - 1.0, 0.0)) * (-1.0 if large == sweep else 1.0)
    cx, cy = away * rx * y / ry, -away * ry * x / rx
    first = math.atan2((y - cy) / ry, (x - cx) / rx)
    delta = math.atan2((-y - cy) / ry, (-x - cx) / rx) - first
    delta += 2 * math.pi if sweep and delta < 0 else -2 * math.pi if not sweep and delta > 0 else 0.0
    count = max(1, math.ceil(abs(delta) / (math.pi / 2) - 1e-9))
    reach = 4 / 3 * math.tan(delta / count / 4)
    angles = first + delta / count * np.arange(count + 1)
    unit, along = np.stack([np.cos(angles), np.sin(angles)], 1), np.stack([-np.sin(angles), np.cos(angles)], 1)
    frame = np.eye(3)
    frame[:2, :2], frame[:2, 2] = spin * [rx, ry], spin @ [cx, cy] + (a + b) / 2.0
    ones, twos = apply(frame, unit[:-1] + reach * along[:-1]), apply(frame, unit[1:] - reach * along[1:])
    ends = apply(frame, unit[1:])
    ends[-1] = to
    return [
        ((float(p[0]), float(p[1])), (float(q[0]), float(q[1])), (float(r[0]), float(r[1])))
        for p, q, r in zip(ones, twos, ends, strict=True)
    ]
