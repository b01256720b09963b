"""Combinations of choices in a search: those beside a given one, the points that moves try, what is learned of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from shapewright.parameters import ParameterSpace, Scalar
from shapewright.search.budgets import SPREAD
from shapewright.search.descent import bounded_step, learn_slope
from shapewright.search.moves import BuildingMove, Probe, Step
from shapewright.shapes import Floats

REACH, _FARTHEST = 0.15, 0.3
"""How far a first step and any step may move a scalar, encoded. By trial on tables, as are all constants here."""
_SHORTER = 0.4
"""Length of each step beside the one before in the same move, and of the first one after a move that was in vain."""
_FLOORS = (20.0, 1000.0)
"""Residuals below them weigh alike in one step and the next: the sum of absolute values, or nearly that of squares."""
_WIDER, _NARROWER = 1.3, 0.75
"""What random points spread by after a move that found something better, and after one that did not."""
_LOCAL = 0.1
"""How far a point may lie from the best one, encoded, for the linear model to learn from it."""
_COUNTABLE = 40
"""Values of a whole number up to which it may count parts. A gear with a tooth more is no small step from one with a
tooth less, so slopes say nothing of it. Chosen on gears of 14 to 40 teeth."""


@dataclass(eq=False)
class Candidate:
    """One combination of discrete values: the best scalars found for it, and a linear model around them."""

    vector: Floats  # encoded (P,), where its cost is least so far
    surprise: float = 0.0  # what it costs that the combination is unlikely
    known: bool = False  # whether an earlier search found it
    spread: float = SPREAD  # of random points, encoded
    cost: float = np.inf  # by the present part of the residual, with the surprise
    residual: Floats | None = None  # (K,); None before it was measured
    slopes: Floats | None = None  # (P, K), of the residual by the scalars; None before they were probed
    reach: float = REACH  # how far a step may move a scalar, encoded

    def cost_of(self, residual: Floats, part: slice) -> float:
        """What a residual (K,) of this combination costs by one part."""
        return float(np.abs(residual[part]).sum()) + self.surprise

    def go_by(self, part: slice) -> None:
        """Compare by another part of the residual."""
        self.reach = REACH
        self.cost = np.inf if self.residual is None else self.cost_of(self.residual, part)

    def learn(self, points: Sequence[tuple[float, Floats, Floats]]) -> None:
        """Mend the model by what a move has measured, as cost, vector and residual, and move to the best of these."""
        stepping = self.slopes is not None
        if self.residual is not None:
            self._model(self.residual, points)
        best = min(points, key=lambda point: point[0], default=None)
        if best and best[0] < self.cost:
            if stepping:
                moved = float(np.abs(best[1] - self.vector).max())
                self.reach = max(min(2.0 * moved, _FARTHEST), 0.5 * self.reach)
                self.spread *= _WIDER
            self.cost, self.vector, self.residual = best
        elif stepping:
            self.reach *= _SHORTER
            self.spread *= _NARROWER

    def _model(self, residual: Floats, points: Sequence[tuple[float, Floats, Floats]]) -> None:
        """Make the model from the first points, each along one axis; let it learn from others, the nearest last."""
        if self.slopes is None:
            self.slopes = np.zeros((len(self.vector), len(residual)))
            if points:
                steps = np.array([vector - self.vector for _, vector, _ in points])
                changes = np.array([changed - residual for _, _, changed in points])
                self.slopes += steps.T @ changes / np.maximum((steps * steps).sum(axis=0), 1e-12)[:, None]
            return
        apart = [(float(np.abs(vector - self.vector).max()), vector, changed) for _, vector, changed in points]
        for length, vector, changed in sorted(apart, key=lambda point: -point[0]):
            if length <= _LOCAL:
                learn_slope(self.slopes, vector - self.vector, changed - residual)


def others(space: ParameterSpace, vector: Floats, choices: Sequence[Floats] = ()) -> list[Floats]:
    """The encoded vectors with a single other choice or count that matters there, then those with some given choices.

    All have the scalars of the one vector, and each means another shape.
    """
    active = set(space.active(space.decode(vector)))
    beside = []
    for column, parameter in enumerate(space):
        if parameter.name not in active:
            continue
        beside += [_with(vector, column, k) for k in range(parameter.classes) if k != vector[column]]
        if isinstance(parameter, Scalar):
            beside += [_with(vector, column, parameter.encode(count)) for count in _nearby(parameter, vector[column])]
    beside += [np.where(space.scalars, vector, chosen) for chosen in choices]
    return space.distinct([vector, *beside])[1:]


def _nearby(parameter: Scalar, encoded: float) -> list[int]:
    """The whole numbers beside the encoded one, the nearest first, where they may count parts."""
    if not parameter.whole or parameter.high - parameter.low >= _COUNTABLE:
        return []
    count = int(parameter.decode(encoded))
    return [count + step for step in (-1, 1, -2, 2) if parameter.low <= count + step <= parameter.high]


def _with(vector: Floats, column: int, encoded: float) -> Floats:
    other = vector.copy()
    other[column] = encoded
    return other


Bounds = tuple[Floats, Floats]
"""The least and the greatest scalars of one reference, encoded, (P,) each."""


def points(
    candidate: Candidate, move: BuildingMove, space: ParameterSpace, bounds: Bounds, part: slice, rng: Generator
) -> Iterator[Floats]:
    """Encoded vectors inside the bounds that a move tries for a combination, see ``moves``."""
    if candidate.residual is None:
        yield candidate.vector
        return
    least, most = bounds
    active = set(space.active(space.decode(candidate.vector)))
    free = np.array([isinstance(parameter, Scalar) and parameter.name in active for parameter in space])
    free &= most > least
    if not free.any():
        return
    if candidate.slopes is None:
        yield from _probed(candidate.vector, free, bounds, move if isinstance(move, Probe) else Probe(1))
        return
    step = move if isinstance(move, Step) else Step(1)
    slopes, residual = np.ascontiguousarray(candidate.slopes[free, part]), candidate.residual[part]
    for k in range(step.steps):
        reach = candidate.reach * _SHORTER**k
        low = np.clip(least - candidate.vector, -reach, 0.0)[free]
        high = np.clip(most - candidate.vector, 0.0, reach)[free]
        vector = candidate.vector.copy()
        vector[free] += bounded_step(slopes, residual, low, high, _FLOORS[k % len(_FLOORS)])
        yield vector
    for _ in range(step.scatter):
        away = rng.standard_normal(len(free)) * candidate.spread
        yield np.where(free, np.clip(candidate.vector + away, least, most), candidate.vector)


def _probed(centre: Floats, free: np.ndarray, bounds: Bounds, probe: Probe) -> Iterator[Floats]:
    """One vector for each free scalar, to the side where there is room, or one to each side."""
    least, most = bounds
    for p in np.flatnonzero(free).tolist():
        above, below = (min(probe.size, room) for room in (most[p] - centre[p], centre[p] - least[p]))
        for side in (above, -below) if probe.both else (above if above >= below else -below,):
            yield _with(centre, p, centre[p] + side)
