"""The first shapes of a fit: what one costs is told before anything long starts, and whether it is always the same."""

from __future__ import annotations

import time
from collections.abc import Sequence

import numpy as np

from shapewright.building import Build
from shapewright.fitting.pacing.division import Work, divided
from shapewright.fitting.pacing.steadiness import unsteady
from shapewright.fitting.pacing.stock import PROBES, Stock
from shapewright.fitting.start import Start
from shapewright.parameters import ParameterSpace
from shapewright.progress import Notice, Stages
from shapewright.search.budgets import Sought, whole
from shapewright.settings import Settings
from shapewright.shapes import Drawing

_PATIENCE = 3.0
"""Seconds after which something is told although few shapes are there yet, or none."""
_ENOUGH = 3
"""Shapes that tell the cost of others. The first of each process may have something to load."""
_SLOW = 30.0
"""Seconds of building samples from which on their cost is told."""
_FEW = 500
"""Samples that do for many procedures of CAD: build123d's bracket was found in 12 of 12 references by so many."""
_TRIED = 4
"""Shapes that are built for each parameter, to see whether it has an effect: at least."""


def paced(stock: Stock, settings: Settings, stages: Stages, start: Start | None = None) -> Settings:
    """The settings, with ``within`` divided by what the first samples cost.

    It tells how long the samples take, where that is long, and what makes it shorter; and of a procedure that builds
    another shape from the same parameters. Raises ProcedureError as ``Workers.build`` does.
    """
    crew, space = stock.crew, stock.crew.procedure.space
    most = min(settings.samples, settings.warm_samples) if start and start.predictor else settings.samples
    vectors = space.sample(most, seed=settings.seed)
    stages.begin("sample", len(vectors))
    begun, told, before = time.perf_counter(), "", len(crew.costs)

    def step(done: int, _: int) -> None:
        nonlocal told
        stages.step(done, len(vectors))
        costs, spent = crew.costs[before:], time.perf_counter() - begun
        if told != "cost" and (len(costs) >= _ENOUGH or (costs and spent > _PATIENCE)):
            told = "cost"
            tell_cost(float(np.median(costs)))
        elif not told and spent > _PATIENCE:
            told = "wait"
            stages.tell(_wait(spent, len(vectors), crew.count))

    def tell_cost(seconds: float) -> None:
        if settings.within is None and seconds * len(vectors) / crew.count > _SLOW:
            stages.tell(_cost(seconds, len(vectors), crew.count))

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
    budget = whole(_sought(builds, start), settings.refine == "thorough")
    search = 0 if settings.refine == "off" or not references else budget.evaluations(int(space.scalars.sum()))
    return Work(samples, references, _TRIED * len(space) + replicas + rounds, search)


def _sought(builds: Sequence[Build], start: Start | None) -> Sought:
    if any(isinstance(build.shape, Drawing) for build in builds):
        return "drawings"
    if start and start.references.in_views:
        return "views"
    return "scans" if start and start.references.has_points else "meshes"


def _wait(seconds: float, samples: int, cores: int) -> Notice:
    text = f"no shape is built after {lasting(seconds)}: if each takes as long, {samples:,} samples take "
    return Notice("waiting", f"{text}{lasting(seconds * samples / cores)} on {_cores(cores)}")


def _cores(count: int) -> str:
    return "1 core" if count == 1 else f"{count} cores"


def _cost(seconds: float, samples: int, cores: int) -> Notice:
    text = f"one shape takes {lasting(seconds)}: {samples:,} samples take "
    text += f"about {lasting(seconds * samples / cores)} on {_cores(cores)}"
    if samples > _FEW:
        text += f"; {_FEW} take {lasting(seconds * _FEW / cores)}"
    return Notice("pace", text)


def _division(within: float, settings: Settings, seconds: float) -> Notice:
    text = f"one shape takes {lasting(seconds)}: {settings.samples:,} samples"
    if settings.refine_shapes and settings.refine != "off":
        text += f", and {settings.refine_shapes} shapes of a search for each reference,"
    return Notice("within", f"{text} fit in {lasting(within)}")


def lasting(seconds: float) -> str:
    """A time in words, to two digits: 0.25 s, 40 s, 8 min, 1.6 h."""
    if seconds < 90.0:
        return f"{float(f'{seconds:.2g}'):g} s"
    return f"{float(f'{seconds / 60:.2g}'):g} min" if seconds < 5400.0 else f"{float(f'{seconds / 3600:.2g}'):g} h"
