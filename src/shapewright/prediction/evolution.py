"""A search on the procedure itself for costs that are single numbers, without residuals to descend along.

Successive halving over the likeliest combinations of discrete choices, and an evolution strategy over the scalars of
those that remain. All references advance together, so that shapes are built and measured in large batches.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Build, Workers
from shapewright.parameters import Parameters, ParameterSpace, Scalar
from shapewright.prediction.refinement import likeliest
from shapewright.shapes import Mesh

Floats = NDArray[np.float64]
Measure = Callable[[Sequence[tuple[int, Mesh]]], Sequence[float]]
"""Costs of replicas, each given with the index of its reference; lower is better."""


@dataclass(frozen=True)
class Budget:
    """How long to search. rungs: of each round, how many combinations it tries and how many shapes of each."""

    rungs: tuple[tuple[int, int], ...]

    @property
    def evaluations(self) -> int:
        """Shapes built for each reference, at most."""
        return sum(arms * points for arms, points in self.rungs)

    def within(self, evaluations: float) -> Budget:
        """The first rounds that fit in so many shapes, at least one."""
        spent = np.cumsum([arms * points for arms, points in self.rungs])
        return Budget(self.rungs[: max(1, int((spent <= evaluations).sum()))])


_SPREAD = 0.08
_SHRINK, _GROW = 0.7, 1.3


@dataclass(eq=False)
class _Arm:
    """One combination of discrete values: the best scalars found for it, and the spread of the next ones."""

    centre: Floats
    cost: float = np.inf
    spread: float = _SPREAD


@dataclass(eq=False)
class _Search:
    """The search for one reference."""

    arms: list[_Arm]
    rng: np.random.Generator
    limits: tuple[Floats, Floats]
    best: Parameters | None = None
    cost: float = field(default=np.inf)


def refine(
    space: ParameterSpace,
    inferred: Sequence[NDArray[np.float32]],
    crew: Workers,
    measure: Measure,
    budget: Budget,
    seed: int = 0,
    known: Sequence[Parameters | None] | None = None,
    progress: Callable[[int, int], None] | None = None,
    within: tuple[Floats, Floats] | None = None,
    spread: float = _SPREAD,
    enough: float = -np.inf,
) -> list[Parameters]:
    """Better parameters for each reference, or the predicted ones where the search finds none.

    inferred: per parameter (N,) encoded scalars or (N, classes) probabilities, as the predictor gives. known:
    parameters to start from as well, such as those of the previous iteration. within: the least and the greatest
    encoded scalars of each reference, (N, P), the whole space by default. spread: of the first steps, encoded. enough:
    a cost at which the search for a reference ends. The cost never rises above that of the prediction. A reference's
    result does not depend on the other references.
    """
    low, high = within or (np.zeros((1, len(space))), np.ones((1, len(space))))
    count = len(inferred[0])
    widest = max(arms for arms, _ in budget.rungs)
    searches = []
    for i in range(count):
        starts = likeliest(space, [column[i] for column in inferred], widest)
        if known and (given := known[i]) is not None:
            starts = [*starts[: widest - 1], space.encode(given)]
        limits = (low[min(i, len(low) - 1)], high[min(i, len(high) - 1)])
        arms_of = [_Arm(centre, spread=spread) for centre in starts]
        searches.append(_Search(arms_of, np.random.default_rng([seed, i]), limits))
    scalars = np.array([isinstance(parameter, Scalar) for parameter in space])
    for number, (arms, points) in enumerate(budget.rungs):
        asked: list[tuple[int, _Arm, Floats]] = []
        for i, search in enumerate(searches):
            if search.cost <= enough:
                continue
            search.arms = sorted(search.arms, key=lambda arm: arm.cost)[:arms]
            for arm in search.arms:
                proposed = _propose(space, arm, points, scalars, search)
                asked += [(i, arm, point) for point in proposed]
        vectors = [space.canonical(space.decode(point)) for _, _, point in asked]
        costs = _costs(measure, [i for i, _, _ in asked], crew.build(vectors))
        _learn(searches, asked, vectors, costs)
        if progress:
            progress(number + 1, len(budget.rungs))
    fallback = [space.canonical(space.decode(search.arms[0].centre)) for search in searches]
    return [search.best or predicted for search, predicted in zip(searches, fallback, strict=True)]


def _propose(
    space: ParameterSpace, arm: _Arm, points: int, scalars: NDArray[np.bool_], search: _Search
) -> list[Floats]:
    """The arm's centre when its cost is not known yet, and points around it, inside the limits."""
    active = set(space.active(space.decode(arm.centre)))
    free = scalars & np.array([name in active for name in space.names])
    steps = search.rng.standard_normal((points, len(arm.centre))) * arm.spread * free
    proposed = [np.where(scalars, np.clip(arm.centre + step, *search.limits), arm.centre) for step in steps]
    if np.isinf(arm.cost):
        proposed[0] = arm.centre
    return proposed if free.any() else proposed[:1]


def _costs(measure: Measure, references: Sequence[int], builds: Sequence[Build]) -> Floats:
    costs = np.full(len(builds), np.inf)
    built = [k for k, build in enumerate(builds) if isinstance(build.shape, Mesh)]
    pairs = [(references[k], shape) for k in built if isinstance(shape := builds[k].shape, Mesh)]
    costs[built] = measure(pairs)
    return costs


def _learn(
    searches: Sequence[_Search],
    asked: Sequence[tuple[int, _Arm, Floats]],
    vectors: Sequence[Parameters],
    costs: Floats,
) -> None:
    """Move each arm to the best point found, and let its spread follow its success."""
    before = {id(arm): arm.cost for _, arm, _ in asked}
    for (i, arm, point), vector, cost in zip(asked, vectors, costs, strict=True):
        if cost < arm.cost:
            arm.centre, arm.cost = point, float(cost)
        if cost < searches[i].cost:
            searches[i].best, searches[i].cost = vector, float(cost)
    for arm in {id(arm): arm for _, arm, _ in asked}.values():
        if np.isfinite(before[id(arm)]):
            arm.spread *= _GROW if arm.cost < before[id(arm)] else _SHRINK
