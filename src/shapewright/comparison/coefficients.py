"""The 47 coefficients of a silhouette in the light field descriptor: region, contour, and two simple ones.

Chen, Tian, Shen, Ouhyoung, "On Visual Similarity Based 3D Model Retrieval", 2003, section 4, with the tables, the
rounding and the order of the program that its authors published: quantised coefficients equal those of that program
when it is fed the same silhouettes.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from shapewright.comparison.contours import LONGEST, SIZE, outer_contour

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

ART, FOURIER = 35, 10
"""Coefficients of the angular radial transform and of the contour's Fourier transform."""

ART_LEVELS = (
    *(0.0, 0.003585473, 0.007418411, 0.011535520, 0.015982337, 0.020816302, 0.026111312, 0.031964674),
    *(0.038508176, 0.045926586, 0.054490513, 0.064619488, 0.077016351, 0.092998687, 0.115524524, 0.154032694),
)
"""An ART coefficient of 4 bits is the largest index whose level is below the value."""

_ANGULAR, _RADIAL = 12, 3
_RADIUS = 50  # of the disc that a silhouette is mapped to, in cells of the table of the ART basis
_GRID = 2 * _RADIUS + 2
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


def quantise(art: Floats, fourier: Floats, others: Floats, bits: int) -> tuple[Bytes, Bytes, Bytes]:
    """Coefficients to whole numbers: ART to 4 or 8 bits, Fourier to 8 bits of [0, 1/2], the others to 8 bits of [0, 1].

    Raises ValueError for any other number of bits.
    """
    if bits not in (4, 8):
        raise ValueError(f"ART coefficients have 4 or 8 bits, not {bits}")
    levels = np.maximum(np.searchsorted(ART_LEVELS, art) - 1, 0) if bits == 4 else np.minimum(art * 256.0, 255.0)
    return (
        levels.astype(np.uint8),
        np.minimum(fourier * 512.0, 255.0).astype(np.uint8),
        np.minimum(others * 256.0, 255.0).astype(np.uint8),
    )


@njit(nogil=True, cache=True)
def light_field_coefficients(
    images: Bytes, cells: Ints, basis: Floats, art: Floats, fourier: Floats, others: Floats
) -> None:
    """Coefficients of the V silhouettes (V, 256, 256) of one light field, which share a scale; an empty one has zeros.

    cells, basis: ``CELLS`` and ``BASIS`` (kernels that hold large tables cannot be cached on disk).
    art: (V, 35), each in [0, 1]; fourier: (V, 10); others: (V, 2), circularity and eccentricity in [0, 1].
    A silhouette leaves at least ``contours.MARGIN`` empty pixels along every border of its image.
    """
    views = len(images)
    boxes = np.empty((views, 4), np.int64)
    farthest = 0.0
    for v in range(views):
        farthest = max(farthest, _bound(images[v], boxes[v]))
    scale = _RADIUS / farthest if farthest > 0.0 else 0.0
    weights = np.zeros((views, _GRID, _GRID))
    contour = np.empty(LONGEST, np.int32)
    marks, stack = np.empty(SIZE * SIZE, np.uint8), np.empty(SIZE * SIZE, np.int32)
    art[:], fourier[:], others[:] = 0.0, 0.0, 0.0
    for v in range(views):
        if boxes[v, 0] == boxes[v, 1]:
            continue
        box = (boxes[v, 0], boxes[v, 1], boxes[v, 2], boxes[v, 3])
        row, column = 0.5 * (box[0] + box[1] - 1), 0.5 * (box[2] + box[3] - 1)
        _spread(images[v], box, row, column, scale, weights[v])
        others[v, 0] = _circularity(images[v], box)
        others[v, 1] = _eccentricity(images[v], box, row, column)
        count = outer_contour(images[v].ravel(), box, contour, marks, stack)
        _transform_contour(contour[:count], row, column, fourier[v])
    _transform_regions(weights, cells, basis, art)


@njit(nogil=True, cache=True)
def _bound(image: Bytes, box: Ints) -> float:
    """Find the foreground's box, and return the distance of its farthest pixel from the middle of the box."""
    rows = np.full((SIZE, 2), -1, np.int64)  # the first and the last foreground column
    box[0], box[1], box[2], box[3] = SIZE, SIZE, SIZE, 0
    for r in range(SIZE):
        for c in range(SIZE):
            if image[r, c]:
                rows[r, 0] = c
                break
        if rows[r, 0] < 0:
            continue
        c = SIZE - 1
        while image[r, c] == 0:
            c -= 1
        rows[r, 1] = c
        box[0], box[1] = min(box[0], r), r + 1
        box[2], box[3] = min(box[2], rows[r, 0]), max(box[3], c + 1)
    row, column = 0.5 * (box[0] + box[1] - 1), 0.5 * (box[2] + box[3] - 1)
    farthest = 0.0
    for r in range(box[0], box[1]):
        if rows[r, 0] >= 0:
            across = max(column - rows[r, 0], rows[r, 1] - column)
            farthest = max(farthest, (r - row) ** 2 + across**2)
    return math.sqrt(farthest)


