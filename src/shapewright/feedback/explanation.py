"""An iteration explained: where and why each replica differs from its reference, and what to write next."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from shapewright.building import Workers
from shapewright.feedback.case import Case
from shapewright.feedback.causes.causes import causes
from shapewright.feedback.causes.shared import SharedCause, shared_causes
from shapewright.feedback.differences import differences
from shapewright.feedback.suggestions import Suggestion, suggestions
from shapewright.fitting.learning import limits_of
from shapewright.judging.judge import Judge
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Stages
from shapewright.references import Collection
from shapewright.runs.iteration import Iteration
from shapewright.settings import Settings
from shapewright.shapes import Mesh


@dataclass(frozen=True, eq=False)
class Explanation:
    """Everything that is said about an iteration.

    Attributes:
        references: the case of each reference that has a replica, by its name.
        summary: the causes that references share, the one that most share first.
        suggestions: what to write next, the largest gain first.
        seconds: by stage.
    """

    references: Mapping[str, Case]
    summary: tuple[SharedCause, ...]
    suggestions: tuple[Suggestion, ...] = ()
    seconds: Mapping[str, float] = field(default_factory=dict)


def explain(
    procedure: Procedure,
    references: Collection,
    iteration: Iteration,
    progress: Listener | None = None,
    cache: Path | None = None,
    suggest: bool = False,
    workers: int | None = None,
) -> Explanation:
    """Explain every reference of an iteration that has a replica.

    procedure, references: those that the iteration was made with; further references are left alone. cache: a folder
    that keeps the references' descriptors. suggest: whether to try what to write next, which takes longer. workers:
    processes and threads, by default as in the iteration's settings. Raises KeyError for a collection that lacks a
    reference, and ValueError for a collection of drawings.
    """
    if references.kind is not Mesh:
        raise ValueError("only collections of meshes can be explained so far, not drawings")
    settings = Settings.from_record({**iteration.settings.record(), **({"workers": workers} if workers else {})})
    collection = _collection(references, iteration)
    stages = Stages(progress)
    with Workers(procedure, settings.workers, limits_of(settings)) as crew:
        stages.begin("describe", len(collection))
        judge = Judge.of(collection, settings, cache)
        stages.begin("differences", 3)
        cases = differences(iteration, crew, judge)
        stages.begin("causes", 4)
        cases = causes(cases, iteration.predictor, crew, judge, stages)
        unsolved = [case for case in cases if case.nearest.distance > settings.threshold]
        changes = suggestions(procedure, unsolved, crew, judge, stages) if suggest else ()
        stages.end()
    shared = tuple(shared_causes(procedure.space, cases))
    return Explanation({case.name: case for case in cases}, shared, changes, stages.seconds)


def _collection(references: Collection, iteration: Iteration) -> Collection:
    """The references of an iteration in its order, turned as they were then."""
    turned = iteration.metrics.get("turned", {})
    collection = Collection(tuple(references[name] for name in iteration.names), source=references.source)
    return collection.turned([turned.get(name, 0) // 90 for name in collection.names]) if turned else collection
