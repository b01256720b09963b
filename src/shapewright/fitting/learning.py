"""Learning a procedure: sample it, build and draw the samples, train a predictor on them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from shapewright.building import Build, Workers, describe_failures
from shapewright.fitting.adaptive import around
from shapewright.fitting.keeping.trained import trained_form
from shapewright.fitting.keeping.unfinished import Unfinished
from shapewright.fitting.pacing.pace import paced
from shapewright.fitting.pacing.stock import Stock
from shapewright.fitting.sensitivity import without_effect
from shapewright.fitting.standing import lying
from shapewright.fitting.start import Start, as_large
from shapewright.parameters import Parameters, ParameterSpace
from shapewright.prediction.augmentation import augmented
from shapewright.prediction.dataset import Dataset, join, make_dataset, shapes_of, split
from shapewright.prediction.devices import pick
from shapewright.prediction.inference import measure
from shapewright.prediction.predictor import Predictor
from shapewright.prediction.scanning import scanned
from shapewright.prediction.training import Epoch, Schedule, Trained, train_network
from shapewright.prediction.vgg import VGG19Network, find_weights
from shapewright.prediction.views.silhouettes import redrawn, view_dataset
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Stages
from shapewright.rendering.cameras import ANYWHERE, PAGE, Camera, starting_views
from shapewright.search.budgets import Budget, Sought, whole
from shapewright.settings import Searching, Settings
from shapewright.shapes import Drawing, Mesh, Points, ReferenceShape, Shape, extent_of

FIRST = 256  # samples that are built and drawn before all others, for the first answer


@dataclass(frozen=True, eq=False)
class Lesson:
    """What was learned of a procedure."""

    predictor: Predictor  # the trained one
    training: Dataset  # the samples that it learned from
    validation: Dataset  # the samples that its spreads were calibrated on
    held_out: Dataset  # the samples that it was measured on
    facts: dict[str, Any]  # what a run records of the samples and of the training

    def budget(self, settings: Searching, references: int) -> Budget:
        """How long to refine each reference: what the settings say, or less where a shape takes long to build.

        A search for few references may build as many shapes as there are samples, however long one takes.
        """
        thorough = settings.refine == "thorough"
        scalars = int(self.predictor.space.scalars.sum())
        budget = whole(self._sought, thorough, numbers=scalars > 0)
        seconds = 10.0 * settings.refine_seconds if thorough else settings.refine_seconds
        affordable = max(seconds / max(self.facts["build_seconds"], 1e-6), len(self.training) / max(references, 1))
        evaluations = settings.refine_shapes or affordable
        return budget.within(evaluations, scalars)

    @property
    def _sought(self) -> Sought:
        if self.training.kind is Drawing:
            return "drawings"
        if self.training.cameras == (ANYWHERE,):
            return "views"
        return "scans" if _has_points(self.training.shapes) else "meshes"


def train(procedure: Procedure, settings: Settings | None = None, progress: Listener | None = None) -> Predictor:
    """Sample the procedure and train a predictor of its parameters. Raises ProcedureError as ``fit`` does."""
    settings = settings or Settings()
    stages = Stages(progress)
    with Workers.of(procedure, settings) as crew:
        stock = Stock(crew)
        lesson = learn(crew, paced(stock, settings, stages), stages, stock=stock)
    stages.end()
    return lesson.predictor


def learn(
    crew: Workers,
    settings: Settings,
    stages: Stages,
    start: Start | None = None,
    stock: Stock | None = None,
    unfinished: Unfinished | None = None,
) -> Lesson:
    """Train on random samples of the whole space.

    start: of a fit. Its references say whether the procedure is to build meshes or drawings; by default it may build
    either. Its predictor is trained further. ``stages`` gets a first answer for its references: the known parameters
    at once, or those of the most similar of the first samples. stock: samples that are built already. unfinished: keeps
    the trained network.
    """
    unfinished = unfinished or Unfinished()
    stock = stock or Stock(crew)
    space, previous = crew.procedure.space, start.predictor if start else None
    if start and start.resumed:
        stages.answer(start.answer, "carried over")
    schedule = _schedule(settings, previous)
    count = min(settings.samples, settings.warm_samples) if previous else settings.samples
    vectors = space.sample(count, seed=settings.seed)
    stages.begin("sample", len(vectors))
    if kept := stock.hold(vectors, settings.seed):
        stages.tell(kept)
    builds = stock.build(vectors[:FIRST], lambda done, _: stages.step(done, len(vectors)), give_up=True)
    kind: type[Shape] = next((type(build.shape) for build in builds if build.shape is not None), Mesh)
    if start:
        kind = start.references.kind
    cameras = _cameras(kind, settings, previous)
    if start and start.references.in_views:
        cameras = (ANYWHERE,)
    first = _draw(crew.procedure, builds, cameras, settings, kind)
    if start and not start.resumed:
        stages.answer(start.most_similar(first, settings.workers), "most similar samples")
        if found := lying(start.references, first, crew.procedure.facts.up):
            stages.tell(found.notice)
        if sized := as_large(start.references, builds, crew.procedure):
            stages.tell(sized)
    builds += stock.build(vectors[FIRST:], lambda done, total: stages.step(FIRST + done, FIRST + total))
    inert = without_effect(space, shapes_of(builds, kind)[0], crew.build, settings.seed, settings.workers)
    stages.begin("render", len(vectors))
    data = join([first, _draw(crew.procedure, builds[FIRST:], cameras, settings, kind)]) if builds[FIRST:] else first
    parts = [data.take(rows) for rows in split(len(data), settings.seed)]
    if settings.augment:
        parts[0] = augmented(parts[0], settings.seed, settings.workers)
    if start and start.references.has_points:
        parts = [scanned(part, settings.seed + number, settings.workers) for number, part in enumerate(parts)]
    failed = [build for build in builds if build.failure]
    facts = {
        "build_seconds": float(np.median([build.seconds for build in builds])),
        "failed": len(failed),
        "failures": describe_failures(failed) if failed else "",
        "without_effect": inert,
        "cameras": {"before": _places(cameras)},
        "device": pick(schedule.device).type,
    }
    facts = unfinished.once("facts", facts)
    keep = _Keep(unfinished, "network0")
    return _train(space, parts, facts, settings, schedule, stages, previous, keep)


@dataclass(frozen=True)
class _Keep:
    """Where a trained network is kept."""

    unfinished: Unfinished
    name: str


def learn_more(
    crew: Workers,
    settings: Settings,
    stages: Stages,
    lesson: Lesson,
    centres: Sequence[Parameters],
    number: int,
    unfinished: Unfinished,
) -> Lesson:
    """Train further with samples around the centres; what predictions are measured on stays. number: round, from 0."""
    space, seed = crew.procedure.space, settings.seed + number + 1
    vectors = around(space, centres, lesson.predictor.metrics, settings.round_samples, seed)
    stages.begin("sample", len(vectors))
    builds = crew.build(vectors, stages.step)
    stages.begin("render", len(vectors))
    seen = {tuple(p.values()) for part in (lesson.validation, lesson.held_out) for p in part.parameters}
    fresh = [build for build in builds if build.shape is not None and tuple(build.parameters.values()) not in seen]
    if not fresh:
        return lesson
    added = _draw(crew.procedure, fresh, lesson.predictor.cameras, settings, lesson.training.kind)
    if settings.augment:
        added = augmented(added, settings.seed + len(lesson.training), settings.workers)
    if _has_points(lesson.training.shapes):
        added = scanned(added, settings.seed + len(lesson.training), settings.workers)
    training = join([lesson.training, added])
    parts = [training, lesson.validation, lesson.held_out]
    schedule = _schedule(settings, lesson.predictor)
    keep = _Keep(unfinished, f"network{number + 1}")
    return _train(space, parts, lesson.facts, settings, schedule, stages, lesson.predictor, keep)


def _train(
    space: ParameterSpace,
    parts: Sequence[Dataset],
    facts: dict[str, Any],
    settings: Settings,
    schedule: Schedule,
    stages: Stages,
    previous: Predictor | None,
    keep: _Keep,
) -> Lesson:
    training, validation, held_out = parts
    if training.kind is Drawing or training.cameras == (ANYWHERE,):
        schedule = replace(schedule, camera_rate=0.0)
    stages.begin("train", schedule.epochs)

    def tell(epoch: Epoch) -> None:
        losses = {name: value if math.isfinite(value) else None for name, value in vars(epoch).items()}
        stages.step(epoch.epoch, schedule.epochs, f"validation loss {epoch.validation:.3f}", losses)

    def redraw(data: Dataset, epoch: int) -> Dataset:
        return redrawn(data, np.random.default_rng([settings.seed, epoch]), settings.workers)

    initial = previous.network if previous else None
    again = redraw if training.cameras == (ANYWHERE,) else None

    def made() -> Trained:
        return train_network(space, training, validation, schedule, tell, settings.workers, initial, again)

    form = trained_form(space, schedule, training.size, training.extents is not None)
    trained = keep.unfinished.piece(keep.name, form, made)
    training, validation, held_out = (part.seen_by(trained.cameras, settings.workers) for part in parts)
    network, cameras, size = trained.network, trained.cameras, settings.image_size
    metrics, samples = measure(network, space, held_out), sum(map(len, parts))
    predictor = Predictor(space, network, cameras, size, metrics, trained.curve, samples, settings.workers)
    places = {**facts["cameras"], "after": _places(cameras)}
    weights = str(schedule.weights) if schedule.weights else None
    return Lesson(predictor, training, validation, held_out, {**facts, "cameras": places, "weights": weights})


def _cameras(kind: type[Shape], settings: Settings, previous: Predictor | None) -> tuple[Camera, ...]:
    """Those of the previous predictor, where it has as many."""
    if previous and previous.cameras == (ANYWHERE,):
        previous = None
    if kind is not Drawing and previous and len(previous.cameras) == settings.views:
        return previous.cameras
    return (PAGE,) if kind is Drawing else starting_views(settings.views, settings.camera_distance)


def _draw(
    procedure: Procedure, builds: Sequence[Build], cameras: Sequence[Camera], settings: Settings, kind: type[Shape]
) -> Dataset:
    good, shapes = shapes_of(builds, kind)
    vectors, size = [build.parameters for build in good], settings.image_size
    if tuple(cameras) == (ANYWHERE,):
        return view_dataset(procedure.space, vectors, shapes, size, settings.seed, settings.workers)
    sides = None
    if procedure.facts.size == "given":
        sides = [extent_of(build.shape) for build in good if build.shape is not None]
    return make_dataset(procedure.space, vectors, shapes, cameras, size, settings.workers, sides)


def _has_points(shapes: Iterable[ReferenceShape]) -> bool:
    return any(isinstance(shape, Points) for shape in shapes)


def _schedule(settings: Settings, previous: Predictor | None) -> Schedule:
    """How to train; weights are looked for here, so that a wrong path fails before anything is built."""
    starts = settings.network == "vgg19" and not (previous and isinstance(previous.network, VGG19Network))
    return Schedule(
        epochs=settings.warm_epochs if previous else settings.epochs,
        batch=settings.batch,
        learning_rate=settings.learning_rate,
        weight_decay=settings.weight_decay,
        optimiser=settings.optimiser,
        camera_rate=settings.camera_rate if settings.cameras == "learned" else 0.0,
        network=settings.network,
        weights=find_weights(settings.weights) if starts else None,
        device=settings.device,
        seed=settings.seed,
    )


def _places(cameras: Sequence[Camera]) -> list[list[float]]:
    """Azimuth and elevation in degrees, and distance, of every camera that can be moved."""
    return [[camera.azimuth, camera.elevation, camera.distance] for camera in cameras if camera not in (PAGE, ANYWHERE)]
