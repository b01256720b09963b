"""One turn of the loop: sample, build, render, train, predict, build replicas, compare, group."""

from __future__ import annotations

import math
import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Build, Workers
from shapewright.comparison.grouping import Group
from shapewright.fitting.adaptive import around
from shapewright.fitting.facing import quarter_turns
from shapewright.fitting.learning import Lesson, learn, learn_more, limits_of
from shapewright.judging.judge import Judge
from shapewright.judging.target import Measures
from shapewright.parameters import Parameters, ParameterSpace, Scalar, to_record
from shapewright.prediction.dataset import Dataset
from shapewright.prediction.lookup import nearest
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Stages
from shapewright.references import Collection
from shapewright.rendering.raster import render
from shapewright.runs.iteration import Iteration, draw_pictures
from shapewright.runs.result import Result
from shapewright.search.search import refine
from shapewright.settings import Settings
from shapewright.shapes import Mesh

_NEAR = 0.5
"""Share of the threshold up to which parameters that were carried over are left as they are."""
VERSIONED = ("shapewright", "numpy", "torch", "numba", "manifold3d", "scikit-learn", "trimesh")


def fit(
    procedure: Procedure,
    references: Collection,
    settings: Settings | None = None,
    progress: Listener | None = None,
    cache: Path | None = None,
    previous: Iteration | None = None,
) -> Iteration:
    """One iteration: find parameters for every reference and say which the procedure cannot replicate yet.

    progress: called with a Progress a few times a second; ``print`` will do. Within seconds one of them holds a first
    answer. cache: a folder that keeps the references' descriptors between iterations. previous: an iteration with an
    earlier version of the procedure to go on from: its parameters, network and cameras are carried over, which takes a
    third of the time. The same seed, settings and machine give the same iteration. Raises ProcedureError when the
    procedure cannot build shapes.
    """
    settings = settings or Settings()
    stages = Stages(progress)
    known = _carried(procedure.space, references, previous)
    with Workers(procedure, settings.workers, limits_of(settings)) as crew:
        if previous:
            answer = {name: values for name, values in zip(references.names, known, strict=True) if values}
            stages.answer(answer, "carried over")
        watch = None if previous else partial(_first_answer, references, stages, settings)
        predictor = previous.predictor if previous else None
        lesson = learn(procedure, crew, settings, stages, predictor, watch, references.kind)
        turns = [0] * len(references)
        if settings.facing == "found" and references.kind is Mesh:
            stages.begin("face", len(references))
            turns = quarter_turns(references, lesson.predictor, crew)
            references = references.turned(turns)
        stages.begin("describe", len(references))
        judge = Judge.of(references, settings, cache)
        found = _Found.none(len(references))
        if previous:
            found = _try(crew, judge, [values or procedure.space.defaults for values in known], found)
        found = _replicate(procedure, crew, judge, lesson, settings, stages, found, _new(procedure.space, previous))
        for number in range(settings.rounds):
            centres = [build.parameters for build in found.builds if build]
            seed = settings.seed + number + 1
            vectors = around(procedure.space, centres, lesson.predictor.metrics, settings.round_samples, seed)
            lesson = learn_more(procedure, crew, settings, stages, lesson, vectors)
            found = _replicate(procedure, crew, judge, lesson, settings, stages, found)
    builds, predictor = [build for build in found.builds if build], lesson.predictor
    stages.begin("compare", len(references))
    measures = judge.measures(builds, found.distances)
    compatible = judge.compatible(measures)
    groups = judge.groups(compatible)
    results = _results(procedure, references, builds, measures, compatible, groups)
    stages.begin("picture", 1)
    pictures = draw_pictures(results, settings.workers)
    stages.end()
    return Iteration(
        results=results,
        metric=judge.metric,
        groups=groups,
        settings=settings,
        seconds=stages.seconds,
        procedure=_describe(procedure),
        source=procedure.source,
        collection={
            "source": references.source,
            "origins": list(references.origins),
            "up": references.up,
            "front": references.front,
            "count": len(references),
            "skipped": {str(path): reason for path, reason in references.skipped.items()},
        },
        metrics={
            "samples": predictor.samples,
            **lesson.facts,
            "first_answer": stages.first_answer,
            "turned": {name: 90 * turn for name, turn in zip(references.names, turns, strict=True) if turn},
            "epochs": len(predictor.curve),
            "curve": [vars(epoch) for epoch in predictor.curve],
            "validation": predictor.metrics,
        },
        versions={"python": platform.python_version(), **{name: version(name) for name in VERSIONED}},
        created=datetime.now(UTC).isoformat(timespec="seconds"),
        pictures=pictures,
        predictor=predictor,
    )


@dataclass(frozen=True, eq=False)
class _Found:
    """The nearest build so far for each reference, its distance, NaN where there is none to measure, and its field."""

    builds: list[Build | None]
    distances: NDArray[np.float64]
    fields: NDArray[np.int64]

    @classmethod
    def none(cls, count: int) -> _Found:
        return cls([None] * count, np.full(count, np.nan), np.zeros(count, dtype=np.int64))

    def parameters(self, otherwise: Sequence[Parameters]) -> list[Parameters]:
        """Of each build; of ``otherwise`` where there is none."""
        return [build.parameters if build else values for build, values in zip(self.builds, otherwise, strict=True)]


