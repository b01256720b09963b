"""The first shapes of a fit: what one costs is told before anything long starts, and whether it is always the same."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shapewright.building import Build
from shapewright.fitting.pacing.division import Work, divided
from shapewright.fitting.pacing.opening import PROBES, asked_of, cost_watch, lasting
from shapewright.fitting.pacing.steadiness import unsteady
from shapewright.fitting.pacing.stock import Stock
from shapewright.fitting.start import Start
from shapewright.parameters import ParameterSpace
from shapewright.progress import Notice, Stages
from shapewright.search.budgets import Sought, whole
from shapewright.settings import Settings
from shapewright.shapes import Drawing

_TRIED = 4
"""Shapes that are built for each parameter, to see whether it has an effect: at least."""


def paced(stock: Stock, settings: Settings, stages: Stages, start: Start | None = None) -> Settings:
    """The settings, with ``within`` divided by what the first samples cost.

    It tells how long the samples take, where that is long, and what makes it shorter; and of a procedure that builds
    another shape from the same parameters. Raises ProcedureError as ``Workers.build`` does.
    """
    crew, space = stock.crew, stock.crew.procedure.space
    vectors = space.sample(asked_of(settings, bool(start and start.predictor)), seed=settings.seed)
    stages.begin("sample", len(vectors))
    watch = cost_watch(crew, len(vectors), settings, stages.tell)

    def step(done: int, _: int) -> None:
        stages.step(done, len(vectors))
        watch()

    builds = stock.fresh(vectors[:PROBES], step)
    wrong = unsteady(crew, builds)
    if wrong:
        stages.tell(wrong)
        stock.forget()
    seconds = float(np.mean([build.seconds for build in builds]))
    if settings.within is not None:
        work = _work(space, settings, builds, len(vectors), start)
        left = settings.within - stages.elapsed
        counted = divided(settings, work, seconds, crew.count, left)
        stages.tell(_division(settings.within, counted, seconds))
        return counted
    return settings


def _work(
    space: ParameterSpace, settings: Settings, builds: Sequence[Build], samples: int, start: Start | None
) -> Work:
    """What a fit builds besides samples; a training alone replicates nothing."""
    references = len(start.references) if start else 0
    replicas = references * (2 + (4 if settings.facing == "found" else 0))
    rounds = settings.rounds * (settings.round_samples + 2 * references)
    scalars = int(space.scalars.sum())
    budget = whole(_sought(builds, start), settings.refine == "thorough", numbers=scalars > 0)
    search = 0 if settings.refine == "off" or not references else budget.evaluations(scalars)
    return Work(samples, references, _TRIED * len(space) + replicas + rounds, search)


def _sought(builds: Sequence[Build], start: Start | None) -> Sought:
    if any(isinstance(build.shape, Drawing) for build in builds):
        return "drawings"
    if start and start.references.in_views:
        return "views"
    return "scans" if start and start.references.has_points else "meshes"


def _division(within: float, settings: Settings, seconds: float) -> Notice:
    text = f"one shape takes {lasting(seconds)}: {settings.samples:,} samples"
    if settings.refine_shapes and settings.refine != "off":
        text += f", and {settings.refine_shapes} shapes of a search for each reference,"
    return Notice("within", f"{text} fit in {lasting(within)}")
