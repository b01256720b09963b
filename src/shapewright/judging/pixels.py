"""Kernels on the pictures of two shapes from all sides, see ``rendering.surround``.

Places in flat pictures are unsigned: numba asks of a signed index whether it is negative. Where sums may be taken in
any order ("reassoc"), the processor adds several pixels at once.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit

from shapewright.rendering.surround import EMPTY

CELLS = 28  # along the largest extent, of the grid in which regions are connected
GRID = CELLS + 2  # with an empty one at either end


@njit(nogil=True, cache=True, fastmath={"reassoc"})
def compare_depths(ours: Any, theirs: Any, deep: float, depths: Any, outlines: Any) -> None:
    """(V,) each: the mean difference of depth where either is, and 1 - intersection over union of the silhouettes.

    Depths that differ by ``deep`` or more count 1, and so does what only one covers.
    """
    views, side, _ = ours.shape
    scale = np.float32(1.0 / deep)
    for c in range(views):
        total, both, either = 0.0, 0, 0
        for row in range(side):
            for column in range(side):
                z, w = ours[c, row, column], theirs[c, row, column]
                both += (z > EMPTY) & (w > EMPTY)
                either += (z > EMPTY) | (w > EMPTY)
                total += min(abs(z - w) * scale, np.float32(1.0))
        depths[c] = total / max(either, 1)
        outlines[c] = 1.0 - both / max(either, 1)


@njit(nogil=True, cache=True)
def measure_gaps(ours: Any, theirs: Any, pixels: Any, most: float, gaps: Any) -> None:
    """How far the surface in each pixel is from what the same view shows of the other, at most ``most``; 0 if empty.

    Steps aside are taken in the order of their length, each in four directions, until they are longer than the gap.
    """
    views, side, _ = ours.shape
    margin = math.ceil(most / pixels.min())
    width = side + 2 * margin
    wide = np.full(width * width, np.float32(EMPTY))
    steps = _steps(margin)
    along, across = (steps[:, 0] * width + steps[:, 1]), (steps[:, 1] * width - steps[:, 0])
    along, across = along.astype(np.uint64), across.astype(np.uint64)
    lengths = (steps[:, 0] ** 2 + steps[:, 1] ** 2).astype(np.float32)
    for c in range(views):
        for row in range(side):
            start = (margin + row) * width + margin
            wide[start : start + side] = theirs[c, row]
        aside = lengths * np.float32(pixels[c] * pixels[c])
        for row in range(side):
            for column in range(side):
                gaps[c, row, column] = 0.0
                z = ours[c, row, column]
                if z <= EMPTY:
                    continue
                place = np.uint64((margin + row) * width + margin + column)
                straight = wide[place] - z
                least = min(np.float32(most * most), straight * straight)
                for s in range(len(aside)):
                    if aside[s] >= least:
                        break
                    right, left = wide[place + along[s]] - z, wide[place - along[s]] - z
                    up, down = wide[place - across[s]] - z, wide[place + across[s]] - z
                    apart = min(min(right * right, left * left), min(up * up, down * down))
                    least = min(least, apart + aside[s])
                gaps[c, row, column] = math.sqrt(least)


@njit(nogil=True, cache=True)
def _steps(most: int) -> Any:
    """Rows and columns of the steps of a quarter of a square, the shortest first: the others are these, turned."""
    steps = np.empty((most * (most + 1), 2), np.int64)
    for i in range(len(steps)):
        steps[i, 0], steps[i, 1] = i % (most + 1), 1 + i // (most + 1)
    return steps[np.argsort(steps[:, 0] ** 2 + steps[:, 1] ** 2)]


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


@njit(nogil=True, cache=True)
def longest_side(gaps: Any, beyond: float, pixels: Any) -> float:
    """The side, as the root of its area, of the largest connected region of a view; pixels: (V,), their sides.

    Neighbours touch at sides or corners. Views that cannot hold a larger region are passed over.
    """
    views, side, _ = gaps.shape
    stack = np.empty((side * side, 2), np.int64)
    counts = np.empty(views)
    for c in range(views):
        counts[c] = np.count_nonzero(gaps[c] > beyond)
    longest = 0.0
    for c in np.argsort(-np.sqrt(counts) * pixels):
        waits, left = gaps[c] > beyond, counts[c]
        for row in range(side):
            if left <= 2 or math.sqrt(left) * pixels[c] <= longest:
                break
            for column in range(side):
                if waits[row, column]:
                    area = _take(waits, row, column, stack)
                    left -= area
                    if area > 2:
                        longest = max(longest, math.sqrt(area) * pixels[c])
    return longest


@njit(nogil=True, cache=True)
def _take(waits: Any, row: int, column: int, stack: Any) -> int:
    """Clears the connected region that holds a place; its pixels."""
    side = len(waits)
    waits[row, column] = False
    stack[0, 0], stack[0, 1] = row, column
    waiting, area = 1, 0
    while waiting:
        waiting -= 1
        y, x = stack[waiting]
        area += 1
        for i in range(max(0, y - 1), min(side, y + 2)):
            for j in range(max(0, x - 1), min(side, x + 2)):
                if waits[i, j]:
                    waits[i, j] = False
                    stack[waiting, 0], stack[waiting, 1] = i, j
                    waiting += 1
    return area


@njit(nogil=True, cache=True)
def count_beside(some: Any, others: Any, around: int, hits: Any) -> None:
    """(V, 2): marks of each view that have one of the others within ``around`` pixels, and all marks.

    Marks are bits of rows, (V, S) uint64.
    """
    views, side = some.shape
    one = np.uint64(1)
    for c in range(views):
        hits[c] = 0.0
        for row in range(side):
            near = np.uint64(0)
            for i in range(max(0, row - around), min(side, row + around + 1)):
                near |= others[c, i]
            for _ in range(around):
                near |= (near << one) | (near >> one)
            hits[c, 0] += _ones(some[c, row] & near)
            hits[c, 1] += _ones(some[c, row])


@njit(nogil=True, cache=True)
def _ones(bits: Any) -> int:
    count = 0
    while bits:
        bits &= bits - np.uint64(1)
        count += 1
    return count


@njit(nogil=True, cache=True)
def pose_depths(ours: Any, theirs: Any, sources: Any, turns: Any, deep: float, weights: Any) -> tuple[float, float]:
    """The mean difference of depth of every fourth pixel: as both stand, and in the best of the other poses.

    sources, turns: see ``surround.ORDERS``.
    """
    first, best = 0.0, np.inf
    for p in range(len(sources)):
        mean = 0.0
        for c in range(len(ours)):
            mean += weights[c] * _turned_depth(ours[c], theirs[sources[p, c]].ravel(), turns[p, c], deep)
            if p > 0 and mean >= best:
                break
        if p == 0:
            first = mean
        else:
            best = min(best, mean)
    return first, best


@njit(nogil=True, cache=True, fastmath={"reassoc"})
def _turned_depth(ours: Any, theirs: Any, turn: Any, deep: float) -> float:
    side = len(ours)
    a, b, e, f = turn
    x, y = (e - a) * (side - 1), (f - b) * (side - 1)  # of the first pixel; the inverse of a turn is its transpose
    along, down = np.uint64(2 * (a - b * side)), np.uint64(2 * (f * side - e))
    start = np.uint64((side - 1 - y) // 2 * side + (x + side - 1) // 2)
    total, covered, scale = 0.0, 0, np.float32(1.0 / deep)
    for row in range(0, side, 2):
        place = start
        for column in range(0, side, 2):
            z, w = ours[row, column], theirs[place]
            covered += (z > EMPTY) | (w > EMPTY)
            total += min(abs(z - w) * scale, np.float32(1.0))
            place += along
        start += down
    return total / max(covered, 1)


@njit(nogil=True, cache=True)
def sort_into_cells(
    nearness: Any, area: Any, gaps: Any, beyond: float, axes: Any, pixels: Any, whole: Any, apart: Any
) -> tuple[Any, Any]:
    """How much surface each cell holds, in all and beyond; whole, apart: (GRID ** 3,).

    Returns of the pixels beyond their cells, (N,), and their places and surfaces, (N, 4).
    """
    views, side, _ = nearness.shape
    far = np.empty((np.count_nonzero(gaps > beyond), 4))
    cells, count = np.empty(len(far), np.int64), 0
    if not len(far):
        return cells, far
    for c in range(views):
        right, up, back = axes[c]
        for row in range(side):
            above = (side / 2 - row - 0.5) * pixels[c]
            for column in range(side):
                near = nearness[c, row, column]
                if near <= EMPTY:
                    continue
                aside = (column + 0.5 - side / 2) * pixels[c]
                x = aside * right[0] + above * up[0] + near * back[0]
                y = aside * right[1] + above * up[1] + near * back[1]
                z = aside * right[2] + above * up[2] + near * back[2]
                cell = (_step(x) * GRID + _step(y)) * GRID + _step(z)
                whole[cell] += area[c, row, column]
                if gaps[c, row, column] > beyond:
                    apart[cell] += area[c, row, column]
                    cells[count] = cell
                    far[count, 0], far[count, 1], far[count, 2], far[count, 3] = x, y, z, area[c, row, column]
                    count += 1
    return cells, far


@njit(nogil=True, cache=True)
def _step(place: float) -> int:
    return 1 + min(max(int((place + 0.5) * CELLS), 0), CELLS - 1)


@njit(nogil=True, cache=True)
def connect(inside: Any, numbers: Any) -> int:
    """Numbers the connected regions of cells that are inside, from 1 on; (GRID ** 3,). Corners connect."""
    stack = np.empty(len(inside), np.int64)
    count = 0
    for first in range(len(inside)):
        if not inside[first] or numbers[first]:
            continue
        count += 1
        numbers[first], stack[0], waiting = count, first, 1
        while waiting:
            waiting -= 1
            corner = stack[waiting] - (GRID + 1) * GRID - 1
            for i in range(3):
                for j in range(3):
                    for cell in range(corner + (i * GRID + j) * GRID, corner + (i * GRID + j) * GRID + 3):
                        if inside[cell] and not numbers[cell]:
                            numbers[cell], stack[waiting] = count, cell
                            waiting += 1
    return count


@njit(nogil=True, cache=True)
def enclose(numbers: Any, far: Any, boxes: Any) -> None:
    """Lows, highs and surface of each numbered region, (R, 7), of pixels (N,) at those places, (N, 4)."""
    for n in range(len(numbers)):
        box = boxes[numbers[n]]
        for x in range(3):
            box[x] = min(box[x], far[n, x])
            box[3 + x] = max(box[3 + x], far[n, x])
        box[6] += far[n, 3]
