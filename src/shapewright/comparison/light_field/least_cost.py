"""The least cost of matching two light field descriptors, over the rotations that align their dodecahedra.

Chen et al. 2003, section 3.2. All kernels take coefficients with their weights multiplied in, as uint16 while a sum of
ten costs fits (ART of 4 bits), as int32 otherwise. Differences are taken as max - min: unlike abs(a - b) that stays in
the narrow type, sixteen or more to an instruction.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from shapewright.comparison.light_field.coefficients import COEFFICIENTS
from shapewright.comparison.light_field.contours import FOURIER
from shapewright.comparison.light_field.dodecahedra import LIGHT_FIELDS, VIEWS
from shapewright.comparison.light_field.regions import ART
from shapewright.shapes import Ints

Weighted = NDArray[Any]

_SILHOUETTES = VIEWS * LIGHT_FIELDS
WEIGHTS = np.repeat([1, 2, 2, 1], [ART, FOURIER, 1, 1])
"""Of each of the 47 coefficients."""
_MOST = int(np.iinfo(np.int32).max)


def weighted(coefficients: NDArray[np.uint8], bits: int) -> Weighted:
    """Quantised coefficients (..., 47) times their weights; bits: those of ART, 4 or 8."""
    return np.asarray(coefficients * WEIGHTS.astype(np.uint16 if bits == 4 else np.int32))


def by_coefficient(coefficients: Weighted) -> Weighted:
    """Coefficients (light field, view, 47) as (47, 100), silhouettes in the order 10 * view + light field."""
    return np.ascontiguousarray(coefficients.T).reshape(COEFFICIENTS, _SILHOUETTES)


@njit(nogil=True, cache=True)
def least_of_all(shape: Weighted, others: Weighted, alignments: Ints, least: NDArray[np.int32]) -> None:
    """The least cost of a shape (47, 100) against N others (N, 47, 100), over all fields and alignments (K, 10)."""
    costs = np.empty((_SILHOUETTES, _SILHOUETTES), shape.dtype)
    by_views = np.empty((VIEWS, VIEWS, LIGHT_FIELDS, LIGHT_FIELDS), shape.dtype)
    sums = np.empty(LIGHT_FIELDS**2, shape.dtype)
    for n in range(len(others)):
        _silhouette_costs(shape, others[n], costs)
        _group_by_views(costs.reshape(VIEWS, LIGHT_FIELDS, VIEWS, LIGHT_FIELDS), by_views)
        least[n] = _least_sum(by_views.reshape(VIEWS, VIEWS, LIGHT_FIELDS**2), alignments, sums)


@njit(nogil=True, cache=True)
def _silhouette_costs(shape: Weighted, other: Weighted, costs: Weighted) -> None:
    for x in range(_SILHOUETTES):
        for y in range(_SILHOUETTES):
            costs[x, y] = 0
        for c in range(COEFFICIENTS):
            a = shape[c, x]
            for y in range(_SILHOUETTES):
                b = other[c, y]
                costs[x, y] += max(a, b) - min(a, b)


@njit(nogil=True, cache=True)
def _group_by_views(costs: Weighted, by_views: Weighted) -> None:
    """(view a, field a, view b, field b) to (view a, view b, field a, field b): all fields are summed at once."""
    for m in range(VIEWS):
        for i in range(LIGHT_FIELDS):
            for n in range(VIEWS):
                for j in range(LIGHT_FIELDS):
                    by_views[m, n, i, j] = costs[m, i, n, j]


@njit(nogil=True, cache=True)
def _least_sum(costs: Weighted, alignments: Ints, sums: Weighted) -> int:
    best = _MOST
    for k in range(len(alignments)):
        for x in range(LIGHT_FIELDS**2):
            sums[x] = 0
        for m in range(VIEWS):
            view = alignments[k, m]
            for x in range(LIGHT_FIELDS**2):
                sums[x] += costs[m, view, x]
        for x in range(LIGHT_FIELDS**2):
            best = min(best, int(sums[x]))
    return best


@njit(nogil=True, cache=True)
def least_of_some(
    shape: Weighted, others: Weighted, alignments: Ints, rotations: Ints, least: NDArray[np.int32]
) -> None:
    """The least cost of a shape (10, 10, 47) against N others (N, 10, 10, 47), over R rotations only.

    rotations: (R, 3), the light field of the shape, that of the other, and the alignment.
    """
    differences = np.empty(COEFFICIENTS, shape.dtype)
    for n in range(len(others)):
        best = _MOST
        for r in range(len(rotations)):
            i, j, k = rotations[r]
            for c in range(COEFFICIENTS):
                differences[c] = 0
            for m in range(VIEWS):
                view = alignments[k, m]
                for c in range(COEFFICIENTS):
                    a, b = shape[i, m, c], others[n, j, view, c]
                    differences[c] += max(a, b) - min(a, b)
            cost = np.int64(0)
            for c in range(COEFFICIENTS):
                cost += differences[c]
            best = min(best, int(cost))
        least[n] = best