def _new(space: ParameterSpace, previous: Iteration | None) -> set[str] | None:
    """Names of scalars that the previous iteration did not have, or not in this Range; None: it did not search.

    Of other kinds all likely values are tried anyway.
    """
    if previous is None or previous.predictor is None or previous.settings.refine == "off":
        return None
    before = previous.predictor.space.parameters
    return {parameter.name for parameter in space if isinstance(parameter, Scalar) and parameter not in before}


def _carried(space: ParameterSpace, references: Collection, previous: Iteration | None) -> list[Parameters | None]:
    """The parameters that the previous iteration found for each reference, where it had it, in this space."""
    old = {result.name: result.parameters for result in previous} if previous else {}
    return [space.carry(values) if (values := old.get(name)) else None for name in references.names]


def _first_answer(references: Collection, stages: Stages, settings: Settings, samples: Dataset) -> None:
    """Tell the most similar of the first samples for each reference."""
    shapes = [reference.shape for reference in references]
    pictures = render(shapes, samples.cameras, samples.size, threads=settings.workers)
    rows = nearest(pictures, samples.images)
    answer = {name: samples.parameters[row] for name, row in zip(references.names, rows, strict=True)}
    stages.answer(answer, "most similar samples")


def _replicate(
    procedure: Procedure,
    crew: Workers,
    judge: Judge,
    lesson: Lesson,
    settings: Settings,
    stages: Stages,
    found: _Found,
    new: set[str] | None = None,
) -> _Found:
    """Try what is predicted for each reference, and search on from there; new: see ``refine``."""
    stages.begin("predict", len(found.builds))
    prediction = lesson.predictor.infer([reference.shape for reference in judge.references])
    predicted = prediction.decode()
    stages.begin("replicate", 1)
    # Of what was found before only that is searched on which is not near yet.
    known = [build.parameters if build else None for build in found.builds]
    rows = np.flatnonzero(~(found.distances <= _NEAR * judge.metric.threshold))
    found = _try(crew, judge, predicted, found)
    stages.answer(dict(zip(judge.references.names, found.parameters(predicted), strict=True)), "predicted")
    if settings.refine == "off" or not len(rows):
        return found
    stages.begin("refine", 1)
    refined = refine(
        prediction.take(rows),
        crew,
        judge.measure(rows, found.fields[rows]),
        lesson.budget(settings),
        settings.seed,
        [known[i] for i in rows],
        judge.goal,
        stages.step,
        new=new,
        enough=judge.enough,
        parts=judge.parts,
        doubt=judge.surprise_cost,
    )
    vectors = found.parameters(predicted)
    for i, values in zip(rows, refined, strict=True):
        vectors[i] = values
    return _try(crew, judge, vectors, found)


def _try(crew: Workers, judge: Judge, vectors: Sequence[Parameters], found: _Found) -> _Found:
    """Build one vector for each reference, and keep it where it is nearer than what was found before."""
    builds = crew.build(vectors)
    distances, fields = judge.nearest(builds)
    closer = (distances < found.distances) | (np.isnan(found.distances) & ~np.isnan(distances))
    better = [old is None or bool(mine) for old, mine in zip(found.builds, closer, strict=True)]
    chosen = [new if mine else old for mine, new, old in zip(better, builds, found.builds, strict=True)]
    return _Found(chosen, np.where(better, distances, found.distances), np.where(better, fields, found.fields))


def _results(
    procedure: Procedure,
    references: Collection,
    builds: Sequence[Build],
    measures: Sequence[Measures],
    compatible: NDArray[np.bool_],
    groups: Sequence[Group],
) -> tuple[Result, ...]:
    group_of = {name: i for i, found in enumerate(groups) for name in found.members}
    return tuple(
        Result(
            name=reference.name,
            path=reference.path,
            parameters=build.parameters,
            active=procedure.space.active(build.parameters),
            at_limit=procedure.space.at_limit(build.parameters) if build.shape else (),
            replica=build.shape,
            distance=its.distance,
            iou=its.iou,
            chamfer=its.chamfer,
            compatible=bool(same),
            group=group_of.get(reference.name),
            reference=reference.shape,
            error=_error(build, its.distance),
            depth=its.depth,
        )
        for reference, build, its, same in zip(references, builds, measures, compatible, strict=True)
    )


def _error(build: Build, distance: float) -> str | None:
    if build.failure:
        return str(build.failure)
    return "so thin that no view shows it: it cannot be compared" if math.isnan(distance) else None


def _describe(procedure: Procedure) -> Mapping[str, Any]:
    return {
        "name": procedure.name,
        "path": str(procedure.path) if procedure.path else None,
        "digest": procedure.digest,
        "parameters": [to_record(parameter) for parameter in procedure.space],
    }
