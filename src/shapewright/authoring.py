"""One turn of the loop: sample, build, render, train, predict, build replicas, compare, group."""

from __future__ import annotations

import hashlib
import math
import platform
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from shapewright.building import Build, Limits, Workers, describe_failures
from shapewright.comparison import light_field
from shapewright.comparison.grouping import Group, group
from shapewright.comparison.silhouettes import intersection_over_union
from shapewright.comparison.surfaces import chamfer
from shapewright.iteration import Iteration, draw_pictures
from shapewright.parameters import Parameter, Scalar
from shapewright.prediction.dataset import make_dataset, meshes_of, split
from shapewright.prediction.predictor import Predictor
from shapewright.prediction.training import Epoch, Schedule, measure, train_network
from shapewright.procedure import Procedure
from shapewright.progress import Listener, Stages
from shapewright.references import Collection
from shapewright.rendering.cameras import THREE_VIEWS
from shapewright.rendering.raster import available_threads
from shapewright.results import Result, at_limit
from shapewright.settings import Settings
from shapewright.shapes import Mesh

VERSIONED = ("shapewright", "numpy", "torch", "numba", "manifold3d", "scikit-learn", "trimesh")


def fit(
    procedure: Procedure,
    references: Collection,
    settings: Settings | None = None,
    progress: Listener | None = None,
    cache: Path | None = None,
) -> Iteration:
    """One iteration: find parameters for every reference and say which the procedure cannot replicate yet.

    progress: called with a Progress a few times a second; ``print`` will do. cache: a folder that keeps the references'
    descriptors between iterations. The same seed, settings and machine give the same iteration. Raises ProcedureError
    when the procedure cannot build shapes.
    """
    settings = settings or Settings()
    stages = Stages(progress)
    with Workers(procedure, settings.workers, _limits(settings)) as crew:
        predictor, failures = _train(procedure, crew, settings, stages)
        stages.begin("predict", len(references))
        parameters = predictor.predict([reference.shape for reference in references])
        stages.begin("replicate", len(references))
        builds = crew.build(parameters, stages.step)
    comparison = _compare(references, builds, settings, stages, cache)
    results = _results(procedure, references, builds, comparison, settings)
    stages.begin("picture", 1)
    pictures = draw_pictures(results, settings.workers)
    stages.end()
    return Iteration(
        results=results,
        groups=comparison.groups,
        settings=settings,
        seconds=stages.seconds,
        procedure=_describe(procedure),
        source=procedure.source,
        collection={
            "source": references.source,
            "count": len(references),
            "skipped": {str(path): reason for path, reason in references.skipped.items()},
        },
        metrics={
            "samples": predictor.samples,
            **failures,
            "epochs": len(predictor.curve),
            "curve": [vars(epoch) for epoch in predictor.curve],
            "validation": predictor.metrics,
        },
        versions={"python": platform.python_version(), **{name: version(name) for name in VERSIONED}},
        created=datetime.now(UTC).isoformat(timespec="seconds"),
        pictures=pictures,
    )


def train(procedure: Procedure, settings: Settings | None = None, progress: Listener | None = None) -> Predictor:
    """Sample the procedure and train a predictor of its parameters. Raises ProcedureError as ``fit`` does."""
    settings = settings or Settings()
    stages = Stages(progress)
    with Workers(procedure, settings.workers, _limits(settings)) as crew:
        predictor, _ = _train(procedure, crew, settings, stages)
    stages.end()
    return predictor


@dataclass(frozen=True, eq=False)
class _Comparison:
    """By reference: distance, IoU, Chamfer (NaN where nothing was built); and the groups of the incompatible ones."""

    distance: Sequence[float]
    iou: Sequence[float]
    chamfer: Sequence[float]
    groups: tuple[Group, ...]


def _train(procedure: Procedure, crew: Workers, settings: Settings, stages: Stages) -> tuple[Predictor, dict[str, Any]]:
    space = procedure.space
    vectors = space.sample(settings.samples, seed=settings.seed)
    stages.begin("sample", len(vectors))
    builds = crew.build(vectors, stages.step)
    good, meshes = meshes_of(builds)
    stages.begin("render", len(meshes))
    parameters = [build.parameters for build in good]
    data = make_dataset(space, parameters, meshes, THREE_VIEWS, settings.image_size, settings.workers)
    training, validation, held_out = (data.take(rows) for rows in split(len(data), settings.seed))
    schedule = Schedule(settings.epochs, settings.batch, settings.learning_rate, seed=settings.seed)
    stages.begin("train", settings.epochs)

    def tell(epoch: Epoch) -> None:
        stages.step(epoch.epoch, settings.epochs, f"validation loss {epoch.validation:.3f}")

    network, curve = train_network(space, training, validation, schedule, tell, settings.workers)
    metrics = measure(network, space, held_out)
    failed = [build for build in builds if build.failure]
    failures = {"failed": len(failed), "failures": describe_failures(failed) if failed else ""}
    predictor = Predictor(space, network, THREE_VIEWS, settings.image_size, metrics, curve, len(data), settings.workers)
    return predictor, failures


