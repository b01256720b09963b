"""Refinement: a search on the procedure itself, from the prediction, by the measure that judges.

The likeliest combinations of discrete choices are tried; the scalars of the best are moved by Gauss-Newton steps on
what still differs from the reference; references that end just short of compatible are explored further, at random as
well. All references advance together, so that shapes are built and measured in large batches.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Build, Workers
from shapewright.parameters import Parameters, ParameterSpace, Prediction, Scalar
from shapewright.search.budgets import QUICK, Budget, Round
from shapewright.search.combinations import others, plain
from shapewright.search.descent import bounded_step, learn_slope
from shapewright.search.objective import Measure

Floats = NDArray[np.float64]

_REACH, _FARTHEST = 0.15, 0.3
_SPREAD = 0.1
_FLOORS = (20.0, 1000.0)
_MOVED = 0.98
"""Share of its cost that a search must have left after a round that brought something."""
_SAME = 1e-6
"""Between encoded starts that are one: predictions are of single precision."""
_LIKELIEST = 4
"""Combinations that are tried again because they are the likeliest."""
_LOCAL = 0.1
"""How far a point may lie from the best one for the linear model to learn from it."""


@dataclass(eq=False)
class _Arm:
    """One combination of discrete values: the best scalars found for it, and a linear model around them.

    cost: with the doubt, what it costs that the combination is unlikely.
    """

    centre: Floats
    doubt: float = 0.0
    known: bool = False
    cost: float = np.inf
    residual: Floats | None = None
    slopes: Floats | None = None
    reach: float = _REACH
    spread: float = _SPREAD


@dataclass(eq=False)
class _Search:
    """The search for one reference."""

    arms: list[_Arm]
    rng: np.random.Generator
    low: Floats
    high: Floats
    best: Parameters | None = None
    cost: float = field(default=np.inf)
    kept: _Arm | None = None
    idle: int = 0
    done: bool = False

    def leave(self, best: _Arm, starts: Sequence[_Arm]) -> None:
        """Go on from other starts, while the best arm rests."""
        if starts:
            self.kept, self.arms = best, list(starts)

    def focus(self, space: ParameterSpace, part: slice, combinations: int, last: bool) -> None:
        """Go by another part of the residuals, with the best of the arms."""
        self.arms = self.arms[:combinations]
        if last and self.kept:
            self.arms, self.kept = [self.kept, *self.arms], None
        for arm in self.arms:
            arm.reach = _REACH
            arm.cost = np.inf if arm.residual is None else float(np.abs(arm.residual[part]).sum()) + arm.doubt
        self.arms.sort(key=lambda arm: arm.cost)
        if self.arms[0].residual is not None:
            self.best, self.cost = space.canonical(space.decode(self.arms[0].centre)), self.arms[0].cost

    def settled(self, space: ParameterSpace, new: AbstractSet[str]) -> bool:
        """Whether an earlier search ended at the best there is, and nothing that matters there is new."""
        best = self.arms[0]
        return best.known and best.residual is not None and not new & set(space.active(space.decode(best.centre)))

    def worth(self, near: float | None, goal: float | None) -> bool:
        """Whether a round for references near the goal is for this one; not where an earlier search ended already."""
        if near is None:
            return True
        return goal is not None and goal < self.cost <= near * goal and not self.arms[0].known


@dataclass(frozen=True, eq=False)
class _Trial:
    """A point to build: for which reference and which arm."""

    reference: int
    arm: _Arm
    point: Floats


def refine(
    prediction: Prediction,
    crew: Workers,
    measure: Measure,
    budget: Budget = QUICK,
    seed: int = 0,
    known: Sequence[Parameters | None] | None = None,
    goal: float | None = None,
    progress: Callable[[int, int], None] | None = None,
    within: tuple[Floats, Floats] | None = None,
    spread: float = _SPREAD,
    enough: float = -np.inf,
    new: AbstractSet[str] | None = None,
    parts: Sequence[slice] = (slice(None),),
    doubt: float = 0.0,
) -> list[Parameters]:
    """Better parameters for each reference, or the predicted ones where the search finds none.

    known: for each reference parameters to start from as well. new: names of scalars that are new or other than when
    the known ones were searched for; with it, no more is spent where these turn out the best and none is new. goal: the
    cost up to which a reference counts as compatible; without it no round is spent on those that are near. within: the
    least and the greatest encoded scalars of each reference, (N, P), the whole space by default. spread: of the first
    random points, encoded. parts: of the residuals, coarse to fine, that rounds may go by; a round that asks for a
    further one goes by the last. enough: a cost, by the last part, at which the search for a reference ends. doubt: how
    much the cost of a choice rises with minus the logarithm of the probability predicted for it: of those that look
    alike the likelier wins. The cost never rises above that of the prediction, where there is one part. A reference's
    result does not depend on the other references.
    """
    space, count = prediction.space, len(prediction)
    widest = budget.rounds[0].combinations
    low, high = within or (np.zeros((count, len(space))), np.ones((count, len(space))))
    searches = []

    def arm(i: int, centre: Floats, known: bool = False) -> _Arm:
        unlikely = doubt and doubt * prediction.surprise(i, centre)
        return _Arm(centre, unlikely, known, spread=spread)

    for i in range(count):
        centres = prediction.likeliest(i, widest - budget.simple)
        centres += [space.encode(space.defaults), *others(space, space.encode(space.defaults))][: budget.simple]
        arms = [arm(i, centre) for centre in centres]
        if known and (given := known[i]) is not None:
            start = arm(i, space.encode(given), known=True)
            apart = [other for other in arms if np.abs(other.centre - start.centre).max() > _SAME]
            arms = [*apart[: max(1, widest - 1)], start]
        searches.append(_Search(arms, np.random.default_rng([seed, i]), low[i], high[i]))
    fallback = [space.canonical(space.decode(search.arms[0].centre)) for search in searches]
    part = parts[0]
    for number, turn in enumerate(budget.rounds):
        asked: list[_Trial] = []
        before, part = part, parts[min(turn.part, len(parts) - 1)]
        for i, search in enumerate(searches):
            search.arms.sort(key=lambda arm: arm.cost)
            search.done |= before == parts[-1] and search.cost <= enough
            if search.done or (new is not None and search.settled(space, new)):
                continue
            best = search.arms[0]
            if part != before or turn.back:
                search.focus(space, part, turn.combinations, turn.back or part == parts[-1])
            if turn.other and best.residual is not None:
                likely = prediction.likeliest(i, _LIKELIEST) if turn.other == "likely" else ()
                starts = others(space, best.centre, likely)
                if turn.other == "plain":
                    starts = [plain(space, start) for start in (best.centre, *starts)]
                search.leave(best, [arm(i, start) for start in starts])
            if search.worth(turn.near, goal):
                for one in search.arms[: turn.combinations]:
                    if one.cost > turn.rival * search.arms[0].cost:
                        break
                    one.slopes = None if turn.afresh else one.slopes
                    asked += [_Trial(i, one, point) for point in _propose(space, one, turn, search, part)]
        vectors = [space.canonical(space.decode(trial.point)) for trial in asked]
        residuals = _residuals(measure, [trial.reference for trial in asked], crew.build(vectors))
        costs = {trial.reference: searches[trial.reference].cost for trial in asked}
        _learn(searches, asked, vectors, residuals, part)
        if budget.patience is not None and number > 1:
            for i, cost in costs.items():
                searches[i].idle = searches[i].idle + 1 if searches[i].cost >= _MOVED * cost else 0
                searches[i].done |= searches[i].idle >= budget.patience
        if progress:
            progress(number + 1, len(budget.rounds))
    for search in searches:
        if search.kept:  # the rounds were cut short while the best one rested
            search.focus(space, parts[-1], len(search.arms), last=True)
    return [search.best or predicted for search, predicted in zip(searches, fallback, strict=True)]


def _propose(space: ParameterSpace, arm: _Arm, turn: Round, search: _Search, part: slice) -> Iterator[Floats]:
    """Points inside the limits: the arm's centre, then one for each free scalar, then steps and strays."""
    if arm.residual is None:
        yield arm.centre
        return
    active = set(space.active(space.decode(arm.centre)))
    free = np.array([isinstance(parameter, Scalar) and parameter.name in active for parameter in space])
    free &= search.high > search.low
    if not free.any():
        return
    if arm.slopes is None:
        for p in np.flatnonzero(free):
            above, below = search.high[p] - arm.centre[p], arm.centre[p] - search.low[p]
            one = turn.probe if turn.probe <= above else -turn.probe
            for side in (min(turn.probe, above), -min(turn.probe, below)) if turn.both else (one,):
                point = arm.centre.copy()
                point[p] += side
                yield point
        return
    slopes, residual = np.ascontiguousarray(arm.slopes[free, part]), arm.residual[part]
    for k in range(turn.steps):
        reach = arm.reach * 0.4**k
        low = np.clip(search.low - arm.centre, -reach, 0.0)[free]
        high = np.clip(search.high - arm.centre, 0.0, reach)[free]
        point = arm.centre.copy()
        point[free] += bounded_step(slopes, residual, low, high, _FLOORS[k % len(_FLOORS)])
        yield point
    for _ in range(turn.strays):
        stray = search.rng.standard_normal(len(free)) * arm.spread
        yield np.where(free, np.clip(arm.centre + stray, search.low, search.high), arm.centre)


