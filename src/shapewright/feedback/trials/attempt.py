"""A changed procedure put to the test: built and searched on the references that it is for, measured by the judge."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from shapewright.building import Workers
from shapewright.building.sent import link_all
from shapewright.comparison.light_field import RAW_SCALE
from shapewright.comparison.surfaces import area
from shapewright.feedback.case import Replica
from shapewright.feedback.parts.attachment import separate
from shapewright.feedback.trials.outcome import Outcome
from shapewright.judging.judge import Judge
from shapewright.judging.verdict import apart_of
from shapewright.parameters import Parameters, ParameterSpace, Prediction
from shapewright.procedures import load_procedure
from shapewright.search.budgets import Budget
from shapewright.search.moves import Probe, Scan, Step
from shapewright.search.objective import Criterion
from shapewright.search.search import SearchStart, refine
from shapewright.shapes import Mesh

BRIEF = Budget((Scan(2), Probe(1), *(Step(1, scatter=4),) * 2))
"""Tells whether a change is worth more."""
FEW_SCALARS = Budget((Scan(1), Probe(1), *(Step(1, scatter=2),) * 2))
"""For the new parameters alone."""
LONG = Budget((Scan(2), Probe(1), *(Step(1, scatter=6),) * 9), patience=3)
"""For all scalars, with the choices at the start."""
OTHER_CHOICES = Budget((Scan(6), Probe(2), *(Step(1, scatter=6),) * 6), patience=3)
"""From several combinations of choices. All four were chosen on seed 0 of ``benchmarks/suggestions.py rules``."""
ENOUGH = 0.88
"""Of the goal, where a search ends: its costs are upper bounds of what is judged."""
_UNLIKE = 0.1  # probability of other choices than those at the start
_LENDERS = 3  # replicated references with different choices, the nearest of which others borrow from
_SAME = 1e-6  # relative difference of bounds and areas up to which two shapes are one


@contextmanager
def turned_to(source: str, crew: Workers) -> Iterator[Workers]:
    """Workers that turn to the procedure of the same name in a changed source.

    It is loaded from a folder that is removed at the end; what lies beside the author's file is linked there. Raises
    ProcedureError when the source does not load.
    """
    before = crew.procedure
    with tempfile.TemporaryDirectory(prefix="shapewright-") as folder:
        path = Path(folder) / (before.path.name if before.path else f"{before.name}.py")
        path.write_text(source, encoding="utf-8")
        if crew.home:
            link_all(crew.home, path.parent)
        crew.turn_to(load_procedure(f"{path}:{before.name}", before.working))
        yield crew


def nearest_starts(
    crew: Workers, candidates: Mapping[int, Sequence[Parameters]], judge: Judge, pieces: Mapping[int, int]
) -> Outcome:
    """The nearest of some candidates for each reference (by row), moved into the Ranges and built without a search.

    Their distances are upper bounds; by the paper's judge so is what lies apart. Of several candidates, the nearest
    that falls into no more pieces than it may. References of which nothing can be built are left out.
    """
    space = crew.procedure.space
    asked = [(row, space.carry(values)) for row, several in candidates.items() for values in several]
    builds = crew.build([values for _, values in asked])
    pairs = zip(asked, builds, strict=True)
    made = [(row, build.parameters, build.shape) for (row, _), build in pairs if isinstance(build.shape, Mesh)]
    costs = judge.search_costs([(row, mesh) for row, _, mesh in made])
    values = [math.nan] * len(made)
    if judge.settings.judge == "fidelity":
        values = judge.fidelities([mesh for _, _, mesh in made], [row for row, _, _ in made])
    several: dict[int, list[Replica]] = {}
    for cost, value, (row, parameters, mesh) in zip(costs, values, made, strict=True):
        if np.isfinite(cost):
            away = cost / judge.goal if math.isnan(value) else apart_of(value, judge.settings)
            replica = Replica(row, parameters, mesh, cost / RAW_SCALE, apart=away, fidelity=value)
            several.setdefault(row, []).append(replica)
    starts = []
    for row, choices in several.items():
        choices.sort(key=lambda start: start.apart)
        whole = (start for start in choices if separate(start.mesh) <= pieces[row]) if len(choices) > 1 else ()
        starts.append(next(iter(whole), choices[0]))
    return Outcome.of(starts)


def outcome_of(
    crew: Workers,
    starts: Mapping[int, Parameters],
    judge: Judge,
    budget: Budget | None,
    turn: int = 0,
    enough: float = ENOUGH,
    only: Collection[str] | None = None,
    sure: str | None = None,
) -> Outcome:
    """Search for each reference (by row) from the parameters given, and judge the replicas.

    budget: None to judge the parameters themselves, moved into the procedure's Ranges. turn: number of the search for
    the same references, for other random points. enough: of the goal, at which a search ends.
    only: names of the scalars that it may change, by default all. sure: the name of a choice that it keeps wherever it
    tries others.
    """
    space, rows = crew.procedure.space, list(starts)
    vectors = [space.carry(values) for values in starts.values()]
    if budget and rows:
        encoded = np.array([space.encode(values) for values in vectors])
        fixed = np.array([only is not None and name not in only for name in space.names])
        begin = SearchStart(
            Prediction.of(space, vectors, _UNLIKE, most=1.0 - _UNLIKE, sure=[sure] if sure else []),
            within=(np.where(fixed, encoded, 0.0), np.where(fixed, encoded, 1.0)),
        )
        criterion = Criterion(judge.measure(rows), enough=enough * judge.goal)
        vectors = refine(begin, criterion, crew, budget, judge.settings.seed + turn)
    builds = crew.build(vectors)
    standings = judge.standings(builds, rows)
    replicas = [Replica.of(row, build, standing) for row, build, standing in zip(rows, builds, standings, strict=True)]
    return Outcome.of(replica for replica in replicas if replica)


def with_borrowed_choices(
    space: ParameterSpace, outcome: Outcome, starts: Mapping[int, Parameters]
) -> dict[int, list[Parameters]]:
    """Candidates for the references of ``starts`` that are not replicated, with the choices with which others are.

    A shape that lacks a part may be nearest with choices to which the new part does not belong. Candidates are
    another's parameters, its choices with the reference's own numbers, and one choice of its alone.
    """
    lenders: dict[tuple[object, ...], Parameters] = {}
    for row in sorted(outcome.replicated, key=outcome.apart):
        parameters = outcome.replicas[row].parameters
        lenders.setdefault(tuple(parameters[p.name] for p in space if p.classes), parameters)
    candidates: dict[int, list[Parameters]] = {}
    for row in starts:
        own, known = space.carry(starts[row]), [space.carry(starts[row])]
        for lender in list(lenders.values())[:_LENDERS] if row not in outcome.replicated else ():
            for values in _mixed(space, own, lender):
                if (new := space.canonical(values)) not in known:
                    known.append(new)
        if len(known) > 1:
            candidates[row] = known[1:]
    return candidates


def _mixed(space: ParameterSpace, own: Parameters, other: Parameters) -> Iterator[Parameters]:
    """The other parameters; these with a reference's own numbers, where they matter; its own with one other choice."""
    active = space.active(own)
    numbers = {p.name: own[p.name] for p in space if not p.classes and p.name in active}
    choices = {p.name: own[p.name] for p in space if p.classes}
    yield other
    yield {**other, **numbers}
    for name in choices:
        if own[name] != other[name]:
            yield {**other, **numbers, **choices, name: other[name]}


def builds_the_same(crew: Workers, replicas: Sequence[Replica]) -> bool:
    """Whether the procedure still builds these shapes for these parameters."""
    builds = crew.build([crew.procedure.space.carry(replica.parameters) for replica in replicas])
    pairs = zip(builds, replicas, strict=True)
    return all(isinstance(build.shape, Mesh) and same(replica.mesh, build.shape) for build, replica in pairs)


def same(mesh: Mesh, other: Mesh) -> bool:
    """Whether two shapes have the same bounds, and as much surface."""
    apart = np.abs(other.bounds - mesh.bounds).max() / float(mesh.extent.max())
    return bool(max(apart, abs(area(other) - area(mesh)) / area(mesh)) <= _SAME)
