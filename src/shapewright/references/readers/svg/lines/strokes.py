"""The area that a pen covers along lines: dashes, caps, joins and dots."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import shapely

from shapewright.shapes import Floats

Cap = Literal["butt", "round", "square"]
Join = Literal["miter", "round", "bevel"]
_CAPS: dict[Cap, Literal["flat", "round", "square"]] = {"butt": "flat", "round": "round", "square": "square"}
_ROUND = 16
"""Chords to a quarter of a round cap or join."""
_SMALL_TURN = math.cos(math.radians(7.0))
"""Of directions: a mitre adds less than 0.2 % of half the width where the line turns less, as between chords."""
_RUN = 32
"""Segments that are widened at once: a line that crosses itself costs the square of this."""
_MOST_DASHES = 20_000
_DOT = 1e-5
"""Of half the width: a shorter dash is a dot."""
_UNITED = 4000
"""Points of a stroke up to which its pieces are united."""


@dataclass(frozen=True)
class Stroke:
    """How lines are drawn.

    Attributes:
        width: in the unit of the lines.
        cap: of open ends.
        join: of corners.
        limit: of a mitre's length over the width; beyond it the corner is bevelled.
        dashes: lengths, in turn drawn and not; empty for a whole line.
        offset: into the dashes, where a line begins.
    """

    width: float
    cap: Cap = "butt"
    join: Join = "miter"
    limit: float = 4.0
    dashes: tuple[float, ...] = ()
    offset: float = 0.0


def stroked(lines: Sequence[tuple[Floats, bool]], stroke: Stroke) -> list[Any]:
    """Valid polygons whose union is what the pen covers; the lines are points (N, 2) and whether they are closed."""
    pieces: list[Any] = []
    for line, closed in lines:
        for piece, ring in _dashed(line, closed, stroke):
            pieces += _widened(piece, ring, stroke)
    pieces = [part for part in shapely.get_parts(np.array(pieces, dtype=object)) if not part.is_empty]
    if len(pieces) > 1 and sum(map(shapely.get_num_coordinates, pieces)) < _UNITED:
        return [part for part in shapely.get_parts(shapely.union_all(pieces)) if part.area > 0.0]
    return pieces


def _dashed(line: Floats, closed: bool, stroke: Stroke) -> Iterator[tuple[Floats, bool]]:
    """The pieces of a line that are drawn. One of no length has two points, which tell its direction."""
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
    keep = np.concatenate([[True], steps > 0.0])
    line, steps = line[keep], steps[steps > 0.0]
    total, period = float(steps.sum()), sum(stroke.dashes)
    if not period > 0.0 or total == 0.0 or total / period * len(stroke.dashes) > _MOST_DASHES:
        yield line, closed
        return
    marks = np.concatenate([[0.0], np.cumsum(steps)])
    edges = np.concatenate([[0.0], np.cumsum(stroke.dashes)])
    begin = -(stroke.offset % period)
    while begin < total:
        for start, end in zip(edges[:-1:2], edges[1::2], strict=True):
            low, high = max(begin + start, 0.0), min(begin + end, total)
            if low < high or (low == high and begin + start >= 0.0 and low < total):
                inner = line[(marks > low) & (marks < high)]
                ends = np.stack([np.interp([low, high], marks, line[:, axis]) for axis in (0, 1)], axis=1)
                if low == high:
                    segment = min(int(np.searchsorted(marks, low, "right")) - 1, len(line) - 2)
                    ends[1] = ends[0] + (line[segment + 1] - line[segment]) / steps[segment] * stroke.width * _DOT / 4.0
                yield np.concatenate([ends[:1], inner, ends[1:]]), False
        begin += period


def _widened(line: Floats, closed: bool, stroke: Stroke) -> list[Any]:
    half = stroke.width / 2.0
    if len(line) == 1 or (len(line) == 2 and math.dist(*line) < _DOT * half):
        return _dot(line, stroke)
    ring = closed and len(line) > 3
    looped = np.concatenate([line, line[1:2]]) if ring else line
    join: Any = "round" if stroke.join == "round" else "bevel"
    if len(line) <= _RUN:
        geometry: Any = shapely.LinearRing(line) if ring else shapely.LineString(line)
        pieces = [
            shapely.buffer(
                geometry, half, quad_segs=_ROUND, cap_style="flat" if closed else _CAPS[stroke.cap], join_style=join
            )
        ]
    else:  # each run begins one segment before the last one's end, so that every corner is inside one
        runs = [looped[max(start - 1, 0) : start + _RUN] for start in range(0, len(looped) - 1, _RUN - 1)]
        pieces = [
            shapely.buffer(shapely.LineString(run), half, quad_segs=_ROUND, cap_style="flat", join_style=join)
            for run in runs
        ]
        if not closed:
            pieces += [*_cap(line[0], line[0] - line[1], stroke), *_cap(line[-1], line[-1] - line[-2], stroke)]
    if closed and not ring and stroke.join == "round":
        pieces += [shapely.buffer(shapely.Point(point), half, quad_segs=_ROUND) for point in line]
    if stroke.join == "miter":
        pieces += _mitres(looped, half, stroke.limit)
    return pieces


def _dot(line: Floats, stroke: Stroke) -> list[Any]:
    """What a line of no length covers: its caps, along its direction if it has one."""
    along = line[-1] - line[0] if len(line) > 1 else np.array([1.0, 0.0])
    return [*_cap(line[0], along, stroke), *_cap(line[0], -along, stroke)]


def _cap(end: Floats, along: Floats, stroke: Stroke) -> list[Any]:
    """What a line covers beyond its end."""
    half = stroke.width / 2.0
    if stroke.cap == "round":
        return [shapely.buffer(shapely.Point(end), half, quad_segs=_ROUND)]
    if stroke.cap == "butt":
        return []
    ahead = along / np.linalg.norm(along) * half
    side = ahead[::-1] * [1.0, -1.0]
    return [shapely.Polygon([end + side, end + side + ahead, end - side + ahead, end - side])]


def _mitres(line: Floats, half: float, limit: float) -> list[Any]:
    """The tip of each corner that is within the limit, with the corner itself."""
    steps = np.diff(line, axis=0)
    steps = steps / np.linalg.norm(steps, axis=1, keepdims=True)
    into, out = steps[:-1], steps[1:]
    cosine = (into * out).sum(axis=1)
    sharp = (cosine < _SMALL_TURN) & (cosine > -1.0 + 1e-12)
    sharp &= limit * limit * (1.0 + cosine) >= 2.0 * (1.0 - 1e-9)
    if not sharp.any():
        return []
    at, into, out, cosine = line[1:-1][sharp], into[sharp], out[sharp], cosine[sharp]
    side = np.where(into[:, 0] * out[:, 1] - into[:, 1] * out[:, 0] > 0.0, half, -half)[:, None]
    one, two = into[:, ::-1] * [1.0, -1.0] * side, out[:, ::-1] * [1.0, -1.0] * side
    tip = (one + two) / (1.0 + cosine)[:, None]
    tips: Any = shapely.polygons(np.stack([at, at + one, at + tip, at + two], axis=1))
    return list(tips)
