"""Points of a surface sorted into cubic cells: how far others are from it, as long as they are near."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import njit

from shapewright.shapes import Floats, Ints

_SIDE = 0.08  # of a cell, least: a little more than the distances that are asked for
_MOST = 32  # cells along an axis


@dataclass(frozen=True, eq=False)
class Cells:
    """Points of a surface by cell."""

    points: Floats  # (N, 3), in the order of their cells
    normals: Floats  # (N, 3)
    starts: Ints  # (cells + 1,), the first point of each cell
    low: Floats  # (3,), the corner of the first cell
    side: float  # of a cell
    shape: Ints  # (3,), cells along each axis

    @classmethod
    def of(cls, points: Floats, normals: Floats) -> Cells:
        low = points.min(axis=0)
        extent = points.max(axis=0) - low
        side = max(_SIDE, float(extent.max()) / _MOST)
        shape = (extent / side).astype(np.int64) + 1
        starts, order = _sorted(points, low, side, shape)
        return cls(points[order], normals[order], starts, low, side, shape)

    def distance(self, points: Floats, spacing: float, most: float) -> Floats:
        """Distance (M,) of points (M, 3) to the tangent plane of the nearest point, ``most`` where it is more.

        A plane stands for the surface up to ``spacing`` from its point.
        """
        cells = self.points, self.normals, self.starts, self.low, self.side, self.shape
        return _distances(points, *cells, spacing, most)


@njit(nogil=True, cache=True)
def _sorted(points: Floats, low: Floats, side: float, shape: Ints) -> tuple[Ints, Ints]:
    """The first point of each cell, and the points in the order of their cells."""
    cells = np.empty(len(points), np.int64)
    starts = np.zeros(shape[0] * shape[1] * shape[2] + 1, np.int64)
    for n in range(len(points)):
        cell = 0
        for axis in range(3):
            cell = cell * shape[axis] + min(int((points[n, axis] - low[axis]) / side), shape[axis] - 1)
        cells[n] = cell
        starts[cell + 1] += 1
    starts = np.cumsum(starts)
    free, order = starts.copy(), np.empty(len(points), np.int64)
    for n in range(len(points)):
        order[free[cells[n]]] = n
        free[cells[n]] += 1
    return starts, order


@njit(nogil=True, cache=True)
def _distances(
    asked: Floats,
    points: Floats,
    normals: Floats,
    starts: Ints,
    low: Floats,
    side: float,
    shape: Ints,
    spacing: float,
    most: float,
) -> Floats:
    """See ``Cells.distance``. A plane is nearer than its point by ``spacing`` at most: no point farther counts."""
    reach, away = most + spacing, np.empty(len(asked))
    first, last = np.empty(3, np.int64), np.empty(3, np.int64)
    for n in range(len(asked)):
        for axis in range(3):
            place = asked[n, axis] - low[axis]
            first[axis] = max(math.floor((place - reach) / side), 0)
            last[axis] = min(math.floor((place + reach) / side), shape[axis] - 1)
        least, nearest = reach * reach, -1
        for i in range(first[0], last[0] + 1):
            for j in range(first[1], last[1] + 1):
                row = (i * shape[1] + j) * shape[2]
                if first[2] > last[2]:
                    continue
                for m in range(starts[row + first[2]], starts[row + last[2] + 1]):
                    x, y, z = asked[n, 0] - points[m, 0], asked[n, 1] - points[m, 1], asked[n, 2] - points[m, 2]
                    square = x * x + y * y + z * z
                    if square < least:
                        least, nearest = square, m
        away[n] = most
        if nearest >= 0:
            above = 0.0
            for axis in range(3):
                above += (asked[n, axis] - points[nearest, axis]) * normals[nearest, axis]
            aside = max(math.sqrt(max(least - above * above, 0.0)) - spacing, 0.0)
            away[n] = min(math.hypot(above, aside), most)
    return away
