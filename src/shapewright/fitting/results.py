"""The results of a fit: judged, grouped, and recorded as an iteration."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from functools import partial
from typing import Any

from shapewright.building import Build, Opened
from shapewright.comparison.grouping import Group
from shapewright.fitting.chunks.forms import Measured
from shapewright.fitting.chunks.judges import Judges
from shapewright.fitting.chunks.passes import Found
from shapewright.fitting.chunks.pictures import DrawnPictures
from shapewright.fitting.keeping.unfinished import Unfinished
from shapewright.fitting.learning import Lesson
from shapewright.parameters import to_record
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Notice, Progress, Stages
from shapewright.references import Collection
from shapewright.references.standing import AUTO, axes_record
from shapewright.runs.helpers import helpers_of, not_kept
from shapewright.runs.iteration import Iteration
from shapewright.runs.lazy import Lazy, later
from shapewright.runs.pictures import draw_pictures
from shapewright.runs.result import Result
from shapewright.storage import printable
from shapewright.survey.duplicates import Duplicate
from shapewright.versions import versions


def judged(
    procedure: Procedure, judges: Judges, found: Sequence[Found], stages: Stages
) -> tuple[tuple[Result, ...], tuple[Group, ...]]:
    """The result of each reference, and the groups of those that are not replicated."""
    stages.begin("compare", len(judges.references))
    measured = [each.measured() for each in found]
    grades = [grade for some in measured for grade in some.grades]
    ungrouped = [
        result for some, each in zip(measured, found, strict=True) for result in _results(procedure, judges, each, some)
    ]
    groups = judges.groups(grades, Lazy(len(ungrouped), lambda place: ungrouped[place].replica))
    group_of = {name: i for i, group in enumerate(groups) for name in group.members}
    results = (replace(r, replica=r.held, group=group_of[r.name]) if r.name in group_of else r for r in ungrouped)
    return tuple(results), groups


def _results(procedure: Procedure, judges: Judges, found: Found, measured: Measured) -> Iterator[Result]:
    """Those of a chunk, without their groups."""
    replicas = found.replicas()
    for place, (row, build, seen) in enumerate(zip(found.rows, replicas.builds, replicas.evidence, strict=True)):
        assert build is not None
        reference, its = judges.references.references[row], measured.measures[place]
        yield Result(
            name=reference.name,
            path=reference.path,
            parameters=build.parameters,
            active=procedure.space.active(build.parameters),
            at_limit=procedure.space.at_limit(build.parameters) if build.shape else (),
            replica=later(partial(found.shape, place)) if judges.many and build.shape else build.shape,
            measured=its,
            grade=measured.grades[place],
            compatible=measured.compatible[place],
            group=None,
            reference=reference.shape,
            error=_error(build, its.distance),
            missing=seen.missing,
            surplus=seen.surplus,
            places=measured.places[place],
            notes=reference.notes,
        )


def followed(
    references: Collection,
    like: Sequence[Duplicate],
    results: tuple[Result, ...],
    groups: tuple[Group, ...],
    turns: Mapping[str, int],
) -> tuple[tuple[Result, ...], tuple[Group, ...]]:
    """Results and groups with those of references that follow others, in the order of the collection.

    Each has the parameters, the replica and the grade of the one that it follows. turns: quarter turns, by name.
    """
    by_name, followers = {result.name: result for result in results}, {each.name: each.of for each in like}
    for reference in references:
        if of := followers.get(reference.name):
            by_name[reference.name] = replace(
                by_name[of],
                replica=by_name[of].held,
                name=reference.name,
                path=reference.path,
                reference=reference.turned(turns[of]).shape,
                notes=reference.notes,
                follows=of,
            )
    grown = tuple(
        Group(group.representative, (*group.members, *(n for n, of in followers.items() if of in group.members)))
        for group in groups
    )
    return tuple(by_name[name] for name in references.names), grown


def telling(progress: Listener, like: Sequence[Duplicate]) -> Listener:
    """The listener, which hears the answers of references that follow others as well."""

    def tell(event: Progress) -> None:
        known = event.answer or {}
        more = {each.name: known[each.of] for each in like if each.of in known}
        progress(replace(event, answer={**known, **more}) if more else event)

    return tell


def recorded(
    procedure: Procedure,
    judges: Judges,
    lesson: Lesson,
    references: Collection,
    results: tuple[Result, ...],
    groups: tuple[Group, ...],
    turns: Mapping[str, int],
    stages: Stages,
    unfinished: Unfinished,
    opened: Iterable[Opened] = (),
) -> Iteration:
    """The iteration, with pictures of its results.

    turns: quarter turns of references about the up axis, by name. opened: files that the procedure read.
    """
    stages.begin("picture", len(results) if judges.many else 1)
    kept = helpers_of(procedure, opened)
    if kept.too_large:
        stages.tell(Notice("not kept", not_kept(kept.too_large)))
    predictor = lesson.predictor
    threads, many = judges.settings.workers, judges.many
    pictures = DrawnPictures(results, unfinished, stages, threads) if many else draw_pictures(results, threads)
    stages.end()
    return Iteration(
        results=results,
        metric=judges.metric,
        groups=groups,
        settings=judges.settings,
        seconds=stages.seconds,
        procedure={
            "name": procedure.name,
            "path": str(procedure.path) if procedure.path else None,
            "digest": procedure.digest,
            "parameters": [to_record(parameter) for parameter in procedure.space],
            **procedure.facts.stated,
            **({"not_kept": [str(file) for file in kept.too_large]} if kept.too_large else {}),
        },
        source=procedure.source,
        helpers=kept.contents,
        collection={
            "source": references.source,
            "origins": list(references.origins),
            "up": references.up,
            "front": references.front,
            "keep": list(references.keep),
            "pictures": references.pictures,
            "axes": _axes(references) if references.up == AUTO else None,
            "count": len(references),
            "skipped": {printable(path): reason for path, reason in references.skipped.items()},
            "left_out": dict(references.left_out),
        },
        metrics={
            "samples": predictor.samples,
            **lesson.facts,
            "first_answer": stages.first_answer,
            "notices": [vars(notice) for notice in stages.notices],
            "turned": {name: 90 * turn for name, turn in turns.items() if turn},
            "epochs": len(predictor.curve),
            "curve": [vars(epoch) for epoch in predictor.curve],
            "validation": predictor.metrics,
        },
        versions=versions(),
        created=datetime.now(UTC).isoformat(timespec="seconds"),
        pictures=pictures,
        predictor=predictor,
    )


def _error(build: Build, distance: float) -> str | None:
    if build.failure:
        return str(build.failure)
    return "so thin that no view shows it: it cannot be compared" if math.isnan(distance) else None


def _axes(references: Collection) -> dict[str, dict[str, Any]]:
    """By the name of each reference, and of each file that it is an object in, which stands alike."""
    return {name: axes_record(each) for each in references for name in (each.part_of, each.name) if name}
