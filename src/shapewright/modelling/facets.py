"""Surfaces under deformations: cut first where they will bend, as often as the curvature needs and no more.

A surface is convex polygons: points (V, 3); corners (C,), indices of points; starts (P + 1,), where in ``corners`` each
polygon begins; owners (P,), numbers that say where a polygon came from and survive the cuts.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numba import njit

from shapewright.modelling.curves import knots
from shapewright.modelling.deformation import Bend, Bulge, Deformation, Free, Scale, Shift, Turn
from shapewright.shapes import Floats, Ints
from shapewright.shapes.slivers import SLIVER

_SAMPLES = 25  # between two breaks of a deformation, to see how much it curves there
_STEPS = np.linspace(0.0, 1.0, _SAMPLES)
_SNAP = 0.25  # of the distance to the next cut: how far a cut may move to a level that points have already
_NINE = np.array([(0.0, u, v) for u in (0.0, 0.5, 1.0) for v in (0.0, 0.5, 1.0)])


@dataclass(frozen=True, eq=False)
class Surface:
    """Convex polygons that know their owners; see the module."""

    points: Floats
    corners: Ints
    starts: Ints
    owners: Ints

    @classmethod
    def of_triangles(cls, points: Floats, faces: Ints, owners: Ints) -> Surface:
        return cls(points, np.ascontiguousarray(faces.ravel()), np.arange(0, 3 * len(faces) + 1, 3), owners)

    def cut(self, axis: int, coordinates: Iterable[float]) -> Surface:
        """The same surface with its polygons cut along the planes at these coordinates of an axis.

        A point within a millionth of the extent of a plane counts as on it.
        """
        points, corners, starts, owners = self.points, self.corners, self.starts, self.owners
        least = SLIVER * float(np.ptp(points, axis=0).max())
        for coordinate in coordinates:
            points, corners, starts, owners = _cut(points, corners, starts, owners, axis, float(coordinate), least)
        return Surface(points, corners, starts, owners)

    def triangles(self) -> tuple[Ints, Ints]:
        """Faces (F, 3) and the owner of each (F,); of a quadrilateral's diagonals the shorter is taken."""
        faces, owners = _triangulate(self.points, self.corners, self.starts, self.owners)
        return faces, owners


def deformed(surface: Surface, deformations: Sequence[Deformation], tolerance: float) -> Surface:
    """A surface after all deformations, the first first, cut so that it stays within ``tolerance`` of the true one.

    Between cuts points are moved as if what is straight along the axis stayed so: then facets are flat, whatever other
    points lie on them.
    """
    low, high = surface.points.min(axis=0), surface.points.max(axis=0)
    margin = SLIVER * float((high - low).max())
    creases = [
        (axis, at)
        for deformation in deformations
        for axis, at in _breaks(deformation)
        if low[axis] + margin < at < high[axis] - margin
    ]
    grid: list[tuple[int, Floats]] = []
    for axis in sorted({*_curved(deformations), *(axis for axis, _ in creases)}):
        inside = sorted({c for a, c in creases if a == axis})
        ends = [float(low[axis]), *inside, float(high[axis])]
        lines = _lines(low, high, axis, ends)
        curves = _moved(lines.reshape(-1, 3), deformations, []).reshape(lines.shape)
        planes = set(inside)
        for curve, (start, end) in zip(curves, pairwise(ends), strict=True):
            planes.update(start + (end - start) * t for t in knots(curve, tolerance))
        cuts = _snapped(sorted(planes), surface.points[:, axis], inside)
        surface = surface.cut(axis, cuts)
        grid.append((axis, np.array([ends[0], *cuts, ends[-1]])))
    return replace(surface, points=_moved(surface.points, deformations, grid))


