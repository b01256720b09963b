"""How well parameters are predicted: the paper's table (section 5.1) for any procedure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from shapewright.building import Executor, Workers
from shapewright.fitting.learning import Lesson, learn
from shapewright.fitting.pacing.pace import paced
from shapewright.fitting.pacing.stock import Stock
from shapewright.judging.judge import Judge
from shapewright.judging.target import Measures
from shapewright.judging.verdict import Grade
from shapewright.parameters import Prediction
from shapewright.prediction.inference import Metrics, score
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Stages
from shapewright.references import Collection
from shapewright.search.search import SearchStart, refine
from shapewright.settings import Cameras, Settings

REFINED = 100  # most held-out samples that the search is measured on, where no other number is asked for
VIEWS = (1, 2, 3, 5)  # numbers of cameras that are compared


@dataclass(frozen=True)
class Evaluation:
    """One training, measured on held-out samples, none of which it has seen."""

    settings: Settings  # of the training, its seed among them
    metrics: Metrics  # of the network alone, by parameter; see ``prediction.inference.score``
    refined: Metrics | None  # of parameters after the search, on the first held-out samples; None where it is off
    seconds: float  # that the training took, building samples included
    measured: tuple[Measures, ...] = ()  # how the refined replicas differ from the held-out samples
    grades: tuple[Grade, ...] = ()  # of these replicas


def evaluate(
    procedure: Procedure,
    settings: Settings | None = None,
    seeds: Sequence[int] | None = None,
    progress: Listener | None = None,
    refined: int = REFINED,
    executor: Executor | None = None,
) -> list[Evaluation]:
    """Train once for each seed, and measure; by default once, with the settings' own seed.

    refined: most held-out samples that the search is measured on. executor: builds, searches and judges on other
    machines, see ``sample``. Raises ProcedureError and ExecutorError as ``fit`` does.
    """
    settings = settings or Settings()
    evaluations = []
    for seed in [settings.seed] if seeds is None else seeds:
        chosen = replace(settings, seed=seed)
        stages = Stages(progress)
        with Workers.of(procedure, chosen, executor) as crew:
            stock = Stock(crew)
            chosen = paced(stock, chosen, stages)
            lesson = learn(crew, chosen, stages, stock=stock)
            stages.end()
            seconds = sum(stages.seconds.values())
            metrics = lesson.predictor.metrics
            after = (None, (), ()) if chosen.refine == "off" else _refined(crew, lesson, chosen, stages, refined)
        stages.end()
        evaluations.append(Evaluation(chosen, metrics, after[0], seconds, *after[1:]))
    return evaluations


def variants(settings: Settings, compared: Literal["cameras", "views", "both"] | None) -> list[Settings]:
    """The settings with each kind ("cameras") or number ("views") of cameras, or all combinations ("both")."""
    numbers = VIEWS if compared in ("views", "both") else (settings.views,)
    kinds = get_args(Cameras) if compared in ("cameras", "both") else (settings.cameras,)
    return [replace(settings, views=views, cameras=cameras) for views in numbers for cameras in kinds]


def summary(evaluations: Sequence[Evaluation]) -> dict[str, dict[str, tuple[float, float, float]]]:
    """By parameter, and by "network" or "refined": mean, least and largest MAE, or F1, over the evaluations."""
    table: dict[str, dict[str, tuple[float, float, float]]] = {}
    for label, chosen in (("network", [e.metrics for e in evaluations]), ("refined", [e.refined for e in evaluations])):
        for name in evaluations[0].metrics:
            errors = [m[name].get("mae", m[name].get("f1")) for m in chosen if m is not None and name in m]
            values = [value for value in errors if value is not None]
            if values:
                table.setdefault(name, {})[label] = (float(np.mean(values)), min(values), max(values))
    return table


def _refined(
    crew: Workers, lesson: Lesson, settings: Settings, stages: Stages, count: int
) -> tuple[Metrics, tuple[Measures, ...], tuple[Grade, ...]]:
    """The metrics after refinement, on the first ``count`` held-out rows; measures and grades of these replicas."""
    held_out = lesson.held_out.take(np.arange(min(count, len(lesson.held_out))))
    shapes = Collection.of({f"{i:03d}": shape for i, shape in enumerate(held_out.shapes)})
    sides: list[float | None] = [None] * len(shapes) if held_out.extents is None else held_out.extents.tolist()
    sized = tuple(replace(each, extent=side) for each, side in zip(shapes, sides, strict=True))
    judge = Judge.of(replace(shapes, references=sized), settings, crew=crew)
    prediction = lesson.predictor.infer(held_out.shapes, sides)
    _, fields = judge.nearest(crew.build(prediction.decode()))
    stages.begin("refine", 1)
    criterion = judge.criterion(range(len(fields)), fields)
    start, budget = SearchStart(prediction), lesson.budget(settings, len(prediction))
    refined = refine(start, criterion, crew, budget, settings.seed, stages.step)
    metrics = score(Prediction.of(crew.procedure.space, refined), held_out.targets, held_out.active)
    builds = crew.build(refined)
    measured = judge.measures(builds, judge.distances(builds))
    return metrics, tuple(measured), tuple(judge.grades(measured))
