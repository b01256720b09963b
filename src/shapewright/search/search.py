"""Refinement: a search on the procedure itself, from the prediction, by the measure that judges.

The likeliest combinations of discrete choices are tried; the scalars of the best are moved by Gauss-Newton steps on
what still differs from the reference. All references advance together, move by move, so that shapes are built and
measured in large batches.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from shapewright.building import Crew, Workers
from shapewright.parameters import Parameters, Prediction
from shapewright.search.budgets import QUICK, Budget
from shapewright.search.candidates import Bounds, Candidate, others, points
from shapewright.search.exhaustion import best_of_all, is_small
from shapewright.search.moves import BuildingMove, Continue, Probe, Return, Scan, Step, SwitchChoices
from shapewright.search.objective import Criterion
from shapewright.search.parts import in_parts
from shapewright.shapes import Floats

_MOVED = 0.98
"""Share of its cost that a search must have left after a round that brought something. By trial on tables."""
_SAME = 1e-6
"""Between encoded starts that are one: predictions are of single precision."""
_LIKELIEST = 4
"""Combinations that are tried again because they are the likeliest. By trial on shelves and chairs."""


@dataclass(frozen=True, eq=False)
class SearchStart:
    """Where the searches for N references begin, and where they may go.

    With ``new`` a search ends where the known parameters turn out the best and nothing new matters there.
    """

    prediction: Prediction
    known: Sequence[Parameters | None] | None = None  # for each reference parameters to start from as well, or None
    new: AbstractSet[str] | None = None  # scalars that are new or other than when the known ones were searched for
    beside: Sequence[Sequence[Parameters]] | None = None  # for each reference more to start from
    within: tuple[Floats, Floats] | None = None  # the least and the greatest encoded scalars of each reference, (N, P)
    numbers: Sequence[int] | None = None  # by which each reference draws its random points; None for 0 to N - 1
    many: int | None = None  # how many there are in all, where they are some of these; None: these

    def take(self, rows: Sequence[int]) -> SearchStart:
        """Those of some of the references."""
        some = np.asarray(rows)
        return replace(
            self,
            prediction=self.prediction.take(some),
            known=self.known and [self.known[row] for row in rows],
            beside=self.beside and [self.beside[row] for row in rows],
            within=self.within and (self.within[0][some], self.within[1][some]),
            numbers=[self.numbers[row] if self.numbers else row for row in rows],
        )


@dataclass(eq=False)
class _Search:
    """The search for one reference."""

    row: int  # of the reference in the prediction
    candidates: list[Candidate]  # those that take part
    bounds: Bounds
    rng: np.random.Generator
    part: slice  # of the residuals, by which they are compared
    best: Parameters | None = None  # of the least cost by the present part; None before any shape was measured
    cost: float = np.inf
    resting: Candidate | None = None  # the best candidate, while others are tried
    before: float = np.inf  # the cost at the last ``Continue``
    idle: int = 0  # rounds in a row without progress
    done: bool = False

    def sort(self) -> None:
        """The cheapest first; of those that were not measured yet the likeliest."""
        self.candidates.sort(key=lambda candidate: (candidate.cost, candidate.surprise))


def refine(
    start: SearchStart,
    criterion: Criterion,
    crew: Workers,
    budget: Budget = QUICK,
    seed: int = 0,
    progress: Callable[[int, int], None] | None = None,
) -> list[Parameters]:
    """Better parameters for each reference, or the predicted ones where the search finds none.

    progress: is told how many of the budget's rounds are over, or of the parts in which an executor searches. The cost
    never rises above that of the prediction, where the criterion has one part. A reference's result does not depend on
    the other references, but for spaces of few shapes: all of them are built once where the references together may
    build as many.
    """
    space, count = start.prediction.space, len(start.prediction)
    may = budget.evaluations(0) * (count if start.many is None else start.many)
    small = start.within is None and is_small(space) and space.combinations <= may
    if isinstance(crew, Workers) and crew.executor and criterion.divisible:
        search = partial(_refined, budget=budget, seed=seed, small=small)
        return in_parts(start, criterion, crew, count, search, progress)
    return _refined(start, criterion, crew, budget, seed, small, progress)


def _refined(
    start: SearchStart,
    criterion: Criterion,
    crew: Crew,
    budget: Budget,
    seed: int,
    small: bool,
    progress: Callable[[int, int], None] | None = None,
) -> list[Parameters]:
    """small: all shapes of the space are built."""
    if small:
        return best_of_all(start.prediction, criterion, crew, progress)
    space, parts = start.prediction.space, criterion.parts
    searches = [_begun(start, criterion, budget, seed, row) for row in range(len(start.prediction))]
    fallback = [space.canonical(space.decode(search.candidates[0].vector)) for search in searches]
    scale, rounds = 0, 0
    for move in budget.moves:
        going = [search for search in searches if not search.done]
        for search in going:
            search.sort()
        if isinstance(move, BuildingMove):
            _built(going, move, start, criterion, crew, budget.patience if rounds > 1 else None)
            rounds += 1
            if progress:
                progress(rounds, budget.rounds)
            continue
        if isinstance(move, Continue):
            for search in going:
                search.done |= search.cost >= move.share * search.before
                search.before = search.cost
            continue
        before = scale
        if not isinstance(move, Return) and move.scale is not None:
            scale = min(move.scale, len(parts) - 1)
        for search in going:
            best = search.candidates[0]
            if scale != before or isinstance(move, Return):
                keep = len(search.candidates) if isinstance(move, SwitchChoices) else move.keep
                _compare(search, start, parts[scale], keep, isinstance(move, Return) or scale == len(parts) - 1)
            if isinstance(move, SwitchChoices) and best.residual is not None:
                _switch(search, best, move, start, criterion, budget)
    for search in searches:
        if search.resting:  # the budget was cut while the best one rested
            _compare(search, start, parts[-1], len(search.candidates), back=True)
    return [search.best or predicted for search, predicted in zip(searches, fallback, strict=True)]


def _begun(start: SearchStart, criterion: Criterion, budget: Budget, seed: int, row: int) -> _Search:
    """The search for one reference with its first candidates."""
    space, prediction, most = start.prediction.space, start.prediction, budget.combinations
    vectors = prediction.likeliest(row, most - budget.simple)
    vectors += [space.encode(space.defaults), *others(space, space.encode(space.defaults))][: budget.simple]
    if start.beside:
        more = [space.encode(values) for values in start.beside[row]]
        vectors = [*vectors[:1], *more, *vectors[1:]][:most]
    candidates = [_candidate(start, criterion, budget, row, vector) for vector in vectors]
    if start.known and (given := start.known[row]) is not None:
        known = _candidate(start, criterion, budget, row, space.encode(given))
        known.known = True
        apart = [other for other in candidates if np.abs(other.vector - known.vector).max() > _SAME]
        candidates = [*apart[: max(1, most - 1)], known]
    bounds = np.zeros(len(space)), np.ones(len(space))
    if start.within:
        bounds = start.within[0][row], start.within[1][row]
    rng = np.random.default_rng([seed, start.numbers[row] if start.numbers else row])
    return _Search(row, candidates, bounds, rng, criterion.parts[0])


def _candidate(start: SearchStart, criterion: Criterion, budget: Budget, row: int, vector: Floats) -> Candidate:
    return Candidate(vector, criterion.surprise(start.prediction, row, vector), spread=budget.spread)


def _compare(search: _Search, start: SearchStart, part: slice, keep: int, back: bool) -> None:
    """Go by a part of the residuals with the best of the candidates, and with the one that rested if it comes back."""
    search.part, search.candidates = part, search.candidates[:keep]
    if back and search.resting:
        search.candidates, search.resting = [search.resting, *search.candidates], None
    for candidate in search.candidates:
        candidate.go_by(part)
    search.sort()
    best, space = search.candidates[0], start.prediction.space
    if best.residual is not None:
        search.best, search.cost = space.canonical(space.decode(best.vector)), best.cost


def _switch(
    search: _Search, best: Candidate, move: SwitchChoices, start: SearchStart, criterion: Criterion, budget: Budget
) -> None:
    """Go on from other choices than the best candidate's, where there are some."""
    space = start.prediction.space
    likely = start.prediction.likeliest(search.row, _LIKELIEST) if move.to == "likely" else ()
    vectors = others(space, best.vector, likely)
    if move.to == "defaults":
        vectors = [np.where(space.scalars, space.encode(space.defaults), chosen) for chosen in (best.vector, *vectors)]
    if vectors:
        search.resting = best
        search.candidates = [_candidate(start, criterion, budget, search.row, vector) for vector in vectors]


