"""Region coefficients of silhouettes: the angular radial transform (ART), circularity and eccentricity.

Chen et al. 2003, section 4.1, after the region shape descriptor of MPEG-7, with the table of the authors' program.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from shapewright.rendering.silhouettes import SIZE
from shapewright.shapes import Bytes, Floats, Ints

Runs = NDArray[np.int32]

ART = 35
"""Coefficients of the transform: 12 angular times 3 radial orders, without the first, which is always 1."""

_ANGULAR, _RADIAL = 12, 3
_RADIUS = 50  # of the disc that a silhouette is mapped to, in cells of the table of the ART basis
_GRID = 2 * _RADIUS + 2
_EIGHT_ZEROS, _EIGHT_ONES = np.uint64(0), np.uint64(0x0101010101010101)
_TERMS = _ANGULAR // 2 * _RADIAL  # of each kind of symmetry


def quadrant_basis() -> tuple[Ints, Floats]:
    """Cells (N, 2) of the quarter disc, row and column offsets >= 0, and the basis there (N, 4, 18).

    The basis cos(pi q r / 50) exp(i p theta), theta = atan2(row, column), is even or odd in the row and in the column,
    so four symmetric sums of the four quadrants' weights replace the whole disc: the real and imaginary parts of
    even p (the second axis: 0 and 2), and of odd p (1 and 3). Cells on an axis count half: they are in two quadrants.
    """
    rows, columns = np.mgrid[:_RADIUS, :_RADIUS].reshape(2, -1)
    radius = np.hypot(rows, columns)
    inside = radius < _RADIUS
    rows, columns, radius = rows[inside], columns[inside], radius[inside]
    share = np.where(rows == 0, 0.5, 1.0) * np.where(columns == 0, 0.5, 1.0)
    p = np.arange(_ANGULAR)
    phase = np.arctan2(rows, columns)[:, None] * p
    radial = np.cos(np.pi * radius[:, None] * np.arange(_RADIAL) / _RADIUS) * share[:, None]
    parts = np.stack([np.cos(phase), np.sin(phase)], axis=1)[..., None] * radial[:, None, None, :]
    basis = np.stack([parts[:, part, parity::2] for part in (0, 1) for parity in (0, 1)], axis=1)
    return np.stack([rows, columns], axis=-1), np.ascontiguousarray(basis.reshape(len(rows), 4, _TERMS))


CELLS, BASIS = quadrant_basis()


@njit(nogil=True, cache=True)
def region_coefficients(
    images: Bytes, cells: Ints, basis: Floats, boxes: Ints, art: Floats, circularity: Floats, eccentricity: Floats
) -> None:
    """Coefficients of the V silhouettes (V, 256, 256) of one light field, which share a scale; an empty one has zeros.

    cells, basis: ``CELLS`` and ``BASIS`` (a kernel that holds large tables itself cannot be cached on disk).
    Writes boxes (V, 4): first row, row after the last, first column, column after the last, all 0 if there are none;
    art (V, 35), circularity (V,) and eccentricity (V,), all in [0, 1].
    """
    views = len(images)
    runs = np.empty((views, SIZE * SIZE // 2, 3), np.int32)
    counts = np.empty(views, np.int64)
    farthest = 0.0
    for v in range(views):
        counts[v] = _find_runs(images[v], runs[v])
        farthest = max(farthest, _bound(runs[v, : counts[v]], boxes[v]))
    scale = _RADIUS / farthest if farthest > 0.0 else 0.0
    weights = np.zeros((views, _GRID, _GRID))
    areas = np.zeros(views)
    circularity[:], eccentricity[:] = 0.0, 0.0
    for v in range(views):
        if counts[v] > 0:
            row, column = _middle(boxes[v])
            _spread(runs[v, : counts[v]], row, column, scale, weights[v])
            areas[v], eccentricity[v] = _area_and_eccentricity(runs[v, : counts[v]], row, column)
            circularity[v] = min(1.0, 4.0 * math.pi * areas[v] / (areas[v] - _inner_pixels(images[v], boxes[v])) ** 2)
    _transform(weights, areas, cells, basis, art)


@njit(nogil=True, cache=True)
def _find_runs(image: Bytes, runs: Runs) -> int:
    """Write (row, first column, column after the last) of each run of foreground in a row; returns how many."""
    eights = image.view(np.uint64)
    count = 0
    for row in range(SIZE):
        inside = False
        for n in range(SIZE // 8):
            if eights[row, n] == (_EIGHT_ONES if inside else _EIGHT_ZEROS):
                continue
            for column in range(8 * n, 8 * n + 8):
                if (image[row, column] != 0) != inside:
                    if inside:
                        runs[count, 2] = column
                        count += 1
                    else:
                        runs[count, 0], runs[count, 1] = row, column
                    inside = not inside
    return count


@njit(nogil=True, cache=True)
def _bound(runs: Runs, box: Ints) -> float:
    """Write the box of the runs; returns the distance from its middle to the farthest foreground pixel."""
    box[:] = 0
    if len(runs) == 0:
        return 0.0
    box[0], box[1] = runs[0, 0], runs[-1, 0] + 1
    box[2], box[3] = runs[:, 1].min(), runs[:, 2].max()
    row, column = _middle(box)
    farthest = 0.0
    for n in range(len(runs)):
        across = max(column - runs[n, 1], runs[n, 2] - 1 - column)
        farthest = max(farthest, (runs[n, 0] - row) ** 2 + across**2)
    return math.sqrt(farthest)


@njit(nogil=True, cache=True)
def _middle(box: Ints) -> tuple[float, float]:
    return 0.5 * (box[0] + box[1] - 1), 0.5 * (box[2] + box[3] - 1)


@njit(nogil=True, cache=True)
def _spread(runs: Runs, row: float, column: float, scale: float, grid: Floats) -> None:
    """Share out each foreground pixel among the four cells around the place that it is mapped to.

    The sum of a table's bilinear interpolations at all pixels is the sum of the table under these weights.
    """
    cells = np.empty(SIZE, np.uint32)
    shares = np.empty(SIZE)
    for c in range(SIZE):
        place = max((c - column) * scale + _RADIUS, 0.0)
        cells[c] = int(place)
        shares[c] = place - cells[c]
    line = np.zeros(_GRID)
    for n in range(len(runs)):
        for c in range(max(runs[n, 1], 0), runs[n, 2]):
            line[cells[c]] += 1.0 - shares[c]
            line[cells[c] + 1] += shares[c]
        if n + 1 == len(runs) or runs[n + 1, 0] != runs[n, 0]:
            place = (runs[n, 0] - row) * scale + _RADIUS
            cell = int(place)
            lower, upper = grid[cell], grid[cell + 1]
            share = place - cell
            for x in range(_GRID):
                lower[x] += (1.0 - share) * line[x]
                upper[x] += share * line[x]
            line[:] = 0.0


@njit(nogil=True, cache=True)
def _area_and_eccentricity(runs: Runs, row: float, column: float) -> tuple[float, float]:
    """((a - b)^2 + 4 d^2) / (a + b)^2 of the second moments a, b and d about the middle; 0 for a single pixel.

    All sums are of multiples of 1/4, and so exact: their order does not matter.
    """
    area, down, across, mixed = 0.0, 0.0, 0.0, 0.0
    for n in range(len(runs)):
        length = float(runs[n, 2] - runs[n, 1])
        y, x = runs[n, 0] - row, 0.5 * (runs[n, 1] + runs[n, 2] - 1) - column
        area += length
        down += length * y * y
        across += length * x * x + length * (length * length - 1.0) / 12.0
        mixed += length * y * x
    if down + across == 0.0:
        return area, 0.0
    return area, min(1.0, ((down - across) ** 2 + 4.0 * mixed**2) / (down + across) ** 2)


@njit(nogil=True, cache=True)
def _inner_pixels(image: Bytes, box: Ints) -> int:
    """The number of foreground pixels whose eight neighbours are foreground too."""
    inner = 0
    columns = np.empty(SIZE, np.uint8)
    for row in range(box[0] + 1, box[1] - 1):
        below, here, above = image[row - 1], image[row], image[row + 1]
        for c in range(SIZE):
            columns[c] = below[c] & here[c] & above[c]
        for c in range(SIZE - 2):
            inner += columns[c] & columns[c + 1] & columns[c + 2]
    return inner


@njit(nogil=True, cache=True)
def _transform(weights: Floats, areas: Floats, cells: Ints, basis: Floats, art: Floats) -> None:
    """Magnitudes of the angular radial transform (V, 35), p major, q minor, without (0, 0), per unit of area."""
    views = len(weights)
    sums = np.zeros((views, 4, _TERMS))
    for n in range(len(cells)):
        y, x = cells[n]
        for v in range(views):
            upper_right, upper_left = weights[v, _RADIUS + y, _RADIUS + x], weights[v, _RADIUS + y, _RADIUS - x]
            lower_right, lower_left = weights[v, _RADIUS - y, _RADIUS + x], weights[v, _RADIUS - y, _RADIUS - x]
            upper, lower = upper_right + upper_left, lower_right + lower_left
            if upper == 0.0 and lower == 0.0:  # weights are not negative: nothing of the silhouette is here
                continue
            upper_odd, lower_odd = upper_right - upper_left, lower_right - lower_left
            for k in range(_TERMS):
                sums[v, 0, k] += (upper + lower) * basis[n, 0, k]
                sums[v, 1, k] += (upper_odd + lower_odd) * basis[n, 1, k]
                sums[v, 2, k] += (upper_odd - lower_odd) * basis[n, 2, k]
                sums[v, 3, k] += (upper - lower) * basis[n, 3, k]
    for v in range(views):
        for n in range(1, _ANGULAR * _RADIAL):
            p, q = n // _RADIAL, n % _RADIAL
            k = p // 2 * _RADIAL + q
            real, imaginary = sums[v, p % 2, k], sums[v, 2 + p % 2, k]
            if p % 2:
                real += weights[v, _RADIUS, _RADIUS]  # the original's table has 1 in the middle for odd p as well
            art[v, n - 1] = math.hypot(real, imaginary) / areas[v] if areas[v] > 0.0 else 0.0
