"""Fewer points, spread evenly: one for each cell of a grid, that nearest to the middle of its cell."""

from __future__ import annotations

import numpy as np

from shapewright.shapes import Floats, Ints

_TRIES = 12
"""Steps to the size of a cell. Points of a surface need 3 to 6 of them, as their number goes with its square."""
_CLOSE = 0.97  # share of the number asked for at which a search ends
_MARKS = 2**22  # bits to mark occupied cells in, for a quick count
_UNEVEN, _TAIL = 3.0, 0.2
"""Ratio of the distances to the neighbours, where they are widest and narrowest: each a fifth of the area. Points at
random have 1.4 on a surface, 1.8 at most on the thin parts of 134 pieces of furniture, 10,000 points on each."""
_NEIGHBOUR = 6  # its distance tells the density


def thinned(positions: Floats, most: int) -> Ints:
    """Rows of at most ``most`` points, in order; all rows where there are no more. positions: (N, 3)."""
    if len(positions) <= most:
        return np.arange(len(positions))
    low, extent = positions.min(axis=0), float(np.ptp(positions, axis=0).max())
    size, fine, coarse = extent / most**0.5, 0.0, np.inf  # cells that are too many, and few enough
    for _ in range(_TRIES):
        count = _occupied(positions, low, size)
        fine, coarse = (max(fine, size), coarse) if count > most else (fine, min(coarse, size))
        if _CLOSE * most <= count <= most:
            break
        size *= (count / (_CLOSE * most)) ** 0.5
        if not fine < size < coarse:
            size = (fine + min(coarse, extent)) / 2.0
    rows = _nearest_to_middle(positions, low, min(coarse, extent))
    # Cells were counted about; a few too many are left out, evenly.
    return rows if len(rows) <= most else rows[np.linspace(0, len(rows) - 1, most).astype(np.int64)]


def evened(positions: Floats) -> Ints:
    """Rows of points without those that are much closer than elsewhere; all rows where the density is even.

    Cells are half way between wide and narrow, so that what is dense keeps some of its detail.
    """
    from scipy.spatial import cKDTree  # it takes half a second to load

    if len(positions) <= _NEIGHBOUR:
        return np.arange(len(positions))
    distances = cKDTree(positions).query(positions, k=[_NEIGHBOUR + 1])[0][:, 0]
    order = np.argsort(distances)
    area = np.cumsum(np.square(distances[order]))  # each point stands for a disc up to its neighbours
    narrow, wide = distances[order][np.searchsorted(area, [_TAIL * area[-1], (1.0 - _TAIL) * area[-1]])]
    if wide < _UNEVEN * narrow or wide <= 0.0:
        return np.arange(len(positions))
    size = max(float(np.sqrt(narrow * wide)), wide / _UNEVEN)
    return _nearest_to_middle(positions, positions.min(axis=0), size)


def _cells(positions: Floats, low: Floats, size: float) -> Ints:
    """(N,): a number for the cell of each point."""
    cells = np.floor((positions - low) / size).astype(np.int64)
    counts = cells.max(axis=0) + 1
    return np.asarray((cells[:, 0] * counts[1] + cells[:, 1]) * counts[2] + cells[:, 2])


def _occupied(positions: Floats, low: Floats, size: float) -> float:
    """About how many cells hold a point: by marks that some of them share (linear counting, Whang et al. 1990)."""
    marks = np.zeros(_MARKS, dtype=bool)
    marks[(_cells(positions, low, size) * 0x9E3779B1) % _MARKS] = True
    empty = max(_MARKS - int(np.count_nonzero(marks)), 1)
    return float(-_MARKS * np.log(empty / _MARKS))


def _nearest_to_middle(positions: Floats, low: Floats, size: float) -> Ints:
    """The row of one point of each cell, in order."""
    scaled = (positions - low) / size
    off = np.square(scaled - np.floor(scaled) - 0.5).sum(axis=1)
    cells = _cells(positions, low, size)
    order = np.argsort(cells)
    begins = np.flatnonzero(np.diff(cells[order], prepend=-1))
    counts = np.diff(begins, append=len(order))
    nearest = np.flatnonzero(off[order] == np.repeat(np.minimum.reduceat(off[order], begins), counts))
    cell = np.repeat(np.arange(len(begins)), counts)[nearest]
    return np.sort(order[nearest[np.diff(cell, prepend=-1) != 0]])
