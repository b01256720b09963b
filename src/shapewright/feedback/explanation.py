"""An iteration explained: where and why each replica differs from its reference, and its form in a run's folder."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from shapewright.building import Workers
from shapewright.feedback.causes.causes import Cause, Evidence, causes, or_leaning
from shapewright.feedback.causes.leaning import leaning
from shapewright.feedback.causes.longer_search import Found, Inferred, Searcher
from shapewright.feedback.causes.outliers import isolation, outliers
from shapewright.feedback.causes.rules import with_rules
from shapewright.feedback.causes.shared import Misfit, shared
from shapewright.feedback.surfaces.placement import Overlay, place
from shapewright.feedback.surfaces.residuals import Region, Residuals, residuals
from shapewright.feedback.surfaces.visible import Surface
from shapewright.fitting.learning import limits_of
from shapewright.judging.judge import Judge
from shapewright.parameters import Parameters, ParameterSpace
from shapewright.prediction.predictor import Predictor
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Stages
from shapewright.references import Collection
from shapewright.runs.iteration import Iteration
from shapewright.settings import Settings
from shapewright.shapes import Mesh, Shape
from shapewright.threads import in_threads

_DOUBT = 0.3  # probability of another class than the one that was found, where no predictor is known


@dataclass(frozen=True, eq=False)
class Explained:
    """One reference, explained.

    row: index of the reference in the collection. found: of the iteration. residuals: of its replica.
    For incompatible references only: nearest: what a longer search found within the space. best: the shape within the
    space whose surface has most in common with the reference's, which may be further away by the light field; misfit:
    its residuals, which are least due to parameters. causes: the chief one first. outside: what was found with longer
    Ranges, where that was searched for.
    """

    name: str
    row: int
    reference: Mesh
    compatible: bool
    found: Found
    residuals: Residuals
    nearest: Found
    best: Found
    misfit: Residuals
    causes: tuple[Cause, ...] = ()
    outside: Found | None = None


Suggest = Callable[[Procedure, Sequence[Explained], Workers, Judge, Stages], Sequence[Mapping[str, Any]]]
"""Makes the suggestions for an explained iteration, as records: kind, title, text, snippet, source, picture (PNG in
base64 or None), references (names), gain (how many become compatible), tried (what was measured)."""


@dataclass(frozen=True, eq=False)
class Explanation:
    """Everything that is told about an iteration. summary: groups of references by cause, see
    ``shared.shared``."""

    references: Mapping[str, Explained]
    summary: Sequence[Mapping[str, Any]]
    suggestions: Sequence[Mapping[str, Any]] = ()
    seconds: Mapping[str, float] = field(default_factory=dict)

    @property
    def record(self) -> dict[str, Any]:
        """As plain values for ``explanation.json``."""
        return {
            "format": 1,
            "references": {name: _record(explained) for name, explained in self.references.items()},
            "summary": [dict(entry) for entry in self.summary],
            "suggestions": [dict(suggestion) for suggestion in self.suggestions],
            "seconds": {stage: round(seconds, 2) for stage, seconds in self.seconds.items()},
        }


def explain(
    procedure: Procedure,
    references: Collection,
    iteration: Iteration,
    progress: Listener | None = None,
    cache: Path | None = None,
    suggest: Suggest | None = None,
    workers: int | None = None,
) -> Explanation:
    """Explain every reference of an iteration that has a replica.

    procedure, references: those that the iteration was made with; further references are left alone. cache: a folder
    that keeps the references' descriptors. suggest: makes suggestions of what to write next. workers: processes and
    threads, by default as in the iteration's settings. Raises KeyError for a collection that lacks a reference, and
    ValueError for a collection of drawings.
    """
    if references.kind is not Mesh:
        raise ValueError("only collections of meshes can be explained so far, not drawings")
    settings = Settings.from_record({**iteration.settings.record(), **({"workers": workers} if workers else {})})
    theirs = _as_found(references, iteration)
    stages = Stages(progress)
    with Workers(procedure, settings.workers, limits_of(settings)) as crew:
        stages.begin("describe", len(theirs))
        judge = Judge.of(theirs, settings, cache)
        stages.begin("differences", 3)
        found = _found(procedure, iteration, crew, judge)
        rows = sorted(found)
        shapes = [_mesh(theirs.references[row].shape) for row in rows]
        surfaces = dict(zip(rows, in_threads(Surface.of, shapes, settings.workers), strict=True))
        differences = _residuals(surfaces.values(), [found[row].mesh for row in rows], settings.workers)
        searcher = Searcher(procedure.space, crew, judge, settings.seed)
        stages.begin("causes", 4)
        vectors = [found[row].parameters for row in rows]
        differences = with_rules(procedure, vectors, differences, settings.workers, limits_of(settings))
        misfits = [row for row in rows if not iteration.results[row].compatible]
        why = _causes(searcher, surfaces, iteration.predictor, {row: found[row] for row in misfits}, stages)
        explained = {}
        for row, reference, difference in zip(rows, shapes, differences, strict=True):
            name, its = theirs.names[row], why.get(row) or _Why(found[row], found[row], difference)
            fits = iteration.results[row].compatible
            explained[name] = Explained(
                name,
                row,
                reference,
                fits,
                found[row],
                difference,
                its.nearest,
                its.best,
                its.misfit,
                its.causes,
                its.outside,
            )
        misfit = {each.name: Misfit(each.causes, each.misfit) for each in explained.values() if each.causes}
        told = shared(procedure.space, misfit)
        wanting = [e for e in explained.values() if e.nearest.distance > settings.threshold]
        suggestions = suggest(procedure, wanting, crew, judge, stages) if suggest and wanting else ()
        stages.end()
    return Explanation(explained, told, tuple(suggestions), stages.seconds)


@dataclass(frozen=True, eq=False)
class _Why:
    """What is found out about an incompatible reference: see ``Explained``."""

    nearest: Found
    best: Found
    misfit: Residuals
    causes: tuple[Cause, ...] = ()
    outside: Found | None = None


def _causes(
    searcher: Searcher,
    surfaces: Mapping[int, Surface],
    predictor: Predictor | None,
    found: Mapping[int, Found],
    stages: Stages,
) -> dict[int, _Why]:
    rows, settings = list(found), searcher.judge.settings
    if not rows:
        return {}
    before = searcher.placed(rows, list(found.values()))
    shapes = [_mesh(searcher.judge.references.references[row].shape) for row in rows]
    theirs = [surfaces[row] for row in rows]
    inferred = _inferred(searcher.space, predictor, shapes, before)
    overlays = dict(zip(rows, _overlays(theirs, before, settings.workers), strict=True))
    laid = searcher.laid(rows, inferred, before, overlays)
    stages.step(1, 4)
    inside = [min(found, put, key=lambda each: each.distance) for found, put in zip(before, laid, strict=True)]
    short = [i for i, best in enumerate(inside) if best.distance > searcher.threshold]
    wanting = [rows[i] for i in short]
    longer = searcher.longer(wanting, [column[short] for column in inferred], [inside[i] for i in short])
    for i, best in zip(short, longer, strict=True):
        inside[i] = best
    inside = searcher.chosen(rows, before, inside)
    stages.step(2, 4)
    outside = dict(zip(rows, inside, strict=True))
    unsolved = [row for row in rows if outside[row].distance > searcher.threshold]
    outside |= zip(unsolved, searcher.beyond(unsolved, [outside[row] for row in unsolved]), strict=True)
    stages.step(3, 4)
    alone = isolation(searcher.judge.descriptors, settings.align, settings.workers, settings.seed)
    strange = outliers(alone)
    differences = _residuals(theirs, [best.mesh for best in laid], settings.workers)
    vectors = [best.parameters for best in laid]
    differences = with_rules(searcher.crew.procedure, vectors, differences, settings.workers, searcher.crew.limits)
    evidence = [
        Evidence(
            before[i],
            inside[i],
            outside[row],
            laid[i],
            differences[i],
            overlays[row](laid[i].mesh),
            overlays[row](outside[row].mesh),
            float(alone[row]) if strange[row] else None,
        )
        for i, row in enumerate(rows)
    ]
    why = [causes(searcher.space, searcher.threshold, each) for each in evidence]
    lacking = [i for i, told in enumerate(why) if told[0].kind == "missing part"]
    some = [laid[i].parameters for i in lacking], [overlays[rows[i]] for i in lacking]
    for i, lean in zip(lacking, leaning(searcher.space, searcher.crew, *some, settings.workers), strict=True):
        why[i] = or_leaning(why[i], lean, evidence[i].laid_apart)
    return {row: _Why(inside[i], laid[i], differences[i], why[i], outside[row]) for i, row in enumerate(rows)}


def _overlays(references: Sequence[Surface], known: Sequence[Found], threads: int | None) -> list[Overlay]:
    """Overlays that try the fit of what is known besides the middle."""

    def overlay(pair: tuple[Surface, Found]) -> Overlay:
        reference, found = pair
        return Overlay(reference, [place(reference, Surface.roughly(found.mesh.normalised()))[0]])

    return in_threads(overlay, list(zip(references, known, strict=True)), threads)


def _as_found(references: Collection, iteration: Iteration) -> Collection:
    """The references of an iteration in its order, turned as they were then."""
    turned = iteration.metrics.get("turned", {})
    theirs = Collection(tuple(references[name] for name in iteration.names), source=references.source)
    return theirs.turned([turned.get(name, 0) // 90 for name in theirs.names]) if turned else theirs


def _mesh(shape: Shape) -> Mesh:
    assert isinstance(shape, Mesh)
    return shape


def _found(procedure: Procedure, iteration: Iteration, crew: Workers, judge: Judge) -> dict[int, Found]:
    """What the iteration found, by row, built again: the replicas that it keeps on disk have no labels."""
    rows = [row for row, result in enumerate(iteration.results) if result.replica is not None and result.parameters]
    vectors = [iteration.results[row].parameters or {} for row in rows]
    builds = crew.build([_values(procedure.space, vector) for vector in vectors], give_up=True)
    return {
        row: Found(build.parameters, build.shape, iteration.results[row].distance)
        for row, build in zip(rows, builds, strict=True)
        if isinstance(build.shape, Mesh) and np.isfinite(iteration.results[row].distance)
    }


def _values(space: ParameterSpace, recorded: Parameters) -> Parameters:
    """Parameters of a record, of the types that the space has: JSON keeps 1.0 as it is, but not tuples."""
    return {name: recorded[name] for name in space.names}


def _inferred(
    space: ParameterSpace, predictor: Predictor | None, shapes: Sequence[Mesh], found: Sequence[Found]
) -> Inferred:
    """What the predictor says, or what was found with some doubt where none is known."""
    if predictor and [(p.name, p.classes) for p in predictor.space] == [(p.name, p.classes) for p in space]:
        return predictor.infer(shapes)
    columns = []
    for parameter in space:
        values = np.array([parameter.encode(each.parameters[parameter.name]) for each in found], dtype=np.float32)
        if parameter.classes:
            likely = np.full((len(found), parameter.classes), _DOUBT / parameter.classes, dtype=np.float32)
            likely[np.arange(len(found)), values.astype(int)] += 1.0 - _DOUBT
            values = likely
        columns.append(values)
    return columns


def _residuals(references: Iterable[Surface], replicas: Sequence[Mesh], threads: int | None) -> list[Residuals]:
    pairs = list(zip(references, replicas, strict=True))
    return in_threads(lambda pair: residuals(*pair), pairs, threads)


def _record(explained: Explained) -> dict[str, Any]:
    own, placed = explained.found.mesh.normalisation(), explained.residuals.placement
    scale = placed.scale / own.scale
    centre = (np.array(placed.centre) - own.centre) * own.scale
    return {
        "causes": [{"kind": c.kind, "text": c.text, "evidence": dict(c.evidence)} for c in explained.causes],
        "regions": [_region(region) for region in _told(explained)],
        "placement": {"centre": _rounded(centre), "scale": round(scale, 5)},
    }


def _told(explained: Explained) -> list[Region]:
    """What of the reference no parameters explain, and what of the replica found is too much; the weightiest first."""
    regions = [*explained.misfit.of("unexplained"), *explained.residuals.of("surplus")]
    return sorted(regions, key=lambda region: -region.weight)


def _region(region: Region) -> dict[str, Any]:
    return {
        "side": region.side,
        "centre": _rounded(region.centre),
        "size": _rounded(region.size),
        "axes": [_rounded(axis) for axis in region.axes],
        "share": round(region.share, 4),
        "distance": round(region.distance, 4),
        "label": region.label,
        "rule": region.rule,
    }


def _rounded(values: Any) -> list[float]:
    return [round(float(value), 4) for value in values]
