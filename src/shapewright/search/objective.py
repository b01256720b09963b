"""What a search makes small: how replicas differ from their references."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

from shapewright.parameters import Prediction
from shapewright.shapes import Floats, Shape
from shapewright.threads import in_threads

Measure = Callable[[Sequence[tuple[int, Shape]]], Sequence[Floats | None]]
"""How replicas, each given with the index of its reference, differ from it: vectors (K,) whose sum of absolute values
is the cost; None where the two cannot be compared."""


class Objective(Protocol):
    """One reference as a search sees it."""

    def residual(self, replica: Shape) -> Floats | None:
        """(K,): how a replica differs from the reference, the sum of absolute values is the cost.

        None where the two cannot be compared.
        """


@dataclass(frozen=True, eq=False)
class Residuals:
    """The measure of a search for several references.

    objectives: of each; None for one that nothing can replicate.
    threads: that measure; one where it was sent to, since a machine does other chunks beside it.
    """

    objectives: Sequence[Objective | None]
    threads: int | None = None

    def __call__(self, pairs: Sequence[tuple[int, Shape]]) -> Sequence[Floats | None]:
        return in_threads(self._residual, pairs, self.threads)

    def __reduce__(self) -> tuple[Any, ...]:
        return Residuals, (self.objectives, 1)

    def take(self, rows: Sequence[int]) -> Residuals:
        """The measure for some of the references."""
        return replace(self, objectives=[self.objectives[row] for row in rows])

    def _residual(self, pair: tuple[int, Shape]) -> Floats | None:
        objective = self.objectives[pair[0]]
        return objective.residual(pair[1]) if objective else None


def measure_of(objectives: Sequence[Objective | None], threads: int | None = None) -> Residuals:
    """The measure of a search for several references, on several threads; None for one that nothing can replicate."""
    return Residuals(objectives, threads)


@dataclass(frozen=True, eq=False)
class Criterion:
    """What a search for several references makes small, and how far.

    The cost of a replica is the sum of absolute values of its residual, or of a part of it. It rises with minus the
    logarithm of the probability of the choices: of those that look alike the likelier wins.
    """

    measure: Measure  # the residuals of replicas
    parts: Sequence[slice] = (slice(None),)  # of the residuals, coarse to fine, that moves may go by
    goal: float = -math.inf  # the cost up to which a reference is surely compatible; -inf where costs do not tell
    enough: float = -math.inf  # a cost, by the last part, at which the search for a reference ends
    surprise_cost: float = 0.0  # by how much it rises
    reach: float = 1.0  # by which what moves call near to the goal is multiplied: more where noise is in all costs

    @property
    def divisible(self) -> bool:
        """Whether it has ``take``: a measure of the caller's own cannot be taken apart."""
        return isinstance(self.measure, Residuals)

    def take(self, rows: Sequence[int]) -> Criterion:
        """That of some of the references."""
        assert isinstance(self.measure, Residuals)
        return replace(self, measure=self.measure.take(rows))

    def surprise(self, prediction: Prediction, row: int, vector: Floats) -> float:
        """What it costs that the choices of an encoded vector (P,) are unlikely for one reference."""
        return self.surprise_cost and self.surprise_cost * prediction.surprise(row, vector)
