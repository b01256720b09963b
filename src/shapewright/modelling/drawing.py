"""Drawings to write procedures with: lines, arcs, polygons, boxes, circles, ellipses; black on white.

The plane has x to the right and y up, in units of your own. Boxes, circles and ellipses take the ``size`` that they
fill (width and height; one number for two equal ones), and ``at``, where their centre goes. Lines have a width:

    top = box((1, 0.06), at=(0, 0.7))
    leg = line((0.4, 0), (0.45, 0.7), width=0.05)
    table = top | leg.mirror("x", keep=True)

Angles are degrees, counter-clockwise. A Sketch never changes: each verb returns a new one, and so do the operators
``|`` (union), ``-`` (cut) and ``&`` (what two have in common). docs/modelling.md shows everything here in pictures.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias, cast

import numpy as np
import shapely
from numpy.typing import ArrayLike
from shapely import affinity

from shapewright.modelling import arguments
from shapewright.modelling.arguments import number, positive
from shapewright.modelling.curves import bezier, spline
from shapewright.shapes import Drawing, Floats

__all__ = ["Sketch", "arc", "bezier", "box", "circle", "ellipse", "line", "polygon", "polyline", "spline", "union"]

Point: TypeAlias = Sequence[float] | Floats
Axis: TypeAlias = Literal["x", "y"]
ORIGIN = (0.0, 0.0)
_GRID = -32  # corners are rounded to this power of two of the largest extent
_MITRE = 5.0  # a corner keeps its point up to this many half widths away


@dataclass(frozen=True, slots=True, eq=False)
class Sketch:
    """An area of the plane, possibly empty, that a procedure may return.

    geometry: wrap any shapely geometry with an area as ``Sketch(geometry)``.
    """

    geometry: Any

    def __or__(self, other: Sketch) -> Sketch:
        """Union."""
        return Sketch(self.geometry.union(other.geometry)) if isinstance(other, Sketch) else NotImplemented

    def __sub__(self, other: Sketch) -> Sketch:
        """Difference."""
        return Sketch(self.geometry.difference(other.geometry)) if isinstance(other, Sketch) else NotImplemented

    def __and__(self, other: Sketch) -> Sketch:
        """Intersection."""
        return Sketch(self.geometry.intersection(other.geometry)) if isinstance(other, Sketch) else NotImplemented

    def translate(self, by: Point) -> Sketch:
        return self._moved((1.0, 1.0), _point("translate", "by", by))

    def rotate(self, degrees: float, about: Point = ORIGIN) -> Sketch:
        turn, centre = number("rotate", "degrees", degrees), _point("rotate", "about", about)
        return Sketch(affinity.rotate(self.geometry, turn, origin=centre))

    def scale(self, factor: float | Point, about: Point = ORIGIN) -> Sketch:
        """Larger or smaller by a positive factor, or by one along x and one along y."""
        factors, centre = _size("scale", factor, "factor"), _point("scale", "about", about)
        return self._moved(factors, (centre[0] * (1.0 - factors[0]), centre[1] * (1.0 - factors[1])))

    def mirror(self, axis: Axis, keep: bool = False, about: Point = ORIGIN) -> Sketch:
        """The mirror image along an axis ("x": left and right change places); ``keep`` unites it with the original."""
        if axis not in ("x", "y"):
            raise ValueError(f"mirror: axis={axis!r} must be 'x' or 'y'")
        x, y = _point("mirror", "about", about)
        image = self._moved((-1.0, 1.0), (2.0 * x, 0.0)) if axis == "x" else self._moved((1.0, -1.0), (0.0, 2.0 * y))
        return self | image if keep else image

    def array(self, count: int, step: Point) -> Sketch:
        """The union of ``count`` copies, each ``step`` further than the one before, from where this one is."""
        x, y = _point("array", "step", step)
        return union(*(self.translate((i * x, i * y)) for i in range(arguments.count("array", count, 1))))

    def polar_array(self, count: int, about: Point = ORIGIN) -> Sketch:
        """The union of ``count`` copies spread evenly around a point, the first of them where this one is."""
        copies = arguments.count("polar_array", count, 1)
        return union(*(self.rotate(360.0 * i / copies, about) for i in range(copies)))

    def fill(self) -> Sketch:
        """The area and everything that it encloses: without its holes."""
        outlines = [shapely.Polygon(part.exterior) for part in shapely.get_parts(self.geometry) if part.area > 0.0]
        return Sketch(shapely.union_all(outlines))

    def grow(self, by: float, round: bool = False) -> Sketch:
        """Wider by so much on every side, or narrower where it is negative; ``round`` rounds the corners."""
        return Sketch(_buffer(self.geometry, number("grow", "by", by), round))

    @property
    def bounds(self) -> Floats:
        """(2, 2): the least and the greatest corner. NaN where there is nothing."""
        return np.asarray(self.geometry.bounds, dtype=np.float64).reshape(2, 2)

    @property
    def area(self) -> float:
        return float(self.geometry.area)

    def drawing(self) -> Drawing:
        """The drawing that a procedure's result is made into. Raises ValueError when there is nothing to see.

        Parts that are meant to touch are joined even where rounding has left them a hair apart.
        """
        if self.geometry.geom_type == "Polygon":
            return Drawing(self.geometry)
        parts = [part for part in shapely.get_parts(self.geometry) if part.area > 0.0]
        grid = 2.0 ** math.floor(math.log2(np.ptp(self.bounds, axis=0).max()) + _GRID) if parts else None
        return Drawing(cast("shapely.Polygon | shapely.MultiPolygon", shapely.union_all(parts, grid_size=grid)))

    def _moved(self, factors: tuple[float, float], by: tuple[float, float]) -> Sketch:
        scale, shift = np.array(factors), np.array(by)
        return Sketch(shapely.transform(self.geometry, lambda points: points * scale + shift))


def line(start: Point, end: Point, width: float, round: bool = False) -> Sketch:
    """A straight line; ``round`` gives it round ends."""
    return polyline([_point("line", "start", start), _point("line", "end", end)], width, round)


def polyline(points: ArrayLike, width: float, round: bool = False, closed: bool = False) -> Sketch:
    """A line through points (N, 2), pointed at the corners; ``round`` rounds corners and ends.

    ``bezier`` and ``spline`` give the points of smooth lines.
    """
    through = _points("polyline", points, 2)
    path = shapely.LinearRing(through) if closed and len(through) > 2 else shapely.LineString(through)
    return Sketch(_buffer(path, positive("polyline", "width", width) / 2.0, round))


def arc(
    size: float | Point,
    start: float,
    end: float,
    width: float,
    at: Point = ORIGIN,
    round: bool = False,
    segments: int = 64,
) -> Sketch:
    """Part of an ellipse's outline as a line, from one angle to another; 0 is to the right, 90 up.

    size: of the whole ellipse through the middle of the line; segments: of a whole turn.
    """
    (w, h), (x, y) = _size("arc", size), _point("arc", "at", at)
    first, last = (math.radians(number("arc", name, value)) for name, value in (("start", start), ("end", end)))
    if not 0.0 < last - first <= 2.0 * math.pi + 1e-9:
        raise ValueError(f"arc: start={start!r}, end={end!r}: end must be greater than start, by 360 at most")
    pieces = max(1, math.ceil(arguments.count("arc", segments, 3, "segments") * (last - first) / (2.0 * math.pi)))
    turn = np.linspace(first, last, pieces + 1)
    whole = last - first > 2.0 * math.pi - 1e-9
    points = np.stack([x + w / 2.0 * np.cos(turn), y + h / 2.0 * np.sin(turn)], axis=1)
    return polyline(points[:-1] if whole else points, positive("arc", "width", width), round, closed=whole)


def polygon(*rings: ArrayLike, width: float | None = None) -> Sketch:
    """The area in a ring of points (N, 2); of several rings, one inside another is a hole.

    width, here and below: only the rim is drawn, so wide, inside the outline.
    """
    area: Any = shapely.Polygon()
    for ring in rings:
        inside: Any = shapely.Polygon(_points("polygon", ring, 3))
        area = shapely.symmetric_difference(area, inside if inside.is_valid else shapely.make_valid(inside))
    return _rim("polygon", area, width)


def box(size: float | Point, at: Point = ORIGIN, radius: float = 0.0, width: float | None = None) -> Sketch:
    """Upright; ``radius`` rounds its corners."""
    (w, h), (x, y) = _size("box", size), _point("box", "at", at)
    r = number("box", "radius", radius)
    if not 0.0 <= r <= min(w, h) / 2.0:
        raise ValueError(f"box: radius={radius!r} must lie in 0..{min(w, h) / 2:g}, half the shorter side")
    corners = [(x + i * (w / 2.0 - r), y + j * (h / 2.0 - r)) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return _rim("box", shapely.MultiPoint(corners).convex_hull.buffer(r) if r else shapely.Polygon(corners), width)


def circle(size: float, at: Point = ORIGIN, width: float | None = None, segments: int = 64) -> Sketch:
    """size: its diameter."""
    return ellipse(positive("circle", "size", size), at, width, segments)


def ellipse(size: float | Point, at: Point = ORIGIN, width: float | None = None, segments: int = 64) -> Sketch:
    (w, h), (x, y) = _size("ellipse", size), _point("ellipse", "at", at)
    turn = np.arange(arguments.count("ellipse", segments, 3, "segments")) * (2.0 * math.pi / segments)
    points = np.stack([x + w / 2.0 * np.cos(turn), y + h / 2.0 * np.sin(turn)], axis=1)
    return _rim("ellipse", shapely.Polygon(points), width)


def union(*sketches: Sketch) -> Sketch:
    """All of them together; nothing at all where there are none."""
    return Sketch(shapely.union_all([sketch.geometry for sketch in sketches]))


def _rim(function: str, area: Any, width: float | None) -> Sketch:
    """The whole area, or its rim."""
    if width is None:
        return Sketch(area)
    return Sketch(area.difference(_buffer(area, -positive(function, "width", width), False)))


def _buffer(geometry: Any, by: float, round: bool) -> Any:
    pointed = {} if round else {"cap_style": "flat", "join_style": "mitre", "mitre_limit": _MITRE}
    return geometry.buffer(by, **pointed)


def _points(function: str, points: ArrayLike, least: int) -> Floats:
    table = np.asarray(points, dtype=np.float64)
    if table.ndim != 2 or table.shape[1] != 2 or len(table) < least or not np.isfinite(table).all():
        raise ValueError(f"{function}: it takes at least {least} finite points (x, y), not {table.tolist()!r}")
    return table


def _point(function: str, name: str, value: Point) -> tuple[float, float]:
    if np.shape(value) != (2,):
        raise ValueError(f"{function}: {name}={value!r} must be two numbers (x, y)")
    return number(function, name, value[0]), number(function, name, value[1])


def _size(function: str, value: float | Point, name: str = "size") -> tuple[float, float]:
    w, h = _point(function, name, value if np.ndim(value) else (value, value))  # type: ignore[arg-type]
    if min(w, h) <= 0.0:
        raise ValueError(f"{function}: {name}={value!r} must be positive")
    return w, h
