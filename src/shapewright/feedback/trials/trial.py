"""Trying a changed procedure: refined on the references that it is for, and measured by the judge."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Limits, Workers
from shapewright.comparison.light_field import RAW_SCALE
from shapewright.feedback.parts.attachment import separate
from shapewright.judging.judge import Judge
from shapewright.parameters import Parameters, ParameterSpace
from shapewright.procedures import Procedure, load_procedure
from shapewright.search.budgets import Budget, Round
from shapewright.search.objective import Measure
from shapewright.search.search import refine
from shapewright.shapes import Mesh

GLANCE = Budget((Round(2), Round(1), *(Round(1, 2, 4),) * 2))
PEEK = Budget((Round(1), Round(1), *(Round(1, 2, 2),) * 2))
LOOK = Budget((Round(6), Round(2), *(Round(1, 2, 6),) * 6), patience=3)
SEARCH = Budget((Round(2), Round(1), *(Round(1, 2, 6),) * 9), patience=3)
PROMISING = 1.7  # thresholds: what a first look leaves further away is not searched for
ENOUGH = 0.88  # of the threshold: search costs are upper bounds of what is judged
_SPREAD = 0.1
_LENDERS = 3


@dataclass(frozen=True, eq=False)
class Start:
    """Parameters to begin with, the shape that they make, and its cost: an upper bound of the raw distance."""

    parameters: Parameters
    mesh: Mesh
    cost: float


@dataclass(frozen=True, eq=False)
class Trial:
    """What a changed procedure gave. parameters, replicas, distances: by the index of the reference.

    compatible: indices of those at or below the threshold.
    """

    parameters: Mapping[int, Parameters]
    replicas: Mapping[int, Mesh]
    distances: Mapping[int, float]
    threshold: float

    @classmethod
    def of(cls, starts: Mapping[int, Start], threshold: float) -> Trial:
        """What the parameters gave as they were."""
        return cls(
            {row: start.parameters for row, start in starts.items()},
            {row: start.mesh for row, start in starts.items()},
            {row: start.cost / RAW_SCALE for row, start in starts.items()},
            threshold,
        )

    @property
    def compatible(self) -> tuple[int, ...]:
        return tuple(row for row, distance in self.distances.items() if distance <= self.threshold)

    def standing(self, pieces: Mapping[int, int]) -> Trial:
        """Without the replicas that fall into more pieces than they may: nothing may float."""
        near = PROMISING * self.threshold  # whether others float does not matter
        rows = [
            row for row, away in self.distances.items() if away > near or separate(self.replicas[row]) <= pieces[row]
        ]
        return replace(self, distances={row: self.distances[row] for row in rows})

    def where(self, uses: Callable[[Parameters], bool]) -> Trial:
        """Without what makes no use of the change: a longer search would have found it without."""
        return replace(self, distances={row: d for row, d in self.distances.items() if uses(self.parameters[row])})

    def joined(self, other: Trial) -> Trial:
        """The nearer of both for each reference."""
        rows = [row for row, distance in other.distances.items() if distance < self.distances.get(row, np.inf)]
        return replace(
            self,
            parameters={**self.parameters, **{row: other.parameters[row] for row in rows}},
            replicas={**self.replicas, **{row: other.replicas[row] for row in rows}},
            distances={**self.distances, **{row: other.distances[row] for row in rows}},
        )


@contextmanager
def changed(source: str, procedure: Procedure, judge: Judge, crew: Workers | None = None) -> Iterator[Workers]:
    """Workers for the procedure of the same name in a changed source, loaded from a folder that is gone afterwards.

    crew: workers that turn to it, by default new ones. Raises ProcedureError when the source does not load.
    """
    settings = judge.settings
    with tempfile.TemporaryDirectory(prefix="shapewright-") as folder:
        path = Path(folder) / (procedure.path.name if procedure.path else f"{procedure.name}.py")
        path.write_text(source, encoding="utf-8")
        new = load_procedure(f"{path}:{procedure.name}")
        if crew:
            crew.turn_to(new)
            yield crew
            return
        with Workers(new, settings.workers, Limits(settings.shape_seconds, settings.shape_memory_mb)) as crew:
            yield crew


def begun(
    crew: Workers, candidates: Mapping[int, Sequence[Parameters]], judge: Judge, pieces: Mapping[int, int]
) -> dict[int, Start]:
    """The nearest of some candidates for each reference (by index), moved into the Ranges and built as they are.

    Where several are given, one that falls into no more pieces than it may. References of which nothing can be built
    are left out.
    """
    space = crew.procedure.space
    asked = [(row, space.carry(values)) for row, several in candidates.items() for values in several]
    builds = crew.build([values for _, values in asked])
    pairs = zip(asked, builds, strict=True)
    made = [(row, build.parameters, build.shape) for (row, _), build in pairs if isinstance(build.shape, Mesh)]
    several: dict[int, list[Start]] = {}
    for cost, (row, values, mesh) in zip(judge.search_costs([(row, m) for row, _, m in made]), made, strict=True):
        if np.isfinite(cost):
            several.setdefault(row, []).append(Start(values, mesh, cost))
    starts: dict[int, Start] = {}
    for row, choices in several.items():
        choices.sort(key=lambda start: start.cost)
        standing = (start for start in choices if separate(start.mesh) <= pieces[row]) if len(choices) > 1 else ()
        starts[row] = next(iter(standing), choices[0])
    return starts


def tried(
    crew: Workers,
    starts: Mapping[int, Parameters],
    judge: Judge,
    budget: Budget | None,
    seed: int = 0,
    enough: float = ENOUGH,
    only: Collection[str] | None = None,
    sure: str | None = None,
) -> Trial:
    """Search for each reference (by index) from the parameters given, and judge what is found.

    budget: None to judge the parameters themselves, moved into the procedure's Ranges. enough: of the threshold, at
    which a search ends. only: names of the scalars that it may change, by default all. sure: the name of a choice that
    it keeps wherever it tries others.
    """
    space, rows = crew.procedure.space, list(starts)
    vectors = [space.carry(values) for values in starts.values()]
    if budget and rows:
        goal = enough * judge.goal
        vectors = _refined(space, crew, judge.measure(rows), vectors, budget, goal, seed, only, sure)
    builds = crew.build(vectors)
    parameters: dict[int, Parameters] = {}
    replicas: dict[int, Mesh] = {}
    distances: dict[int, float] = {}
    for row, build, distance in zip(rows, builds, judge.distances(builds, rows), strict=True):
        if isinstance(build.shape, Mesh) and np.isfinite(distance):
            parameters[row], replicas[row], distances[row] = build.parameters, build.shape, float(distance)
    return Trial(parameters, replicas, distances, judge.settings.threshold)


def mixtures(space: ParameterSpace, trial: Trial, starts: Mapping[int, Parameters]) -> dict[int, list[Parameters]]:
    """Candidates for the references of ``starts`` that are not compatible, from the choices with which others are.

    A shape that lacks a part may be nearest with choices to which the new part does not belong. Candidates are
    another's parameters, its choices with the reference's own numbers, and one choice of its alone.
    """
    lenders: dict[tuple[object, ...], Parameters] = {}
    for row in sorted(trial.compatible, key=lambda row: trial.distances[row]):
        parameters = trial.parameters[row]
        lenders.setdefault(tuple(parameters[p.name] for p in space if p.classes), parameters)
    mixed: dict[int, list[Parameters]] = {}
    for row in starts:
        own, known = space.carry(starts[row]), [space.carry(starts[row])]
        for lender in list(lenders.values())[:_LENDERS] if row not in trial.compatible else ():
            for values in _mixed(space, own, lender):
                if (new := space.canonical(values)) not in known:
                    known.append(new)
        if len(known) > 1:
            mixed[row] = known[1:]
    return mixed


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


def unchanged(crew: Workers, before: Sequence[tuple[Parameters, Mesh]]) -> bool:
    """Whether the procedure still builds these shapes for these parameters: the same bounds, and as much surface."""
    builds = crew.build([crew.procedure.space.carry(parameters) for parameters, _ in before])
    for build, (_, mesh) in zip(builds, before, strict=True):
        if not isinstance(build.shape, Mesh):
            return False
        size = float(mesh.extent.max())
        if np.abs(build.shape.bounds - mesh.bounds).max() > 1e-6 * size or _area(build.shape, mesh) > 1e-6:
            return False
    return True


def _area(a: Mesh, b: Mesh) -> float:
    """Difference of the surfaces' areas, as a part of the second."""
    areas = [
        float(np.linalg.norm(np.cross(*(m.triangles[:, [1, 2]] - m.triangles[:, :1]).swapaxes(0, 1)), axis=1).sum())
        for m in (a, b)
    ]
    return abs(areas[0] - areas[1]) / max(areas[1], 1e-12)


