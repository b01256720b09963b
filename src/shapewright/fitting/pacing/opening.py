"""The first samples of a fit: built before anything heavy is loaded, since they tell what a shape costs."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from types import TracebackType

import numpy as np

from shapewright.building import Build, Executor, Workers
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Notice, Stages
from shapewright.settings import Settings

PROBES = 8
"""First samples of every run, which are built anew: they tell the cost of a shape, and whether kept ones hold."""
_SOON, _PATIENCE = 2.0, 3.0
"""Seconds after which something is told although few shapes are there yet, or none. With what is loaded before, the
word of a shape that takes 1 s comes within 5 s of the command."""
_ENOUGH = 3
"""Shapes that tell the cost of others. The first of each process may have something to load."""
_SLOW = 30.0
"""Seconds of building samples from which on their cost is told."""
_FEW = 500
"""Samples that do for many procedures of CAD: build123d's bracket was found in 12 of 12 references by so many."""


class Opening:
    """The first samples, which workers build while the caller goes on; a context manager that ends the workers.

    Attributes:
        crew: the workers. Nobody else may use them before ``builds`` returns.
    """

    def __init__(
        self,
        procedure: Procedure,
        settings: Settings,
        listener: Listener | None = None,
        resumed: bool = False,
        executor: Executor | None = None,
    ) -> None:
        """listener: is called from another thread. resumed: an earlier run is carried on, see ``asked_of``.

        executor: builds on other machines, for whoever uses the workers later as well.
        """
        self.crew = Workers.of(procedure, settings, executor)
        self._stages, self._settings = Stages(listener), settings
        self._count = asked_of(settings, resumed)
        self._stop, self._known = threading.Event(), threading.Event()
        self._thread = ThreadPoolExecutor(1)
        self._future = self._thread.submit(self._build)

    def wait(self) -> None:
        """Until it is known what a shape costs, or told that none is there: a few seconds at most."""
        self._known.wait()

    def builds(self) -> list[Build]:
        """They, when they are there. Raises ProcedureError where the procedure is broken."""
        return self._future.result()

    @property
    def notices(self) -> Sequence[Notice]:
        """What was told."""
        return self._stages.notices

    def __enter__(self) -> Opening:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._stop.set()
        self._thread.shutdown()
        self.crew.close()

    def _build(self) -> list[Build]:
        try:
            return self._built()
        finally:
            self._known.set()

    def _built(self) -> list[Build]:
        vectors = self.crew.procedure.space.sample(self._count, seed=self._settings.seed)
        self._stages.begin("sample", len(vectors))
        watch = cost_watch(self.crew, len(vectors), self._settings, self._stages.tell)

        def step(done: int, _: int) -> None:
            if self._stop.is_set():
                raise InterruptedError("nobody waits for these shapes any more")
            self._stages.step(done, len(vectors))
            if watch():
                self._known.set()

        return self.crew.build(vectors[:PROBES], step, give_up=True)


def asked_of(settings: Settings, resumed: bool) -> int:
    """How many samples a fit asks for; fewer where it trains the network of an earlier run further."""
    return min(settings.samples, settings.warm_samples) if resumed else settings.samples


def cost_watch(crew: Workers, samples: int, settings: Settings, tell: Callable[[Notice], object]) -> Callable[[], bool]:
    """What is to be called while the first shapes are built. It tells what one costs, where all samples take long.

    Before the first is there it tells that as well. It returns whether it knows the cost, or has told something.
    """
    begun, told, before = time.perf_counter(), "", len(crew.costs)

    def watch() -> bool:
        nonlocal told
        costs, spent = crew.costs[before:], time.perf_counter() - begun
        if told != "cost" and (len(costs) >= _ENOUGH or (costs and spent > _SOON)):
            told, seconds = "cost", float(np.median(costs))
            if settings.within is None and seconds * samples / crew.count > _SLOW:
                tell(_cost(seconds, samples, crew.count))
        elif not told and spent > _PATIENCE:
            told = "wait"
            tell(_wait(spent, samples, crew.count))
        return bool(told)

    return watch


def _wait(seconds: float, samples: int, cores: int) -> Notice:
    text = f"no shape is built after {lasting(seconds)}: if each takes as long, {samples:,} samples take "
    return Notice("waiting", f"{text}{lasting(seconds * samples / cores)} on {_cores(cores)}")


def _cost(seconds: float, samples: int, cores: int) -> Notice:
    text = f"one shape takes {lasting(seconds)}: {samples:,} samples take "
    text += f"about {lasting(seconds * samples / cores)} on {_cores(cores)}"
    if samples > _FEW:
        text += f"; {_FEW} take {lasting(seconds * _FEW / cores)}"
    return Notice("pace", text)


def _cores(count: int) -> str:
    return "1 core" if count == 1 else f"{count} cores"


def lasting(seconds: float) -> str:
    """A time in words, to two digits: 0.25 s, 40 s, 8 min, 1.6 h."""
    if seconds < 90.0:
        return f"{float(f'{seconds:.2g}'):g} s"
    return f"{float(f'{seconds / 60:.2g}'):g} min" if seconds < 5400.0 else f"{float(f'{seconds / 3600:.2g}'):g} h"
