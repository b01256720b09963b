"""How far a sweep is: new replicas for the collection, first their pictures and then their measures."""

from __future__ import annotations

import time
from collections.abc import Callable

from shapewright.studio.jobs.remaining import left
from shapewright.studio.project.timings import Timings
from shapewright.studio.wire.work import JobStage, Sweep

_INTERVAL = 0.25
"""Seconds between two words about a sweep."""
_BUILD, _MEASURE = "build", "measure"


class Sweeps:
    """The sweep that runs, if one does."""

    def __init__(self, timings: Timings, changed: Callable[[Sweep | None], object]) -> None:
        """changed: called with how far the sweep is, None at its end."""
        self._timings, self._changed = timings, changed
        self._number: int | None = None
        self._stages: list[JobStage] = []
        self._started = self._told = 0.0

    def begin(self, number: int, count: int) -> None:
        """A sweep over so many references begins, in place of one that may run."""
        if not count:
            self.stop()
            return
        self._number, self._started = number, time.monotonic()
        self._stages = [JobStage(name=_BUILD, done=0, total=count, remark="", seconds=0.0)]
        self._tell()

    def step(self, number: int, measured: bool) -> None:
        """A replica was built, or measured."""
        if number != self._number:
            return
        if measured and len(self._stages) == 1:
            self._stages[0].seconds = self._elapsed
            total = self._stages[0].total
            self._stages.append(JobStage(name=_MEASURE, done=0, total=total, remark="", seconds=0.0))
        stage = self._stages[-1]
        stage.done = min(stage.done + 1, stage.total)
        stage.seconds = self._elapsed - sum(each.seconds for each in self._stages[:-1])
        if time.monotonic() - self._told >= _INTERVAL:
            self._tell()

    def end(self, number: int) -> None:
        """It is at its end."""
        if number == self._number:
            if len(self._stages) == 2:
                self._timings.note("sweep", self._stages)
            self.stop()

    def stop(self) -> None:
        """What it shows is wanted no longer."""
        if self._number is not None:
            self._number = None
            self._changed(None)

    def sweep(self) -> Sweep | None:
        """As the page gets it."""
        if self._number is None:
            return None
        usual = self._timings.of("sweep")
        return Sweep(
            done=sum(stage.done for stage in self._stages),
            total=2 * self._stages[0].total,
            seconds=round(self._elapsed, 2),
            left=left(self._stages, usual),
        )

    @property
    def _elapsed(self) -> float:
        return time.monotonic() - self._started

    def _tell(self) -> None:
        self._told = time.monotonic()
        self._changed(self.sweep())