@njit(nogil=True, cache=True)
def _spread(
    image: Bytes, box: tuple[int, int, int, int], row: float, column: float, scale: float, grid: Floats
) -> None:
    """Share out each foreground pixel among the four cells around the place that it is mapped to.

    The sum of bilinear interpolations of a table is the sum of the table under these weights; they add up to 1.
    """
    share = np.empty(SIZE)
    cell = np.empty(SIZE, np.int64)
    for c in range(box[2], box[3]):
        place = (c - column) * scale + _RADIUS
        cell[c] = int(place)
        share[c] = place - cell[c]
    line = np.empty(_GRID)
    pixels = 0
    for r in range(box[0], box[1]):
        line[:] = 0.0
        for c in range(box[2], box[3]):
            if image[r, c]:
                pixels += 1
                line[cell[c]] += 1.0 - share[c]
                line[cell[c] + 1] += share[c]
        place = (r - row) * scale + _RADIUS
        lower = int(place)
        upward = place - lower
        for x in range(_GRID):
            grid[lower, x] += (1.0 - upward) * line[x]
            grid[lower + 1, x] += upward * line[x]
    grid /= pixels


@njit(nogil=True, cache=True)
def _transform_regions(weights: Floats, cells: Ints, basis: Floats, art: Floats) -> None:
    """Magnitudes of the angular radial transform (V, 35) of the weights (V, 102, 102): p major, q minor, without 0, 0."""
    views = len(weights)
    sums = np.zeros((views, 4, _TERMS))
    for n in range(len(cells)):
        y, x = cells[n]
        for v in range(views):
            upper_right, upper_left = weights[v, _RADIUS + y, _RADIUS + x], weights[v, _RADIUS + y, _RADIUS - x]
            lower_right, lower_left = weights[v, _RADIUS - y, _RADIUS + x], weights[v, _RADIUS - y, _RADIUS - x]
            upper, lower = upper_right + upper_left, lower_right + lower_left
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
            art[v, n - 1] = math.hypot(real, imaginary)


@njit(nogil=True, cache=True)
def _transform_contour(contour: NDArray[np.int32], row: float, column: float, fourier: Floats) -> None:
    """Magnitudes 1 to 10 of the Fourier transform of the distances from the middle, over magnitude 0."""
    count = len(contour)
    if count < 8:
        return
    real, imaginary = np.zeros(FOURIER), np.zeros(FOURIER)
    cosine, sine = np.ones(FOURIER), np.zeros(FOURIER)
    turn = 2.0 * math.pi / count * np.arange(1, FOURIER + 1)
    turn_cosine, turn_sine = np.cos(turn), np.sin(turn)
    total = 0.0
    for pixel in contour:
        distance = math.sqrt((pixel // SIZE - row) ** 2 + (pixel % SIZE - column) ** 2)
        total += distance
        for k in range(FOURIER):
            real[k] += distance * cosine[k]
            imaginary[k] += distance * sine[k]
            along = cosine[k] * turn_cosine[k] - sine[k] * turn_sine[k]
            sine[k] = sine[k] * turn_cosine[k] + cosine[k] * turn_sine[k]
            cosine[k] = along
    for k in range(FOURIER):
        fourier[k] = math.hypot(real[k], imaginary[k]) / total


@njit(nogil=True, cache=True)
def _circularity(image: Bytes, box: tuple[int, int, int, int]) -> float:
    """4 pi area / perimeter^2, where the perimeter is the number of pixels beside the background, corners included."""
    area, inner = 0, 0
    above = np.empty(SIZE, np.uint8)
    for r in range(box[0], box[1]):
        for c in range(box[2] - 1, box[3] + 1):
            above[c] = image[r - 1, c] & image[r, c] & image[r + 1, c]
        for c in range(box[2], box[3]):
            area += image[r, c]
            inner += above[c - 1] & above[c] & above[c + 1]
    return min(1.0, 4.0 * math.pi * area / float(area - inner) ** 2)


@njit(nogil=True, cache=True)
def _eccentricity(image: Bytes, box: tuple[int, int, int, int], row: float, column: float) -> float:
    """((a - b)^2 + 4 d^2) / (a + b)^2 of the second moments a, b and d about the middle; 0 for a single pixel."""
    down, across, mixed = 0.0, 0.0, 0.0
    for r in range(box[0], box[1]):
        pixels, first, second = 0, 0, 0
        for c in range(box[2], box[3]):
            value = np.int64(image[r, c])
            pixels += value
            first += value * c
            second += value * c * c
        down += pixels * (r - row) ** 2
        across += second - 2.0 * column * first + column * column * pixels
        mixed += (r - row) * (first - column * pixels)
    if down + across == 0.0:
        return 0.0
    return min(1.0, ((down - across) ** 2 + 4.0 * mixed**2) / (down + across) ** 2)
