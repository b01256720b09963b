"""Polygons as files hold them, with any number of corners, and the triangles that fill them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.parts import Parts
from shapewright.shapes import Floats, Ints

_REFLEX = 1e-6
"""Share of a polygon's area. A corner that turns back by less spoils no fan that anyone could see."""
MOST_CORNERS = 10_000
"""Of a polygon that is not convex, its holes included. The time to cut one grows with the square: a comb of 10,000
takes .7 s of CPU, one of 50,000 more than a minute."""


@dataclass(frozen=True, eq=False)
class Polygons:
    """The polygons of a file.

    Attributes:
        vertices: (V, 3) float64.
        corners: (C,) int64, the vertices of every polygon, one polygon after the other.
        counts: (P,) int64, the number of corners of each polygon; their sum is C.
        notes: what of the file was left out.
        parts: which part each of the P polygons belongs to; None where the file names none.
    """

    vertices: Floats
    corners: Ints
    counts: Ints
    notes: tuple[str, ...] = ()
    parts: Parts | None = None

    @property
    def parts_of_triangles(self) -> Parts | None:
        """The same of the triangles that fill the polygons."""
        return self.parts and self.parts.repeated(np.maximum(self.counts - 2, 0))


def triangulate(polygons: Polygons) -> Ints:
    """Faces (F, 3) in the order of the polygons: n - 2 for each of n corners, none for points and lines.

    A convex polygon is cut as a fan around its first corner, any other by manifold3d's ear clipping after projection
    along its normal (Newell's). Raises UnreadableError for a corner that points at no vertex, and for a polygon that
    is not convex and has more than MOST_CORNERS.
    """
    vertices, corners, counts = polygons.vertices, polygons.corners, polygons.counts
    check_indices(corners, len(vertices))
    if (counts == 3).all():
        return corners.reshape(-1, 3)
    starts = np.cumsum(counts) - counts
    triangles = np.maximum(counts - 2, 0)
    firsts = np.cumsum(triangles) - triangles
    faces = np.empty((int(triangles.sum()), 3), dtype=np.int64)
    for count in np.unique(counts[counts >= 3]):
        alike = np.flatnonzero(counts == count)
        loops = corners[starts[alike, None] + np.arange(count)]
        cuts = np.stack(np.broadcast_arrays(loops[:, :1], loops[:, 1:-1], loops[:, 2:]), axis=-1)
        if count > 3:
            for i in np.flatnonzero(~_convex(vertices[loops])):
                cuts[i] = loops[i][_clip_ears(vertices[loops[i]])]
        faces[firsts[alike, None] + np.arange(count - 2)] = cuts
    return faces


def triangulate_with_holes(vertices: Floats, loops: Sequence[Ints]) -> Ints:
    """Faces (F, 3) of one polygon with holes: its rim (n,) and then its holes, in either direction, as vertices."""
    rim, *holes = loops
    if len(rim) < 3:
        return np.empty((0, 3), dtype=np.int64)
    plane = _plane(_normals(vertices[rim][None])[0])
    ways = [np.sign(_area(vertices[hole][:, plane])) for hole in holes]
    turned = [rim, *(hole[::-1] if way > 0 else hole for hole, way in zip(holes, ways, strict=True) if len(hole) > 2)]
    return np.concatenate(turned)[_clip([vertices[loop] for loop in turned], plane)]


def check_indices(corners: Ints, vertex_count: int) -> None:
    """Raise UnreadableError where a corner points outside the vertices."""
    if len(corners) and (corners.min() < 0 or corners.max() >= vertex_count):
        raise UnreadableError(f"broken: faces point outside its {vertex_count} vertices")


def _convex(loops: Floats) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Which of the polygons (P, n, 3) turn the same way at every corner; (P,)."""
    with np.errstate(invalid="ignore", over="ignore"):
        edges = np.roll(loops, -1, axis=1) - loops
        turns = np.cross(np.roll(edges, 1, axis=1), edges)
        normals = _normals(loops)
        areas = np.einsum("pi,pi->p", normals, normals)
        reflex = np.einsum("pni,pi->pn", turns, normals) < -_REFLEX * areas[:, None]
    return np.asarray(~reflex.any(axis=1))


def _normals(loops: Floats) -> Floats:
    """Normals (P, 3) of polygons (P, n, 3), twice the area long."""
    spokes = loops - loops[:, :1]
    return np.asarray(np.cross(spokes, np.roll(spokes, -1, axis=1)).sum(axis=1))


def _clip_ears(loop: Floats) -> Ints:
    """Triangles (n - 2, 3) that fill a polygon (n, 3), as indices of its corners."""
    return _clip([loop], _plane(_normals(loop[None])[0]))


def _clip(loops: Sequence[Floats], plane: list[int]) -> Ints:
    """Triangles (T, 3) that fill a polygon and leave its holes open, as indices of all corners in their order."""
    from manifold3d import triangulate as clip

    corners = sum(len(loop) for loop in loops)
    if corners > MOST_CORNERS:
        raise UnreadableError(f"a polygon of {corners:,} corners that is not convex; triangulate it before")
    return np.asarray(clip([np.ascontiguousarray(loop[:, plane]) for loop in loops]), dtype=np.int64)


def _plane(normal: Floats) -> list[int]:
    """The two axes of the plane that a polygon of this normal is seen in, so that it turns left there."""
    across = int(np.argmax(np.abs(normal)))
    plane = [(across + 1) % 3, (across + 2) % 3]
    return plane[::-1] if normal[across] < 0.0 else plane


def _area(loop: Floats) -> float:
    """Of a polygon (n, 2), times two; negative where it turns right."""
    x, y = loop.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
