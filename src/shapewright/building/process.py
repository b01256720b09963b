"""One worker process that builds shapes, seen from its parent."""

from __future__ import annotations

import linecache
import threading
from dataclasses import replace
from typing import Any

from shapewright.building.outcomes import Build, Failure
from shapewright.building.prints import kept_file, left_in
from shapewright.parameters import Parameters
from shapewright.processes.limits import Limits, Loss, too_long
from shapewright.processes.worker import START_SECONDS, Worker

_PROGRAM = "shapewright.building.worker"


class WorkerProcess:
    """One worker process and the connection to it.

    payload: the procedure, pickled. Raises ProcedureError when it cannot be loaded.
    shown: what the author's code prints goes to standard error; by default it is kept, for failures.
    """

    def __init__(self, payload: bytes, limits: Limits, shown: bool = False) -> None:
        self.limits = limits
        self._printed = None if shown else kept_file()
        self._worker = Worker(_PROGRAM, self._printed)
        self._load((payload, limits, not shown), START_SECONDS, no_answer(START_SECONDS))

    @property
    def number(self) -> int:
        """Of the process."""
        return self._worker.process.pid

    def build(self, parameters: list[Parameters], stop: threading.Event) -> list[Build] | Failure:
        """The builds of the first few vectors (at least one), or the failure that ended the worker.

        A worker answers after a fraction of the time limit at the latest, unless a shape exceeds the limit itself.
        stop: ends the wait; the worker is then lost.
        """
        answer: list[Build] | Loss = self._worker.ask(parameters, self._patience, stop) or too_long(self.limits)
        return self._lost(answer) if isinstance(answer, Loss) else [_with_line(build) for build in answer]

    def load(self, payload: bytes) -> None:
        """Build shapes of another procedure from now on. Raises ProcedureError; the worker is then lost."""
        self._load(payload, self._patience, Failure.of(too_long(self.limits)))

    @property
    def _patience(self) -> float:
        return 1.25 * self.limits.seconds + 0.5

    def _load(self, request: Any, patience: float, late: Failure) -> None:
        answer = self._worker.ask(request, patience) or late
        if isinstance(answer, Loss):
            answer = self._lost(answer)
        if isinstance(answer, Failure):
            self.stop()
            raise answer.error()

    def _lost(self, loss: Loss) -> Failure:
        return Failure.of(loss, left_in(self._printed) if self._printed else "")

    def stop(self) -> None:
        """End the process at once."""
        self._worker.stop()
        if self._printed:
            self._printed.close()


def _with_line(build: Build) -> Build:
    """The text of the line at which a build failed, where only this process has it: that of a notebook's cell."""
    place = build.failure and build.failure.place
    if build.failure is None or not place or place.text or not place.line:
        return build
    text = linecache.getline(place.file, place.line).strip() or None
    return replace(build, failure=replace(build.failure, place=replace(place, text=text)))


def no_answer(seconds: float) -> Failure:
    """Of a procedure's file that did not stop being read."""
    return Failure("time", f"a worker process read the procedure's file and did not answer within {seconds:g} s")