def _compare(
    references: Collection, builds: Sequence[Build], settings: Settings, stages: Stages, cache: Path | None
) -> _Comparison:
    shapes = [reference.shape for reference in references]
    stages.begin("compare", len(shapes))
    theirs = _descriptors(shapes, settings.workers, cache)
    ours = _descriptors([build.shape if isinstance(build.shape, Mesh) else None for build in builds], settings.workers)
    distance, iou, surface = (np.full(len(shapes), np.nan) for _ in range(3))
    for i, (their, our, build) in enumerate(zip(theirs, ours, builds, strict=True)):
        if their and our and isinstance(build.shape, Mesh):
            distance[i] = light_field.distance(their, our, align=settings.align)
            surface[i] = chamfer(shapes[i], build.shape, seed=settings.seed)
            (iou[i],) = intersection_over_union([shapes[i]], [build.shape], threads=1)
        stages.step(i + 1, len(shapes))
    misfits = [(i, their) for i, their in enumerate(theirs) if their and not distance[i] <= settings.threshold]
    stages.begin("group", len(misfits))
    between = light_field.distances([their for _, their in misfits], align=settings.align, threads=settings.workers)
    groups = group([references.names[i] for i, _ in misfits], between, settings.cut, settings.cut_absolute)
    return _Comparison(distance.tolist(), iou.tolist(), surface.tolist(), groups)


def _descriptors(
    shapes: Sequence[Mesh | None], threads: int | None, cache: Path | None = None
) -> list[light_field.Descriptor | None]:
    """None where there is no mesh, or one so thin that no view shows it."""

    def describe(mesh: Mesh | None) -> light_field.Descriptor | None:
        try:
            return light_field.descriptor(mesh, cache=cache) if mesh else None
        except ValueError:
            return None

    with ThreadPoolExecutor(threads or available_threads()) as pool:
        return list(pool.map(describe, shapes))


def _results(
    procedure: Procedure,
    references: Collection,
    builds: Sequence[Build],
    comparison: _Comparison,
    settings: Settings,
) -> tuple[Result, ...]:
    group_of = {name: i for i, found in enumerate(comparison.groups) for name in found.members}
    measures = zip(comparison.distance, comparison.iou, comparison.chamfer, strict=True)
    return tuple(
        Result(
            name=reference.name,
            path=reference.path,
            parameters=build.parameters,
            active=procedure.space.active(build.parameters),
            at_limit=at_limit(procedure.space, build.parameters) if isinstance(build.shape, Mesh) else (),
            replica=build.shape if isinstance(build.shape, Mesh) else None,
            distance=distance,
            iou=iou,
            chamfer=surface,
            compatible=distance <= settings.threshold,
            group=group_of.get(reference.name),
            reference=reference.shape,
            error=_error(build, distance),
        )
        for reference, build, (distance, iou, surface) in zip(references, builds, measures, strict=True)
    )


def _error(build: Build, distance: float) -> str | None:
    if build.failure:
        return f"{build.failure.kind}: {build.failure.message}"
    return "so thin that no view shows it: it cannot be compared" if math.isnan(distance) else None


def _limits(settings: Settings) -> Limits:
    return Limits(settings.shape_seconds, settings.shape_memory_mb)


def _describe(procedure: Procedure) -> Mapping[str, Any]:
    source = procedure.source
    return {
        "name": procedure.name,
        "path": str(procedure.path) if procedure.path else None,
        "digest": hashlib.sha256(source.encode()).hexdigest()[:16],
        "parameters": [_describe_parameter(parameter) for parameter in procedure.space],
    }


def _describe_parameter(parameter: Parameter) -> dict[str, Any]:
    steps = parameter.steps if isinstance(parameter, Scalar) else None
    return {
        "name": parameter.name,
        "kind": type(parameter).__name__.lower(),
        "low": getattr(parameter, "low", None),
        "high": getattr(parameter, "high", None),
        "steps": list(steps) if isinstance(steps, tuple) else steps,
        "options": list(getattr(parameter, "options", ())) or None,
        "default": parameter.default,
    }
