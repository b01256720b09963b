"""The replicas of a fit: predicted, searched for, and kept where they are better than those before."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Build, Workers
from shapewright.fitting.learning import Lesson
from shapewright.fitting.start import Start
from shapewright.judging.judge import Judge
from shapewright.judging.paper import Metric
from shapewright.judging.verdict import Evidence
from shapewright.parameters import Parameters, Prediction
from shapewright.prediction.views.silhouettes import most_similar
from shapewright.progress import AnswerKind
from shapewright.search.budgets import Budget
from shapewright.search.search import SearchStart, refine
from shapewright.settings import Settings
from shapewright.shapes import Floats, Ints, Views

_NEAR = 0.5
"""Parameters that are known already are not searched for again up to this share of the threshold, or of the way from a
perfect replica to the least fidelity of a replicated one."""


class Told(Protocol):
    """Who is told how far a search is: the stages of a fit."""

    def begin(self, stage: str, total: int) -> None: ...
    def step(self, done: int, total: int) -> None: ...
    def answer(self, answer: Mapping[str, Parameters], kind: AnswerKind) -> None: ...


@dataclass(frozen=True, eq=False)
class Replicas:
    """The best build so far for each of N references."""

    builds: tuple[Build | None, ...]  # None where nothing was tried yet
    distances: Floats  # by the paper's measure, (N,); NaN where there is nothing to measure
    evidence: tuple[Evidence, ...]  # of their fidelity; NaN where there is nothing to measure
    fields: Ints  # the light field in which the two differ least, (N,)

    @classmethod
    def none(cls, count: int) -> Replicas:
        return cls((None,) * count, np.full(count, np.nan), (Evidence(math.nan),) * count, np.zeros(count, np.int64))

    @property
    def fidelities(self) -> Floats:
        """(N,); NaN where there is nothing to measure."""
        return np.array([each.value for each in self.evidence])

    @property
    def parameters(self) -> list[Parameters]:
        """Of the builds that there are."""
        return [build.parameters for build in self.builds if build]

    def tried(self, vectors: Sequence[Parameters], crew: Workers, judge: Judge) -> Replicas:
        """Build one vector for each reference, and keep it where it is better by the judge of the settings."""
        builds = crew.build(vectors)
        distances, fields, evidence = judge.seen(builds)
        nearer = (distances < self.distances) | (np.isnan(self.distances) & ~np.isnan(distances))
        if judge.settings.judge == "fidelity":
            old, new = self.fidelities, np.array([each.value for each in evidence])
            nearer = (new > old) | (nearer & ((new == old) | np.isnan(new) | np.isnan(old)))
        better = [build is None or bool(near) for build, near in zip(self.builds, nearer, strict=True)]
        return Replicas(
            tuple(b if use else a for use, b, a in zip(better, builds, self.builds, strict=True)),
            np.where(better, distances, self.distances),
            tuple(b if use else a for use, b, a in zip(better, evidence, self.evidence, strict=True)),
            np.where(better, fields, self.fields),
        )

    def near(self, settings: Settings, metric: Metric) -> NDArray[np.bool_]:
        """Which are so good that they need no search, (N,)."""
        if settings.judge == "paper":
            return np.asarray(self.distances <= _NEAR * metric.threshold)
        return np.asarray(self.fidelities >= 1.0 - _NEAR * (1.0 - settings.replicated))


def resume(start: Start, crew: Workers, judge: Judge, rows: range) -> Replicas:
    """The replicas of an earlier iteration, built again, or better ones; defaults where there are none.

    rows: places of the judge's references among all.
    """
    replicas = Replicas.none(len(rows))
    defaults = crew.procedure.space.defaults
    known, others = start.known[rows.start : rows.stop], start.others[rows.start : rows.stop]
    if start.resumed:
        replicas = replicas.tried([values or defaults for values in known], crew, judge)
    for number in range(max(map(len, others), default=0)):
        best = [build.parameters if build else defaults for build in replicas.builds]
        vectors = [more[number] if number < len(more) else own for more, own in zip(others, best, strict=True)]
        replicas = replicas.tried(vectors, crew, judge)
    return replicas


@dataclass(frozen=True, eq=False)
class Search:
    """What a search for some of many references goes by, wherever they are among all.

    prediction: for these references.
    rows: which of them are searched for.
    first: place of the first of them among all that are searched for.
    many: how many are searched for in all.
    budget: of each.
    new: see ``SearchStart``.
    """

    prediction: Prediction
    rows: Ints
    first: int
    many: int
    budget: Budget
    new: AbstractSet[str] | None = None


def replicate(crew: Workers, judge: Judge, lesson: Lesson, search: Search, told: Told, replicas: Replicas) -> Replicas:
    """Try the predicted parameters; search from there where no replica was near before."""
    settings, known = judge.settings, [build.parameters if build else None for build in replicas.builds]
    told.begin("replicate", 1)
    replicas = replicas.tried(search.prediction.decode(), crew, judge)
    vectors, rows = replicas.parameters, search.rows
    told.answer(dict(zip(judge.references.names, vectors, strict=True)), "predicted")
    if settings.refine == "off" or not len(rows):
        return replicas
    told.begin("refine", 1)
    start = SearchStart(
        search.prediction.take(rows),
        [known[i] for i in rows],
        search.new,
        numbers=range(search.first, search.first + len(rows)),
        many=search.many,
    )
    if judge.references.in_views:
        shown = [shape for i in rows if isinstance(shape := judge.references.references[i].shape, Views)]
        similar = most_similar(shown, lesson.training, settings.seed, settings.workers)
        start = replace(start, beside=similar)
    criterion = judge.criterion(rows, replicas.fields[rows])
    refined = refine(start, criterion, crew, search.budget, settings.seed, told.step)
    for i, values in zip(rows, refined, strict=True):
        vectors[i] = values
    return replicas.tried(vectors, crew, judge)
