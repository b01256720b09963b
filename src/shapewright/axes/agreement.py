"""Which way the files of a collection were turned: most share one way, and no single shape is always told right."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapewright.axes.turns import AS_IT_IS, TURNS, turn_index
from shapewright.shapes import Floats

Z_UP = turn_index(np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]))
"""Of TURNS: what stands right with z up and its front at -y, as in CAD, is right after this one."""
_KNOWN, _CAD = 0.7, 0.15
"""How often files stand as the loader takes them, and how often Z up; all other turns share the rest. A guess."""
_STRAY = np.array([0.01, 0.1, 0.3, 1.0])
"""Shares of files that stand in any other way than the collection's, of which the likeliest is taken."""
_STRAY_LOG = np.log([0.6, 0.25, 0.1, 0.05])
"""How likely each share is beforehand. A guess."""
_WAYS = 3  # that a collection has at most, besides strays
_ANOTHER = 3.0
"""What another way has to add to the logarithm of the likelihood, besides how seldom it is."""
_ROUNDS = 10


@dataclass(frozen=True, eq=False)
class Agreement:
    """How likely each turn brings each shape to stand right, by its looks and by how the others stand.

    likely: (N, 24); each row adds up to 1.
    ways: of TURNS, those that many of the collection share, the commonest first.
    fit: logarithm of how likely all looks together are then, however seldom those ways are.
    """

    likely: Floats
    ways: tuple[int, ...]
    fit: float


def agreement(log_likely: Floats, doubt: float) -> Agreement:
    """log_likely: (N, 24), by the looks of each shape alone. doubt: how often those are wrong."""
    count = len(TURNS)
    alone = (1.0 - doubt) * np.exp(log_likely) + doubt / count
    before = np.full(count, (1.0 - _KNOWN - _CAD) / (count - 2))
    before[[AS_IT_IS, Z_UP]] = _KNOWN, _CAD
    ways: list[int] = []
    best, mixture = -np.inf, np.full(count, 1.0 / count)
    for number in range(min(_WAYS, len(alone))):
        tried = [(*_fitted(alone, [*ways, turn]), turn) for turn in range(count) if turn not in ways]
        gains = [found + np.log(before[turn]) - (_ANOTHER if number else 0.0) for found, _, turn in tried]
        at = int(np.argmax(gains))
        spent = sum(np.log(before[way]) for way in ways) - _ANOTHER * max(number - 1, 0)
        if gains[at] + spent <= best:
            break
        best, mixture = gains[at] + spent, tried[at][1]
        ways.append(tried[at][2])
    scarce = -float(sum(np.log(before[way]) for way in ways))
    if len(alone) == 1:
        mixture = before
    joint = alone * mixture
    order = sorted(ways, key=lambda way: -mixture[way])
    return Agreement(joint / joint.sum(axis=1, keepdims=True), tuple(order), float(best) + scarce)


def _fitted(alone: Floats, ways: list[int]) -> tuple[float, Floats]:
    """The largest likelihood (logarithm) of a mixture of ways and strays, and the mixture (24,)."""
    found: list[tuple[float, Floats]] = []
    for stray, chance in zip(_STRAY, _STRAY_LOG, strict=True):
        share = np.full(len(ways), 1.0 / len(ways))
        for _ in range(_ROUNDS if len(ways) > 1 else 1):
            each = alone[:, ways] * share
            total = (1.0 - stray) * each.sum(axis=1) + stray / len(TURNS)
            share = ((1.0 - stray) * each / total[:, None]).sum(axis=0) + 1e-9
            share /= share.sum()
        mixture = np.full(len(TURNS), stray / len(TURNS))
        mixture[ways] += (1.0 - stray) * share
        found.append((float(np.log(total).sum()) + chance, mixture))
    return max(found, key=lambda each: each[0])