def _moved(points: Floats, deformations: Sequence[Deformation], grid: Sequence[tuple[int, Floats]]) -> Floats:
    """Points after all deformations, linear between the places of a grid along each of its axes."""
    if not grid:
        for deformation in deformations:
            points = deformation(points)
        return points
    (axis, places), *rest = grid
    after = np.clip(np.searchsorted(places, points[:, axis]), 1, len(places) - 1)
    near, far = points.copy(), points.copy()
    near[:, axis], far[:, axis] = places[after - 1], places[after]
    part = ((points[:, axis] - near[:, axis]) / (far[:, axis] - near[:, axis]))[:, None]
    start, end = np.split(_moved(np.concatenate([near, far]), deformations, rest), 2)
    return np.where(part == 1.0, end, start + part * (end - start))  # exact at both ends, and where they are equal


def _curved(deformations: Sequence[Deformation]) -> tuple[int, ...]:
    """The axes along which straight lines may become curves."""
    axes: tuple[int, ...] = ()
    for i, deformation in enumerate(deformations):
        curves = _curves(deformation)
        if curves and any(isinstance(earlier, Turn | Bend | Free) for earlier in deformations[:i]):
            return (0, 1, 2)
        axes += curves
    return axes


def _curves(deformation: Deformation) -> tuple[int, ...]:
    """The axes along which straight lines inside the domain become curves."""
    match deformation:
        case Turn() | Scale(factors=(_, _)) | Shift(offsets=(_, _)):
            return ()
        case Bulge(along=along):
            return along.across
        case Free():
            return (0, 1, 2)
        case _:
            return (deformation.along.axis,)


def _breaks(deformation: Deformation) -> tuple[tuple[int, float], ...]:
    """Where a deformation has a crease, or a peak that the facets should not cut off: (axis, coordinate)."""
    match deformation:
        case Turn() | Free():
            return ()
        case Bulge(along=along, low=low, high=high):
            places = [(low[i], (low[i] + high[i]) / 2.0, high[i]) for i in range(2)]
            return tuple((d, at) for d, along_d in zip(along.across, places, strict=True) for at in along_d)
        case _:
            along = deformation.along
            return (along.axis, along.start), (along.axis, along.start + along.length)


def _lines(low: Floats, high: Floats, axis: int, ends: Sequence[float]) -> Floats:
    """(K, S, 9, 3): points from each of K + 1 places along an axis to the next, on nine lines through a box."""
    order = ([0, 1, 2], [1, 0, 2], [1, 2, 0])[axis]
    lines = np.empty((len(ends) - 1, _SAMPLES, 9, 3))
    lines[:] = _NINE[:, order] * (high - low) + low
    lines[..., axis] = (np.array(ends)[:-1, None] + np.diff(ends)[:, None] * _STEPS)[..., None]
    return lines


def _snapped(planes: list[float], levels: Floats, fixed: Sequence[float]) -> list[float]:
    """The planes, each moved to a level that points already have if that is near: so that no thin strip arises."""
    if not planes:
        return []
    present = np.unique(levels)
    edges = [present[0], *planes, present[-1]]
    result: dict[float, None] = {}
    for before, plane, after in zip(edges, planes, edges[2:], strict=False):
        nearest = float(present[np.abs(present - plane).argmin()])
        near = abs(nearest - plane) < _SNAP * min(plane - before, after - plane)
        result[nearest if near and plane not in fixed else plane] = None
    return [plane for plane in result if present[0] < plane < present[-1]]


