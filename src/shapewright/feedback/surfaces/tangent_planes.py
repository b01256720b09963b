"""How far points are from a few others that stand for a surface."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from shapewright.shapes import Floats


@njit(nogil=True, cache=True)
def tangent_distances(asked: Floats, points: Floats, normals: Floats, spacing: float) -> Floats:
    """Distances (M,) of points (M, 3) to the tangent planes at the nearest of a few points (N, 3).

    normals: (N, 3), of length 1. A plane stands for the surface up to ``spacing`` from its point.
    """
    away = np.empty(len(asked))
    for n in range(len(asked)):
        least, nearest = np.inf, 0
        for m in range(len(points)):
            x, y, z = asked[n, 0] - points[m, 0], asked[n, 1] - points[m, 1], asked[n, 2] - points[m, 2]
            square = x * x + y * y + z * z
            if square < least:
                least, nearest = square, m
        above = 0.0
        for axis in range(3):
            above += (asked[n, axis] - points[nearest, axis]) * normals[nearest, axis]
        aside = max(math.sqrt(max(least - above * above, 0.0)) - spacing, 0.0)
        away[n] = math.hypot(above, aside)
    return away
