"""Bars that stand out from a vertical axis in all directions, as feet do: found among points."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from shapewright.feedback.parts.pieces import Piece
from shapewright.shapes import Floats

COUNTS = (3, 4, 5, 6, 8)
"""Bars that are tried."""
# Where nothing else is said, chosen on seed 0 of benchmarks/suggestions.py.
_LAYERS = 8  # heights above and below which points are left out
_FEWEST = 40  # points that tell bars
_INNER = 0.4  # of the reach, from which on bars are apart
_RINGS = 4  # around the axis, that bars reach through
_FILLED = 0.35  # of its share of the points: what each bar and each ring around the axis has at least
_NARROW = 0.36  # mean angle off the nearest bar, of half that between bars, at most; 0.5 where points are all round
_ROUND = 0.12  # difference of width and depth up to which they are equal
_SHAPES = (0.35, 2.8)  # ratio of depth to width
_WITHIN = 0.75  # of a bar's breadth: how far off its middle points are explained by it

_Bars = tuple[float, Piece, NDArray[np.bool_]]


def turns(count: int) -> list[float]:
    """Degrees that turn a bar along x, for this many bars to be symmetric, in all ways that differ."""
    ways: dict[float, float] = {}
    for turn in (-90.0, 90.0, 0.0, 180.0, 180.0 / count):
        ways.setdefault(round(turn % (360.0 / count), 6), turn)
    return list(ways.values())


def spokes(places: Floats) -> tuple[Piece, NDArray[np.bool_]] | None:
    """Bars around the y axis among points (N, 3) of a shape of unit size, and which of the points they explain.

    None where there are none. Points above and below the bars are left out as far as horizontal cuts can.
    """
    several = [bars for layer in _layers(places[:, 1]) if (bars := _bars(places, layer)) is not None]
    if not several:
        return None
    _, piece, explained = min(several, key=lambda bars: (-round(float(bars[2].mean()), 1), bars[0]))
    return piece, explained


def _layers(height: Floats) -> Iterator[NDArray[np.bool_]]:
    """All points, those below and those above some heights."""
    yield np.ones(len(height), dtype=bool)
    for cut in np.linspace(height.min(), height.max(), _LAYERS + 2)[1:-1]:
        yield height < cut
        yield height > cut


def _bars(places: Floats, layer: NDArray[np.bool_]) -> _Bars | None:
    """How far a layer's points are off the bars that suit best, these bars, and which points they explain."""
    if layer.sum() < _FEWEST:
        return None
    extent = np.abs(places[layer][:, [0, 2]]).max(axis=0)
    several = []
    for count in COUNTS:
        for turn in turns(count):
            angles = np.radians(turn + 360.0 / count * np.arange(count))
            reach = extent / np.abs(np.stack([np.cos(angles), np.sin(angles)])).max(axis=1)
            if _SHAPES[0] < reach[1] / reach[0] < _SHAPES[1]:
                equal = abs(np.log(reach[1] / reach[0])) < _ROUND
                several.append(_off(places, layer, np.full(2, reach.mean()) if equal else reach, count, turn))
    return min((bars for bars in several if bars), key=lambda bars: bars[0], default=None)


def _off(places: Floats, layer: NDArray[np.bool_], reach: Floats, count: int, turn: float) -> _Bars | None:
    """The same for this many bars that reach to the ellipse with these half axes."""
    x, z = places[:, 0] / reach[0], -places[:, 2] / reach[1]  # a turn about y takes x to -z
    distance, step = np.hypot(x, z), 2.0 * np.pi / count
    angle = np.arctan2(z, x) - np.radians(turn)
    bar = np.round(angle / step)
    off = np.abs(angle - bar * step)
    outer = layer & (distance > _INNER)
    ring = np.clip((distance[outer] - _INNER) / (1.0 - _INNER) * _RINGS, 0, _RINGS - 1).astype(int)
    filled = np.bincount(bar[outer].astype(int) % count, minlength=count), np.bincount(ring, minlength=_RINGS)
    if outer.sum() < _FEWEST or any(counts.min() < _FILLED * counts.mean() for counts in filled):
        return None
    apart = float(off[outer].mean() / (step / 2.0))
    if apart > _NARROW:
        return None
    aside = distance * np.sin(off)
    breadth = max(2.0 * float(np.quantile(aside[outer], 0.9)), 0.02)
    explained = layer & (aside < _WITHIN * breadth) & (distance > _INNER / 2.0)
    height = places[explained][:, 1]
    low, high = (
        np.array([side * reach[0], end, side * reach[1]]) for side, end in ((-1, height.min()), (1, height.max()))
    )
    return apart, Piece("spokes", low, high, count=count, breadth=breadth / 2.0, turn=turn), explained