@njit(nogil=True, cache=True)
def _cut(points: Any, corners: Any, starts: Any, owners: Any, axis: int, at: float, least: float) -> Any:
    room = 1
    while room < 2 * len(corners):
        room *= 2
    keys, middles = np.full(room, -1, dtype=np.int64), np.empty(room, dtype=np.int64)
    new_points = np.empty((len(points) + len(corners), 3))
    new_points[: len(points)] = points
    total = len(points)
    new_corners = np.empty(len(corners) + 4 * len(owners), dtype=np.int64)
    new_starts = np.empty(2 * len(owners) + 1, dtype=np.int64)
    new_owners = np.empty(2 * len(owners), dtype=np.int64)
    new_starts[0] = filled = polygons = 0
    for p in range(len(owners)):
        below = above = False
        for k in range(starts[p], starts[p + 1]):
            below |= points[corners[k], axis] < at - least
            above |= points[corners[k], axis] > at + least
        for side in (-1.0, 1.0):
            if (side < 0.0 and not below) or (side > 0.0 and not above and below):
                continue
            a = corners[starts[p + 1] - 1]
            for k in range(starts[p], starts[p + 1]):
                b = corners[k]
                height_a, height_b = _height(points[a, axis] - at, least), _height(points[b, axis] - at, least)
                if below and above and height_a * height_b < 0.0:
                    slot = _slot(keys, min(a, b) * len(points) + max(a, b))
                    if keys[slot] < 0:
                        keys[slot], middles[slot] = min(a, b) * len(points) + max(a, b), total
                        _meet(points, min(a, b), max(a, b), axis, at, new_points, total)
                        total += 1
                    new_corners[filled] = middles[slot]
                    filled += 1
                if not (below and above) or height_b * side >= 0.0:
                    new_corners[filled] = b
                    filled += 1
                a = b
            new_owners[polygons] = owners[p]
            polygons += 1
            new_starts[polygons] = filled
    return new_points[:total], new_corners[:filled], new_starts[: polygons + 1], new_owners[:polygons]


@njit(nogil=True, cache=True)
def _height(height: float, least: float) -> float:
    return height if abs(height) > least else 0.0


@njit(nogil=True, cache=True)
def _slot(keys: Any, key: int) -> int:
    """Where a key is in a table of open addresses, or would be put; a free place holds -1."""
    slot = (key * 0x9E3779B1) & (len(keys) - 1)
    while keys[slot] >= 0 and keys[slot] != key:
        slot = (slot + 1) & (len(keys) - 1)
    return slot


@njit(nogil=True, cache=True)
def _meet(points: Any, a: int, b: int, axis: int, at: float, new_points: Any, index: int) -> None:
    t = (at - points[a, axis]) / (points[b, axis] - points[a, axis])
    for d in range(3):
        new_points[index, d] = (
            points[a, d] if points[a, d] == points[b, d] else (points[a, d] * (1.0 - t) + points[b, d] * t)
        )
    new_points[index, axis] = at


@njit(nogil=True, cache=True)
def _triangulate(points: Any, corners: Any, starts: Any, owners: Any) -> Any:
    faces = np.empty((len(corners) - 2 * len(owners), 3), dtype=np.int64)
    face_owners = np.empty(len(faces), dtype=np.int64)
    total = 0
    for p in range(len(owners)):
        low, high = starts[p], starts[p + 1] - 1
        if high - low == 3 and _longer(points, corners[low + 1], corners[high], corners[low], corners[low + 2]):
            for a, b, c in ((low, low + 1, low + 2), (low, low + 2, high)):
                faces[total, 0], faces[total, 1], faces[total, 2] = corners[a], corners[b], corners[c]
                face_owners[total] = owners[p]
                total += 1
            continue
        # A strip to and fro across the polygon: triangles less thin than those of a fan.
        near = True
        while high - low >= 2:
            middle = low + 1 if near else high - 1
            faces[total, 0], faces[total, 1], faces[total, 2] = corners[low], corners[middle], corners[high]
            face_owners[total] = owners[p]
            total += 1
            low, high = (middle, high) if near else (low, middle)
            near = not near
    return faces, face_owners


@njit(nogil=True, cache=True)
def _longer(points: Any, a: int, b: int, c: int, d: int) -> bool:
    """Whether a and b are further apart than c and d, by more than rounding."""
    first = second = 0.0
    for k in range(3):
        first += (points[a, k] - points[b, k]) ** 2
        second += (points[c, k] - points[d, k]) ** 2
    return first > second * (1.0 + 1e-12)
