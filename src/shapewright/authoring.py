"""One turn of the loop: sample, build, render, train, predict, build replicas, compare, group."""

from __future__ import annotations

import hashlib
import math
import platform
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Build, Limits, Workers, describe_failures
from shapewright.comparison.grouping import Group
from shapewright.iteration import Iteration, draw_pictures
from shapewright.judge import Judge
from shapewright.parameters import Parameter, Scalar
from shapewright.prediction.dataset import make_dataset, meshes_of, split
from shapewright.prediction.predictor import Predictor
from shapewright.prediction.refinement import QUICK, THOROUGH, refine
from shapewright.prediction.training import Epoch, Schedule, measure, train_network
from shapewright.procedure import Procedure
from shapewright.progress import Listener, Stages
from shapewright.references import Collection
from shapewright.rendering.cameras import THREE_VIEWS
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
        stages.begin("describe", len(references))
        judge = Judge.of(references, settings, cache)
        stages.begin("predict", len(references))
        inferred = predictor.infer([reference.shape for reference in references])
        builds, distances = _replicate(procedure, crew, judge, predictor, inferred, settings, stages)
    stages.begin("compare", len(references))
    groups = judge.groups(distances)
    results = _results(procedure, references, builds, distances, judge.overlaps(builds), groups, settings.threshold)
    stages.begin("picture", 1)
    pictures = draw_pictures(results, settings.workers)
    stages.end()
    return Iteration(
        results=results,
        groups=groups,
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


def _train(procedure: Procedure, crew: Workers, settings: Settings, stages: Stages) -> tuple[Predictor, dict[str, Any]]:
    space = procedure.space
    vectors = space.sample(settings.samples, seed=settings.seed)
    stages.begin("sample", len(vectors))
    builds = crew.build(vectors, stages.step, give_up=True)
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


def _replicate(
    procedure: Procedure,
    crew: Workers,
    judge: Judge,
    predictor: Predictor,
    inferred: Sequence[NDArray[np.float32]],
    settings: Settings,
    stages: Stages,
) -> tuple[list[Build], NDArray[np.float64]]:
    """The replica of each reference, predicted or refined, whichever is nearer; and its distance."""
    stages.begin("replicate", 1)
    builds = crew.build(predictor.decode(inferred))
    distances = judge.distances(builds)
    if settings.refine == "off":
        return builds, distances
    stages.begin("refine", 1)
    budget = QUICK if settings.refine == "quick" else THOROUGH
    vectors = refine(procedure.space, inferred, crew, judge.search_costs, budget, settings.seed, stages.step)
    refined = crew.build(vectors)
    nearer = judge.distances(refined)
    chosen = ~(nearer >= distances)
    best = [new if better else old for new, old, better in zip(refined, builds, chosen, strict=True)]
    return best, np.where(chosen, nearer, distances)


def _results(
    procedure: Procedure,
    references: Collection,
    builds: Sequence[Build],
    distances: NDArray[np.float64],
    overlaps: tuple[NDArray[np.float64], NDArray[np.float64]],
    groups: Sequence[Group],
    threshold: float,
) -> tuple[Result, ...]:
    group_of = {name: i for i, found in enumerate(groups) for name in found.members}
    return tuple(
        Result(
            name=reference.name,
            path=reference.path,
            parameters=build.parameters,
            active=procedure.space.active(build.parameters),
            at_limit=at_limit(procedure.space, build.parameters) if isinstance(build.shape, Mesh) else (),
            replica=build.shape if isinstance(build.shape, Mesh) else None,
            distance=float(distance),
            iou=float(iou),
            chamfer=float(surface),
            compatible=bool(distance <= threshold),
            group=group_of.get(reference.name),
            reference=reference.shape,
            error=_error(build, distance),
        )
        for reference, build, distance, iou, surface in zip(references, builds, distances, *overlaps, strict=True)
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
