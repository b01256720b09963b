"""An iteration explained: where and why each replica differs from its reference, and what to write next."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from shapewright.building import Build, Executor, Failure, Workers
from shapewright.feedback.case import Case, DrawnCase, Replica
from shapewright.feedback.causes.causes import causes
from shapewright.feedback.causes.drawn_cases import drawn_causes, in_place
from shapewright.feedback.causes.failures import failures
from shapewright.feedback.causes.shared import SharedCause, shared_causes
from shapewright.feedback.sample import MOST, sample_of
from shapewright.feedback.suggestions import Suggestion, no_suggestions, suggestions
from shapewright.feedback.surfaces.areas import areas
from shapewright.feedback.surfaces.residuals import Residuals, residuals
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.feedback.trials.tried import Tried
from shapewright.fitting.start import for_procedure
from shapewright.judging.judge import Judge
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Stages
from shapewright.references import Collection
from shapewright.references.standing import recorded_orientation
from shapewright.rules.rule import Rule
from shapewright.runs.folder import RunError
from shapewright.runs.inputs import references_of
from shapewright.runs.iteration import Iteration
from shapewright.shapes import Drawing, Mesh, Points
from shapewright.survey.preparation import prepared

_IN_VIEWS = (
    "the references are pictures of objects, of which nobody knows all sides: they cannot be explained yet. The report "
    "marks what is missing and what is too much in each picture"
)
_OF_CAUSES = {"describe": 0.04, "differences": 0.06, "causes": 0.9}
_SHARES = {"describe": 0.03, "differences": 0.04, "causes": 0.53, "hypotheses": 0.1, "trials": 0.3}
"""Of each stage in the time that explaining takes, without suggestions and with them: estimates, good enough to say
about how long it takes still."""
_POINTS = (
    "the references are points: they are fitted and judged, but not explained, since explaining compares surfaces; "
    "make meshes of them first, or look at the missing and surplus regions of the report"
)


@dataclass(frozen=True, eq=False)
class Explanation:
    """Everything that is said about an iteration."""

    references: Mapping[str, Case | DrawnCase]  # the case of each reference that has a replica, by its name
    summary: tuple[SharedCause, ...]  # the causes that references share, the one that most share first
    suggestions: tuple[Suggestion, ...] = ()  # what to write next, the largest gain first
    tried: tuple[Tried, ...] = ()  # every change that was tried, the one that got furthest first
    source: str = ""  # text of the procedure that is explained
    unsuggested: str | None = None  # why no changes of the procedure are suggested, where they are not sought
    seconds: Mapping[str, float] = field(default_factory=dict)  # by stage
    sample: tuple[int, int] | None = None  # references that were looked at, of how many; None where all were


def explain(
    iteration: Iteration,
    procedure: Procedure,
    references: Collection | None = None,
    progress: Listener | None = None,
    cache: Path | None = None,
    suggest: bool = True,
    workers: int | None = None,
    rules: Sequence[Rule] | None = None,
    executor: Executor | None = None,
    most: int = MOST,
) -> Explanation:
    """Explain every reference of an iteration that has a replica, and that follows no other one.

    Of more than ``most`` references a sample is explained: members of each group, and some replicated ones.

    Args:
        iteration: what ``fit`` returned, or ``Iteration.load``.
        procedure: the one that the iteration was made with.
        references: those that it was made with, and perhaps others; by default they are loaded from where they were.
        progress: called with a Progress a few times a second.
        cache: a folder that keeps the references' descriptors.
        suggest: whether to try what to write next, which takes longer.
        workers: processes and threads; by default as in the iteration's settings.
        rules: the library that suggestions draw on; by default all of ``rules.library.library``.
        executor: builds, searches and judges on other machines, see ``sample``.

    Raises:
        RunError: the references are to be loaded, but were made in memory or are not where they were; or they are
            pictures of objects; or all of them are points. What is said goes by surfaces, and those of points are not
            known. Of a collection with meshes the meshes are explained.
        KeyError: the collection lacks a reference of the iteration.
        ExecutorError: an executor lost the same work twice.
    """
    references = references or references_of(iteration)
    if iteration.collection.get("pictures") == "views":
        raise RunError(_IN_VIEWS)
    check_explainable(references)
    settings = replace(iteration.settings, workers=workers or iteration.settings.workers)
    fitted = iteration.fitted
    iteration = sample_of(fitted, most, settings.seed)
    sample = (len(iteration), len(fitted)) if len(iteration) < len(fitted) else None
    references = prepared(for_procedure(references, procedure), settings, settings.workers)
    collection = _collection(references, iteration)
    check_explainable(collection)
    stages = Stages(progress, _SHARES if suggest and references.kind is Mesh else _OF_CAUSES)
    with Workers.of(procedure, settings, executor) as crew:
        stages.begin("describe", len(collection))
        judge = Judge.of(collection, settings, cache, crew=crew)
        if references.kind is Drawing:
            stages.begin("differences", 3)
            built = _built(iteration, crew)
            drawings = _drawings(iteration, built, crew, in_place(judge), stages)
            stages.end()
            explanation = _explanation(procedure, drawings, (), _failed(iteration, built), stages)
            return replace(explanation, sample=sample)
        stages.begin("differences", 3)
        built = _built(iteration, crew)
        cases = _cases(iteration, built, judge, crew)
        stages.begin("causes", 4)
        cases = causes(cases, iteration.predictor, crew, judge, stages)
        unsolved = [case for case in cases if case.nearest.apart > 1.0]
        why_not = no_suggestions(procedure) if suggest else None
        changes, tried = suggestions(procedure, unsolved, crew, judge, stages, rules=rules) if suggest else ((), ())
        stages.end()
    explanation = _explanation(procedure, cases, changes, _failed(iteration, built), stages)
    return replace(explanation, tried=tried, unsuggested=why_not, sample=sample)


def check_explainable(references: Collection) -> None:
    """Raises RunError for pictures of objects, and where all references are points."""
    if references.in_views:
        raise RunError(_IN_VIEWS)
    if all(isinstance(reference.shape, Points) for reference in references):
        raise RunError(_POINTS)


def _explanation(
    procedure: Procedure,
    cases: Sequence[Case] | Sequence[DrawnCase],
    changes: tuple[Suggestion, ...],
    failed: Sequence[SharedCause],
    stages: Stages,
) -> Explanation:
    shared = (*shared_causes(procedure.space, cases), *failed)
    by_name = {case.name: case for case in cases}
    return Explanation(by_name, shared, changes, seconds=stages.seconds, source=procedure.source)


def _collection(references: Collection, iteration: Iteration) -> Collection:
    """The references of an iteration in its order, turned as they were then."""
    turned = iteration.metrics.get("turned", {})
    collection = Collection(tuple(references[name] for name in iteration.names), source=references.source)
    axes = iteration.collection.get("axes") or {}
    collection = collection.oriented({name: recorded_orientation(record) for name, record in axes.items()})
    return collection.turned([turned.get(name, 0) // 90 for name in collection.names]) if turned else collection


def _cases(iteration: Iteration, built: Built, judge: Judge, crew: Workers) -> list[Case]:
    """A case for each reference whose replica can be built and measured."""
    results = iteration.results
    shapes = [reference.shape for reference in judge.references]
    built = [(row, build) for row, build in built if isinstance(build.shape, Mesh) and isinstance(shapes[row], Mesh)]
    standings = judge.standings([build for _, build in built], [row for row, _ in built])
    found = [Replica.of(row, build, standing) for (row, build), standing in zip(built, standings, strict=True)]
    replicas = [replica for replica in found if replica]

    pairs = [(mesh, r.mesh) for r in replicas if isinstance(mesh := shapes[r.row], Mesh)]
    return [
        Case.of(results[r.row].name, reference, results[r.row].grade == "replicated", r, where)
        for r, (reference, _), where in zip(replicas, pairs, crew.each(_apart, pairs), strict=True)
    ]


def _apart(pair: tuple[Mesh, Mesh]) -> Residuals:
    reference, replica = pair
    return residuals(VisibleSurface.of(reference), replica)


def _drawings(iteration: Iteration, built: Built, crew: Workers, judge: Judge, stages: Stages) -> list[DrawnCase]:
    """The same of drawings, with their causes. judge: ``in_place``."""
    built = [(row, build) for row, build in built if isinstance(build.shape, Drawing)]
    standings = judge.standings([build for _, build in built], [row for row, _ in built])
    cases = []
    for (row, build), standing in zip(built, standings, strict=True):
        result, reference = iteration.results[row], judge.references.references[row].shape
        replica = Replica.of(row, build, standing)
        if isinstance(reference, Drawing) and isinstance(build.shape, Drawing) and replica:
            where = areas(reference, build.shape)
            cases.append(DrawnCase.of(result.name, reference, result.grade == "replicated", replica, where))
    stages.begin("causes", 4)
    return drawn_causes(cases, iteration.predictor, crew, judge, stages)


Built = list[tuple[int, Build]]
"""Builds with the rows of their references."""


def _failed(iteration: Iteration, built: Built) -> list[SharedCause]:
    return failures([iteration.names[row] for row, _ in built], [build for _, build in built])


def _built(iteration: Iteration, crew: Workers) -> Built:
    """The iteration's replicas, built again: files keep them in single precision; and those that fail, to tell why."""
    names = crew.procedure.space.names
    wanted = [(row, r) for row, r in enumerate(iteration) if r.replica is not None or _tells(r.error)]
    known = {row: result.parameters for row, result in wanted if result.parameters}
    builds = crew.build([{name: values[name] for name in names} for values in known.values()], give_up=True)
    return list(zip(known, builds, strict=True))


def _tells(error: str | None) -> bool:
    """Whether a failure may be tried again: not one that takes all the time or memory that there is."""
    return error is not None and Failure.parse(error).kind in ("raised", "infeasible")