def _refined(
    space: ParameterSpace,
    crew: Workers,
    measure: Measure,
    vectors: Sequence[Parameters],
    budget: Budget,
    goal: float,
    seed: int,
    only: Collection[str] | None,
    sure: str | None,
) -> list[Parameters]:
    encoded = np.array([space.encode(values) for values in vectors])
    fixed = np.array([only is not None and name not in only for name in space.names])
    return refine(
        space,
        _as_inferred(space, vectors, sure),
        crew,
        measure,
        budget,
        seed,
        within=(np.where(fixed, encoded, 0.0), np.where(fixed, encoded, 1.0)),
        spread=_SPREAD,
        enough=goal,
    )


def _as_inferred(space: ParameterSpace, vectors: Sequence[Parameters], sure: str | None) -> list[NDArray[np.float32]]:
    """Parameters in the form of a prediction that is all but sure of them, and quite sure of one."""
    encoded = np.array([space.encode(values) for values in vectors], dtype=np.float32).reshape(len(vectors), len(space))
    columns: list[NDArray[np.float32]] = []
    for column, parameter in zip(encoded.T, space, strict=True):
        if not parameter.classes:
            columns.append(column)
            continue
        doubt = 0.0 if parameter.name == sure else 0.1
        likely = np.full((len(column), parameter.classes), doubt / parameter.classes, dtype=np.float32)
        likely[np.arange(len(column)), column.astype(int)] = 1.0 - doubt
        columns.append(likely)
    return columns
