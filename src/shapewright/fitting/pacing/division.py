"""A limit of time for a whole fit, divided between samples, training and search by what a shape costs."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from shapewright.settings import Settings

SAMPLES_SHARE = 2 / 3
"""Of the time that is free, for samples and training. Our estimate: build123d's bracket was found from 500 samples."""
_LEARN_SECONDS = 4.5e-4
"""Wall time of one sample in one epoch of the compact network, at 3 views of 64 pixels, on two cores: 3,000 samples and
15 epochs take 14 to 16 s (docs/benchmarks.md). Pictures come on top."""
_MEASURE_SECONDS = 0.012
"""CPU time of measuring one shape in a search: docs/benchmarks.md has 3 to 11 ms a pair."""
_LEAST_SAMPLES = 20


@dataclass(frozen=True)
class Work:
    """What a fit does, in shapes that it builds.

    samples: at most.
    references: that are replicated.
    fixed: shapes that are built whatever the limit is.
    search: shapes that a whole search builds for each reference; 0 where there is none.
    """

    samples: int
    references: int
    fixed: int
    search: int

    def shapes(self, settings: Settings) -> float:
        """All shapes together, with the settings' own limit of a search."""
        return self.samples + self.fixed + self.references * (settings.refine_shapes or self.search)


def divided(settings: Settings, work: Work, shape_seconds: float, workers: int, left: float) -> Settings:
    """The settings with numbers of samples and of shapes of a search that take about ``left`` seconds.

    Samples get two thirds of what is free, the search the rest; what one of them cannot use goes to the other. The
    result depends on the arguments alone, and has no limit of time any more: a fit with it gives the same again.

    shape_seconds: of building one shape. workers: that build side by side.
    """
    building = shape_seconds / workers
    sample = building + _LEARN_SECONDS * settings.epochs * (settings.image_size / 64) ** 2 * settings.views / 3
    rounds = settings.rounds + 1
    tried = rounds * work.references * (building + _MEASURE_SECONDS / workers)
    free = max(left - work.fixed * building, 0.0)

    def fit(seconds: float, each: float, most: int) -> int:
        return max(0, min(most, math.floor(seconds / each))) if each > 0.0 else most

    samples = fit(free * (SAMPLES_SHARE if work.search else 1.0), sample, work.samples)
    search = fit(free - samples * sample, tried, work.search)
    samples = fit(free - search * tried, sample, work.samples)
    return replace(
        settings,
        within=None,
        samples=max(samples, min(_LEAST_SAMPLES, work.samples)),
        refine_shapes=max(search, 1) if work.search else settings.refine_shapes,
    )
