"""Kernels on the pictures of two shapes from all sides, see ``rendering.surround``."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from shapewright.rendering.surround import EMPTY

CELLS = 28  # along the largest extent, of the grid in which regions are connected


@njit(nogil=True, cache=True)
def measure_gaps(ours: Any, theirs: Any, pixels: Any, most: float, gaps: Any) -> None:
    """How far the surface in each pixel is from what the same view shows of the other, at most ``most``; 0 if empty."""
    views, side, _ = ours.shape
    margin = math.ceil(most / pixels.min())
    wide = np.full((side + 2 * margin, side + 2 * margin), np.float32(EMPTY))
    for c in range(views):
        wide[margin : margin + side, margin : margin + side] = theirs[c]
        square = np.float32(pixels[c] * pixels[c])
        reach = math.ceil(most / pixels[c])
        for row in range(side):
            for column in range(side):
                gaps[c, row, column] = 0.0
                z = ours[c, row, column]
                if z <= EMPTY:
                    continue
                y, x = row + margin, column + margin
                apart = wide[y, x] - z
                least = min(np.float32(most * most), apart * apart)
                for ring in range(1, reach + 1):
                    if ring * ring * square >= least:
                        break
                    for k in range(-ring, ring + 1):
                        aside = (ring * ring + k * k) * square
                        if aside >= least:
                            continue
                        apart = wide[y - ring, x + k] - z
                        least = min(least, apart * apart + aside)
                        apart = wide[y + ring, x + k] - z
                        least = min(least, apart * apart + aside)
                        apart = wide[y + k, x - ring] - z
                        least = min(least, apart * apart + aside)
                        apart = wide[y + k, x + ring] - z
                        least = min(least, apart * apart + aside)
                gaps[c, row, column] = math.sqrt(least)


@njit(nogil=True, cache=True)
def largest_areas(gaps: Any, beyond: float, areas: Any) -> None:
    """(V,): pixels of the largest connected region of each view; neighbours touch at sides or corners."""
    views, side, _ = gaps.shape
    stack = np.empty((side * side, 2), np.int64)
    seen = np.zeros(gaps.shape, np.bool_)
    areas[:] = 0.0
    for c in range(views):
        for row in range(side):
            for column in range(side):
                if seen[c, row, column] or gaps[c, row, column] <= beyond:
                    continue
                seen[c, row, column] = True
                stack[0, 0], stack[0, 1] = row, column
                waiting, area = 1, 0
                while waiting:
                    waiting -= 1
                    y, x = stack[waiting]
                    area += 1
                    for i in range(max(0, y - 1), min(side, y + 2)):
                        for j in range(max(0, x - 1), min(side, x + 2)):
                            if not seen[c, i, j] and gaps[c, i, j] > beyond:
                                seen[c, i, j] = True
                                stack[waiting, 0], stack[waiting, 1] = i, j
                                waiting += 1
                if area > 2:
                    areas[c] = max(areas[c], area)


@njit(nogil=True, cache=True)
def mark_edges(nearness: Any, jump: float, edges: Any) -> None:
    views, side, _ = nearness.shape
    for c in range(views):
        for row in range(side):
            for column in range(side):
                z = nearness[c, row, column]
                if z <= EMPTY:
                    continue
                for i, j in ((row - 1, column), (row + 1, column), (row, column - 1), (row, column + 1)):
                    if not (0 <= i < side and 0 <= j < side) or z - nearness[c, i, j] > jump:
                        edges[c, row, column] = True


@njit(nogil=True, cache=True)
def count_beside(some: Any, others: Any, around: int, hits: Any) -> None:
    """(V, 2): marks of each view that have one of the others within ``around`` pixels, and all marks."""
    views, side, _ = some.shape
    hits[:] = 0.0
    for c in range(views):
        for row in range(side):
            for column in range(side):
                if some[c, row, column]:
                    hits[c, 1] += 1.0
                    beside = others[c, row, column]
                    for i in range(max(0, row - around), min(side, row + around + 1)):
                        if beside:
                            break
                        for j in range(max(0, column - around), min(side, column + around + 1)):
                            beside |= others[c, i, j]
                    hits[c, 0] += 1.0 if beside else 0.0


@njit(nogil=True, cache=True)
def pose_depths(ours: Any, theirs: Any, sources: Any, turns: Any, deep: float, weights: Any, means: Any) -> None:
    """(P,): the mean difference of depth in each pose of the other, of every fourth pixel.

    sources, turns: see ``surround.ORDERS``.
    """
    views, side, _ = ours.shape
    for p in range(len(means)):
        means[p] = 0.0
        for c in range(views):
            other, (a, b, e, f) = theirs[sources[p, c]], turns[p, c]
            total, covered = 0.0, 0
            for row in range(0, side, 2):
                up = side - 1 - 2 * row
                for column in range(0, side, 2):
                    right = 2 * column - side + 1
                    x, y = a * right + e * up, b * right + f * up  # the inverse of a turn is its transpose
                    z, w = ours[c, row, column], other[(side - 1 - y) // 2, (x + side - 1) // 2]
                    if z > EMPTY or w > EMPTY:
                        covered += 1
                        total += min(abs(z - w) / deep, 1.0)
            means[p] += weights[c] * total / max(covered, 1)


@njit(nogil=True, cache=True)
def sort_into_cells(
    nearness: Any,
    area: Any,
    gaps: Any,
    beyond: float,
    axes: Any,
    pixels: Any,
    cells: Any,
    points: Any,
    whole: Any,
    apart: Any,
) -> None:
    """The cell and the place of each pixel's surface, and how much surface each cell holds, in all and beyond."""
    views, side, _ = nearness.shape
    for c in range(views):
        for row in range(side):
            for column in range(side):
                if nearness[c, row, column] <= EMPTY:
                    continue
                right, up = (column + 0.5 - side / 2) * pixels[c], (side / 2 - row - 0.5) * pixels[c]
                cell = 0
                for x in range(3):
                    place = right * axes[c, 0, x] + up * axes[c, 1, x] + nearness[c, row, column] * axes[c, 2, x]
                    points[c, row, column, x] = place
                    cell = cell * CELLS + min(max(int((place + 0.5) * CELLS), 0), CELLS - 1)
                cells[c, row, column] = cell
                whole[cell] += area[c, row, column]
                if gaps[c, row, column] > beyond:
                    apart[cell] += area[c, row, column]