def _residuals(measure: Measure, references: Sequence[int], builds: Sequence[Build]) -> list[Floats | None]:
    built = [k for k, build in enumerate(builds) if build.shape is not None]
    found = measure([(references[k], shape) for k in built if (shape := builds[k].shape) is not None])
    residuals: list[Floats | None] = [None] * len(builds)
    for k, residual in zip(built, found, strict=True):
        residuals[k] = residual
    return residuals


def _learn(
    searches: Sequence[_Search],
    asked: Sequence[_Trial],
    vectors: Sequence[Parameters],
    residuals: Sequence[Floats | None],
    part: slice,
) -> None:
    """Keep the best of each reference, and move each arm to the best point found for it."""
    measured: dict[int, tuple[_Arm, list[tuple[float, Floats, Floats]]]] = {}
    for trial, vector, residual in zip(asked, vectors, residuals, strict=True):
        points = measured.setdefault(id(trial.arm), (trial.arm, []))[1]
        if residual is None:
            continue
        cost = float(np.abs(residual[part]).sum()) + trial.arm.doubt
        points.append((cost, trial.point, residual))
        search = searches[trial.reference]
        if cost < search.cost:
            search.best, search.cost = vector, cost
    for arm, points in measured.values():
        searching = arm.slopes is not None
        if arm.residual is not None:
            _model(arm, points)
        best = min(points, key=lambda found: found[0], default=None)
        if best and best[0] < arm.cost:
            if searching:
                moved = float(np.abs(best[1] - arm.centre).max())
                arm.reach = max(min(2.0 * moved, _FARTHEST), 0.5 * arm.reach)
                arm.spread *= 1.3
            arm.cost, arm.centre, arm.residual = best
        elif searching:
            arm.reach *= 0.4
            arm.spread *= 0.75


def _model(arm: _Arm, points: Sequence[tuple[float, Floats, Floats]]) -> None:
    """Make the linear model from the first points, each along one axis; let it learn from others, the nearest last."""
    assert arm.residual is not None
    if arm.slopes is None:
        arm.slopes = np.zeros((len(arm.centre), len(arm.residual)))
        if points:
            steps = np.array([point - arm.centre for _, point, _ in points])
            changes = np.array([residual - arm.residual for _, _, residual in points])
            arm.slopes += steps.T @ changes / np.maximum((steps * steps).sum(axis=0), 1e-12)[:, None]
        return
    near = [(float(np.abs(point - arm.centre).max()), point, residual) for _, point, residual in points]
    for length, point, residual in sorted(near, key=lambda found: -found[0]):
        if length <= _LOCAL:
            learn_slope(arm.slopes, point - arm.centre, residual - arm.residual)