def _built(
    going: Sequence[_Search],
    move: BuildingMove,
    start: SearchStart,
    criterion: Criterion,
    crew: Crew,
    patience: int | None,
) -> None:
    """Build and measure what a move tries in each search, learn from it, and see which searches end."""
    space = start.prediction.space
    asked = [
        (search, candidate, vector)
        for search in going
        for candidate in _taking_part(search, move, criterion)
        for vector in points(candidate, move, space, search.bounds, search.part, search.rng)
    ]
    parameters = [space.canonical(space.decode(vector)) for _, _, vector in asked]
    shapes = [build.shape for build in crew.build(parameters)]
    pairs = [(search.row, shape) for (search, _, _), shape in zip(asked, shapes, strict=True) if shape is not None]
    measures = iter(criterion.measure(pairs))
    residuals = [None if shape is None else next(measures) for shape in shapes]
    before = {search: search.cost for search, _, _ in asked}
    measured: dict[Candidate, list[tuple[float, Floats, Floats]]] = {candidate: [] for _, candidate, _ in asked}
    for (search, candidate, vector), values, residual in zip(asked, parameters, residuals, strict=True):
        if residual is not None:
            cost = candidate.cost_of(residual, search.part)
            measured[candidate].append((cost, vector, residual))
            if cost < search.cost:
                search.best, search.cost = values, cost
    for candidate, found in measured.items():
        candidate.learn(found)
    for search in going:
        if patience is not None and search in before:
            search.idle = search.idle + 1 if search.cost >= _MOVED * before[search] else 0
            search.done |= search.idle >= patience
        search.done |= search.part == criterion.parts[-1] and search.cost <= criterion.enough
        search.done |= _known_is_best(search, start)


def _taking_part(search: _Search, move: BuildingMove, criterion: Criterion) -> list[Candidate]:
    """The candidates that a move tries something for, the best first."""
    best = search.candidates[0]
    near = move.near if isinstance(move, Step) else None
    if near is not None and (best.known or not criterion.goal < search.cost <= near * criterion.reach * criterion.goal):
        return []  # a known best was explored by the search that found it
    dearest = np.inf if isinstance(move, Scan) else move.rival * best.cost
    some = [candidate for candidate in search.candidates[: move.combinations] if not candidate.cost > dearest]
    if isinstance(move, Probe) and move.again:
        for candidate in some:
            candidate.slopes = None
    return some


def _known_is_best(search: _Search, start: SearchStart) -> bool:
    """Whether the known start turns out the best, and nothing that matters there is new."""
    best, space = min(search.candidates, key=lambda candidate: candidate.cost), start.prediction.space
    if start.new is None or not best.known or best.residual is None:
        return False
    return not start.new & set(space.active(space.decode(best.vector)))
