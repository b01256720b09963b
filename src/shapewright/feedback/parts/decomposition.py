"""Taking a set of surface points apart into boxes: what of a reference is unexplained, as primitives to add."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from shapewright.feedback.parts.around import spokes
from shapewright.feedback.parts.pieces import SLATS, Piece
from shapewright.feedback.surfaces.connection import connected_points
from shapewright.shapes import Floats

MOST = 6
"""Pieces at most, the largest ones."""
# Where nothing else is said, chosen on seed 0 of benchmarks/suggestions.py.
_SYMMETRIC, _NEAR = 0.8, 0.035  # share of points with a mirror image that makes a set symmetric; how near that is
_CUTS = 24  # places along an axis where a box may be halved
_WORTH = 0.62  # volume of two boxes over that of one around them, below which they are two
_PAD = 0.012  # added to every side of a box, in units of the whole: flat boxes have a volume
_FEWEST = 10  # points of a piece
_EQUAL = 0.03  # difference of sizes and places, in units of the whole, that are one
_LINKS, _LINK, _SHORTEST = 4, 3.0, 0.015  # how far neighbours lie: in median distances of the fourth, and at least
_ROW = 3  # pieces of a row
_CLEAR, _GAP = 1.1, 0.02  # steps of a row in units of a piece, and the gap as a part of the row, at least


def decompose(points: Floats, middle: tuple[float, float], unit: float, radial: bool = False) -> tuple[Piece, ...]:
    """Boxes around the points (N, 3) of a surface, largest first, at most MOST.

    middle: x and z of the planes about which the shape is symmetric, where it is. unit: the largest extent of the
    whole shape. Points that are symmetric about a plane are taken apart on one side of it. radial: bars around the
    middle come first; nothing is returned where there are none.
    """
    if len(points) < _FEWEST:
        return ()
    centre = np.array([middle[0], 0.0, middle[1]])
    places = (points - centre) / unit
    first: tuple[Piece, ...] = ()
    if radial:
        if (around := spokes(places)) is None:
            return ()
        bars, explained = around
        first = (replace(bars, low=bars.low * unit + centre, high=bars.high * unit + centre, middle=middle),)
        places = places[~explained]
        if len(places) < _FEWEST:
            return first
    folded = [_symmetric(places, axis) for axis in (0, 2)]
    for axis, fold in zip((0, 2), folded, strict=True):
        if fold:
            places[:, axis] = np.abs(places[:, axis])
    boxes = [box for group in _connected(places) for box in _split(places[group], MOST)]
    pieces = [_piece(low, high, folded, centre, unit, middle) for low, high in boxes]
    pieces = sorted(_rows(pieces, unit), key=lambda piece: -float(np.prod(piece.size + _PAD * unit)))
    return (*first, *pieces)[:MOST]


def _symmetric(places: Floats, axis: int) -> bool:
    image = places.copy()
    image[:, axis] *= -1.0
    distance, _ = cKDTree(places).query(image)
    return bool((distance < _NEAR).mean() > _SYMMETRIC)


def _connected(places: Floats) -> list[NDArray[np.intp]]:
    """Rows of the points of each connected group that is large enough."""
    nearest, _ = cKDTree(places).query(places, k=min(_LINKS, len(places)))
    reach = max(_LINK * float(np.median(nearest[:, -1])), _SHORTEST)
    count, component = connected_points(places, reach)
    groups = [np.flatnonzero(component == number) for number in range(count)]
    return [group for group in groups if len(group) >= _FEWEST]


def _split(places: Floats, most: int) -> list[tuple[Floats, Floats]]:
    """Boxes (low, high) around points, halved along the axes wherever that leaves out much empty space."""
    low, high = places.min(axis=0), places.max(axis=0)
    whole = _volume(low, high)
    best, halves = _WORTH, None
    for axis in range(3) if most > 1 and len(places) >= 2 * _FEWEST else ():
        order = np.argsort(places[:, axis])
        ordered = places[order]
        # The boxes of all that lies before and behind each place, at once.
        before_low, before_high = np.minimum.accumulate(ordered), np.maximum.accumulate(ordered)
        behind_low = np.minimum.accumulate(ordered[::-1])[::-1]
        behind_high = np.maximum.accumulate(ordered[::-1])[::-1]
        for cut in np.linspace(low[axis], high[axis], _CUTS + 2)[1:-1]:
            k = int(np.searchsorted(ordered[:, axis], cut))
            if _FEWEST <= k <= len(ordered) - _FEWEST:
                volume = _volume(before_low[k - 1], before_high[k - 1]) + _volume(behind_low[k], behind_high[k])
                if volume / whole < best:
                    best, halves = volume / whole, (ordered[:k], ordered[k:])
    if halves is None:
        return [(low, high)]
    first, second = halves
    return [*_split(first, most - 1), *_split(second, most - 1)]


def _volume(low: Floats, high: Floats) -> float:
    return float(np.prod(high - low + _PAD))


def _piece(
    low: Floats, high: Floats, folded: Sequence[bool], centre: Floats, unit: float, middle: tuple[float, float]
) -> Piece:
    """The piece of a box of the folded, normalised points, in the units of the shape."""
    low, high, mirrored = low.copy(), high.copy(), [False, False]
    for number, axis in enumerate((0, 2)):
        if folded[number]:
            if low[axis] < _EQUAL:
                low[axis] = -high[axis]
            else:
                mirrored[number] = True
    return Piece("box", low * unit + centre, high * unit + centre, (mirrored[0], mirrored[1]), middle)


def _rows(pieces: Sequence[Piece], unit: float) -> list[Piece]:
    """The pieces, those that stand in a row at equal distances replaced by slats."""
    copies_of = [piece.copies for piece in pieces]
    copies = [copy for several in copies_of for copy in several]
    for axis, kind in enumerate(SLATS):
        for first in copies:
            others = [d for d in range(3) if d != axis]
            row = [
                copy
                for copy in copies
                if np.abs(copy.size - first.size).max() < _EQUAL * unit
                and np.abs((copy.centre - first.centre)[others]).max() < _EQUAL * unit
            ]
            places = np.sort([copy.centre[axis] for copy in row])
            steps = np.diff(places)
            if len(row) < _ROW or np.ptp(steps) > 2 * _EQUAL * unit or steps.min() < _CLEAR * first.size[axis]:
                continue
            low = np.min([copy.low for copy in row], axis=0)
            high = np.max([copy.high for copy in row], axis=0)
            gap = float(steps.mean() - np.mean([copy.size[axis] for copy in row])) / float(high[axis] - low[axis])
            made = Piece(kind, low, high, middle=first.middle, count=len(row), gap=max(gap, _GAP))
            inside = {id(copy) for copy in row}
            rest = [p for p, own in zip(pieces, copies_of, strict=True) if not inside & {id(copy) for copy in own}]
            return [made, *_rows(rest, unit)]
    return list(pieces)
