"""How well the parameters of a procedure can be found: the paper's table (section 5.1) for any procedure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from shapewright.building import Workers
from shapewright.fitting.learning import Lesson, learn, limits_of
from shapewright.fitting.replicas import refined_from
from shapewright.judging.judge import Judge
from shapewright.parameters import Prediction
from shapewright.prediction.inference import Metrics, score
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Stages
from shapewright.references import Collection
from shapewright.settings import Cameras, Settings

REFINED = 100
"""Held-out samples that refinement is measured on, at most, where no other number is asked for."""

VIEWS = (1, 2, 3, 5)
CAMERAS: tuple[Cameras, ...] = get_args(Cameras)


@dataclass(frozen=True)
class Trial:
    """One training and what it gave on held-out samples, none of which it has seen.

    metrics: of the network alone. refined: of the same rows after refinement, None where that is off.
    """

    settings: Settings
    metrics: Metrics
    refined: Metrics | None
    seconds: float


def evaluate(
    procedure: Procedure,
    settings: Settings | None = None,
    seeds: Sequence[int] | None = None,
    progress: Listener | None = None,
    refined: int = REFINED,
) -> list[Trial]:
    """A trial for each seed; by default one, with the settings' own seed. Raises ProcedureError as ``fit`` does.

    refined: held-out samples that refinement is measured on, at most.
    """
    settings = settings or Settings()
    trials = []
    for seed in [settings.seed] if seeds is None else seeds:
        chosen = replace(settings, seed=seed)
        stages = Stages(progress)
        with Workers(procedure, chosen.workers, limits_of(chosen)) as crew:
            lesson = learn(crew, chosen, stages)
            stages.end()
            seconds = sum(stages.seconds.values())
            metrics = None if chosen.refine == "off" else _refined(crew, lesson, chosen, stages, refined)
        stages.end()
        trials.append(Trial(chosen, lesson.predictor.metrics, metrics, seconds))
    return trials


def variants(settings: Settings, compared: Literal["cameras", "views", "both"] | None) -> list[Settings]:
    """The settings with each kind ("cameras") or number ("views") of cameras, or all combinations ("both")."""
    found = [settings]
    if compared in ("views", "both"):
        found = [replace(each, views=views) for each in found for views in VIEWS]
    if compared in ("cameras", "both"):
        found = [replace(each, cameras=cameras) for each in found for cameras in CAMERAS]
    return found


def summary(trials: Sequence[Trial]) -> dict[str, dict[str, tuple[float, float, float]]]:
    """Per parameter and measure (mae, or f1; and refined) the mean over the trials, the least and the most."""
    table: dict[str, dict[str, tuple[float, float, float]]] = {}
    for label, chosen in (("network", [t.metrics for t in trials]), ("refined", [t.refined for t in trials])):
        for name in trials[0].metrics:
            found = [m[name].get("mae", m[name].get("f1")) for m in chosen if m is not None and name in m]
            values = [value for value in found if value is not None]
            if values:
                table.setdefault(name, {})[label] = (float(np.mean(values)), min(values), max(values))
    return table


def _refined(crew: Workers, lesson: Lesson, settings: Settings, stages: Stages, count: int) -> Metrics:
    """The metrics after refinement, on the first ``count`` held-out rows."""
    held_out = lesson.held_out.take(np.arange(min(count, len(lesson.held_out))))
    shapes = Collection.of({f"{i:03d}": shape for i, shape in enumerate(held_out.shapes)})
    judge = Judge.of(shapes, settings)
    prediction = lesson.predictor.infer(held_out.shapes)
    _, fields = judge.nearest(crew.build(prediction.decode()))
    refined = refined_from(prediction, crew, judge, range(len(fields)), fields, lesson, stages)
    return score(Prediction.of(crew.procedure.space, refined), held_out.targets, held_out.active)