@njit(nogil=True, cache=True)
def enclose(numbers: Any, cells: Any, points: Any, gaps: Any, beyond: float, area: Any, boxes: Any) -> None:
    """Lows, highs and surface of each numbered region, (R, 7), of the pixels beyond."""
    views, side, _ = gaps.shape
    for c in range(views):
        for row in range(side):
            for column in range(side):
                if gaps[c, row, column] > beyond:
                    box = boxes[numbers[cells[c, row, column]]]
                    for x in range(3):
                        box[x] = min(box[x], points[c, row, column, x])
                        box[3 + x] = max(box[3 + x], points[c, row, column, x])
                    box[6] += area[c, row, column]


@njit(nogil=True, cache=True)
def summarise(gaps: Any, area: Any, weights: Any, far: float, most: float, bins: Any) -> tuple[float, float]:
    """The mean gap of the surface and its share beyond ``far``, views weighted; fills bins of gaps with surface."""
    views, side, _ = gaps.shape
    scale = (len(bins) - 1) / most
    total, beyond, whole = 0.0, 0.0, 0.0
    for c in range(views):
        for row in range(side):
            for column in range(side):
                surface, gap = area[c, row, column], gaps[c, row, column]
                if surface > 0.0:
                    bins[int(gap * scale)] += surface
                    weighted = weights[c] * surface
                    whole += weighted
                    total += weighted * gap
                    if gap > far:
                        beyond += weighted
    return total / whole, beyond / whole
