"""The basic shapes as paths, and the vertices of paths, where markers stand."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator

from shapewright.references.readers.svg.coordinates import NUMBER
from shapewright.references.readers.svg.lines import paths
from shapewright.references.readers.svg.lines.paths import Path, Pen
from shapewright.shapes import Floats

Measure = Callable[[str, str], float | None]
"""The length of an attribute, by its name and its axis; None where it is not given, or "auto"."""


def rectangle(left: float, top: float, width: float, height: float, rx: float = 0.0, ry: float = 0.0) -> Path:
    """From its left upper corner, clockwise on a page whose y points down; corners are arcs of the radii."""
    pen, right, bottom = Pen(), left + width, top + height
    rx, ry = min(rx, width / 2), min(ry, height / 2)
    if not (rx > 0.0 and ry > 0.0):
        rx = ry = 0.0
    pen.move((left + rx, top))
    for edge, corner in (
        ((right - rx, top), (right, top + ry)),
        ((right, bottom - ry), (right - rx, bottom)),
        ((left + rx, bottom), (left, bottom - ry)),
        ((left, top + ry), (left + rx, top)),
    ):
        pen.line(edge)
        if rx:
            pen.arc((rx, ry), 0.0, False, True, corner)
    pen.close()
    return pen.path()


def ellipse(cx: float, cy: float, rx: float, ry: float) -> Path:
    """From its rightmost point, clockwise on a page whose y points down."""
    pen = Pen()
    pen.move((cx + rx, cy))
    for end in ((cx, cy + ry), (cx - rx, cy), (cx, cy - ry), (cx + rx, cy)):
        pen.arc((rx, ry), 0.0, False, True, end)
    pen.close()
    return pen.path()


def polygon(text: str, closed: bool) -> tuple[Path, bool]:
    """Of the attribute ``points``, and whether it was in order; a last number without a partner is left out."""
    numbers = [float(number) for number in re.findall(NUMBER, text)]
    points = list(zip(numbers[::2], numbers[1::2], strict=False))
    pen = Pen()
    if points:
        pen.move(points[0])
        for point in points[1:]:
            pen.line(point)
        if closed and len(points) > 1:
            pen.close()
    return pen.path(), len(numbers) % 2 == 0 and not re.sub(rf"{NUMBER}|[\s,]", "", text)


def outline(kind: str, measure: Measure, text: str) -> tuple[Path | None, bool]:
    """The path of a shape and whether it was in order; None where the shape has no size and is not drawn.

    ``text`` is the attribute ``d`` of a path, ``points`` of polygons.
    """

    def given(name: str, axis: str) -> float:
        return measure(name, axis) or 0.0

    match kind:
        case "rect":
            width, height = given("width", "x"), given("height", "y")
            rx, ry = measure("rx", "x"), measure("ry", "y")
            rx, ry = (None if r is None or r < 0.0 else r for r in (rx, ry))
            rx, ry = (ry if rx is None else rx) or 0.0, (rx if ry is None else ry) or 0.0
            if not (width > 0.0 and height > 0.0):
                return None, True
            return rectangle(given("x", "x"), given("y", "y"), width, height, rx, ry), True
        case "circle" | "ellipse":
            rx, ry = (measure("r", ""),) * 2 if kind == "circle" else (measure("rx", "x"), measure("ry", "y"))
            rx, ry = (None if r is None or r < 0.0 else r for r in (rx, ry))
            rx, ry = (ry if rx is None else rx) or 0.0, (rx if ry is None else ry) or 0.0
            return (ellipse(given("cx", "x"), given("cy", "y"), rx, ry) if min(rx, ry) > 0.0 else None), True
        case "line":
            pen = Pen()
            pen.move((given("x1", "x"), given("y1", "y")))
            pen.line((given("x2", "x"), given("y2", "y")))
            return pen.path(), True
        case "polygon" | "polyline":
            return polygon(text, kind == "polygon")
    return paths.parse(text)


def vertices(path: Path) -> Iterator[tuple[str, Floats, float]]:
    """For each vertex: "start", "mid" or "end", its place (2,), and the direction of the path in degrees.

    The direction is that of the line before and after it in equal parts (SVG 2, "Path directionality").
    """
    if not len(path.cubics):
        return
    found: list[tuple[Floats, float | None, float | None]] = []
    for i in range(len(path.closed)):
        begin, end = int(path.first[i]), int(path.first[i + 1])
        pieces, corners = path.cubics[begin:end], path.corner[begin:end]
        into = [_direction(piece[::-1] * -1.0) for piece in pieces]
        out = [_direction(piece) for piece in pieces]
        ends = [k for k in range(len(pieces)) if corners[k]]
        found.append((pieces[0, 0], into[-1] if path.closed[i] else None, out[0]))
        found += [(pieces[k, 3], into[k], out[k + 1] if k + 1 < len(pieces) else None) for k in ends]
        if path.closed[i]:
            found[-1] = (pieces[-1, 3], into[-1], out[0])
    last = len(found) - 1
    for i, (place, before, after) in enumerate(found):
        yield "start" if i == 0 else "end" if i == last else "mid", place, _between(before, after)


def _direction(piece: Floats) -> float | None:
    """The angle at the beginning of a piece, in degrees; None for one of no length."""
    for point in piece[1:]:
        dx, dy = point - piece[0]
        if dx or dy:
            return math.degrees(math.atan2(dy, dx))
    return None


def _between(before: float | None, after: float | None) -> float:
    if before is None or after is None:
        return (before if after is None else after) or 0.0
    if abs(before - after) > 180.0:
        before, after = (before + 360.0, after) if before < after else (before, after + 360.0)
    return (before + after) / 2.0
