"""Sections: closed outlines in the plane, of which sweeps make solids; common ones, and the cleaning of any."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from manifold3d import triangulate
from numpy.typing import ArrayLike

from shapewright.modelling.arguments import count, number, positive
from shapewright.shapes import Floats, Ints

Polygon: TypeAlias = Any
"""Points (N, 2); or several such rings, of which one inside another is a hole; or a shapely Polygon or MultiPolygon."""


@dataclass(frozen=True, eq=False)
class Section:
    """Rings that enclose an area, which lies to their left: outlines counter-clockwise, holes clockwise."""

    rings: tuple[Floats, ...]

    @property
    def points(self) -> Floats:
        """(P, 2): the points of all rings, one ring after the other."""
        return np.concatenate(self.rings)

    @property
    def edges(self) -> Ints:
        """(P, 2): indices of the ends of each edge."""
        starts = np.cumsum([0, *(len(ring) for ring in self.rings)])
        parts = [start + np.arange(len(ring)) for start, ring in zip(starts, self.rings, strict=False)]
        return np.concatenate([np.stack([part, np.roll(part, -1)], axis=1) for part in parts])

    def triangles(self) -> Ints:
        """(T, 3): indices of the points of counter-clockwise triangles that fill the area."""
        return np.asarray(triangulate([np.ascontiguousarray(ring) for ring in self.rings]), dtype=np.int64)


def rectangle(width: float, depth: float, radius: float = 0.0, segments: int = 4) -> Floats:
    """(N, 2): a rectangle about the origin; ``radius`` rounds its corners, by ``segments`` edges each.

    Raises ValueError for a radius of more than half the width or depth.
    """
    u, v = positive("rectangle", "width", width) / 2.0, positive("rectangle", "depth", depth) / 2.0
    r = number("rectangle", "radius", radius)
    if not 0.0 <= r <= min(u, v):
        raise ValueError(f"rectangle: radius={radius!r} must lie in 0..{min(u, v):g}, half the shorter side")
    if r == 0.0:
        return np.array([(u, -v), (u, v), (-u, v), (-u, -v)])
    turn = np.linspace(0.0, math.pi / 2.0, count("rectangle", segments, 1, "segments") + 1)
    arc = r * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    arc[0, 1] = arc[-1, 0] = 0.0
    corners = []
    for x, y in ((1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)):
        corner = np.array([x, y]) * (arc + np.array([u - r, v - r]))
        corners.append(corner if x * y > 0.0 else corner[::-1])
    return without_repeats(np.concatenate(corners))


def ellipse(width: float, depth: float, segments: int = 32) -> Floats:
    """(N, 2): an ellipse about the origin, its first point on +x."""
    u, v = positive("ellipse", "width", width) / 2.0, positive("ellipse", "depth", depth) / 2.0
    turn = np.arange(count("ellipse", segments, 3, "segments")) * (2.0 * math.pi / segments)
    return np.stack([u * np.cos(turn), v * np.sin(turn)], axis=1)


def section(function: str, polygon: Polygon) -> Section:
    """Any polygon as a Section, in double precision; rings that cross or lie in one another count by even and odd.

    Raises ValueError, naming the function, for fewer than three points, points that are not finite, and no area.
    """
    rings: list[Floats] = []
    for ring in _rings(polygon):
        points = np.asarray(ring, dtype=np.float64)
        if points.ndim != 2 or points.shape[1] != 2 or len(points) < 3 or not np.isfinite(points).all():
            raise ValueError(f"{function}: a polygon is at least three finite points (N, 2), not {points.tolist()!r}")
        rings.append(without_repeats(points))
    if len(rings) == 1 and len(rings[0]) >= 3 and _is_simple(rings[0]):
        return Section((rings[0] if area(rings[0]) > 0.0 else rings[0][::-1],))
    return Section(_even_odd(function, rings))


def area(ring: Floats) -> float:
    """The area in a ring, negative if it is clockwise."""
    x, y = ring[:, 0] - ring[0, 0], ring[:, 1] - ring[0, 1]
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2.0)


def without_repeats(ring: Floats) -> Floats:
    """The ring without points that equal the one before them."""
    return np.asarray(ring[(ring != np.roll(ring, 1, axis=0)).any(axis=1)])


def _is_simple(ring: Floats) -> bool:
    """Whether the ring does not meet itself.

    It does not where it is convex: where every corner turns the same way, and once around in all.
    """
    edges = np.roll(ring, -1, axis=0) - ring
    after = np.roll(edges, -1, axis=0)
    cross, dot = edges[:, 0] * after[:, 1] - edges[:, 1] * after[:, 0], (edges * after).sum(axis=1)
    turns = np.arctan2(cross, dot)
    alike = bool((turns >= 0.0).all() or (turns <= 0.0).all()) and bool(np.any(cross))
    if alike and abs(abs(float(turns.sum())) - 2.0 * math.pi) < 1e-6:
        return True
    import shapely

    return bool(shapely.is_valid(shapely.Polygon(ring)))


def _even_odd(function: str, rings: Sequence[Floats]) -> tuple[Floats, ...]:
    import shapely

    whole: Any = shapely.Polygon()
    for ring in rings:
        if len(ring) >= 3:
            simple = shapely.Polygon(ring)
            whole = whole.symmetric_difference(simple if simple.is_valid else shapely.make_valid(simple))
    result = []
    for part in shapely.get_parts(whole):
        if part.geom_type == "Polygon" and part.area > 0.0:
            for i, ring in enumerate((part.exterior, *part.interiors)):
                points = without_repeats(np.asarray(ring.coords)[:-1])
                result.append(points if (area(points) > 0.0) == (i == 0) else points[::-1])
    if not result:
        raise ValueError(f"{function}: the polygon has no area")
    return tuple(result)


def _rings(polygon: Polygon) -> Sequence[ArrayLike]:
    if hasattr(polygon, "geom_type"):
        parts = getattr(polygon, "geoms", [polygon])
        return [ring.coords[:-1] for part in parts for ring in (part.exterior, *part.interiors)]
    points = list(polygon)
    return points if points and np.ndim(points[0]) == 2 else [points]
