"""The builder process of the newest version of the procedure, started again when a shape takes it down."""

from __future__ import annotations

import sys
import threading
from collections.abc import Mapping
from pathlib import Path

import cloudpickle

from shapewright.building.outcomes import Build, Failure, Limits
from shapewright.building.process import WorkerProcess
from shapewright.parameters import Value
from shapewright.procedures import ProcedureError
from shapewright.studio.bench.builder import LOADING_SECONDS
from shapewright.studio.bench.built import Built, Version
from shapewright.studio.wire.problems import Problem, of_error, syntax_problem

_PROGRAM = "shapewright.studio.bench.builder"
_PATIENCE = LOADING_SECONDS + 5.0


class Broken(Exception):
    """The procedure's file cannot be used; ``problem`` says why."""

    def __init__(self, found: Problem) -> None:
        super().__init__(found.message)
        self.problem = found


class Workshop:
    """Builds shapes of one procedure. interrupt: set by another thread, it ends a build that is under way."""

    def __init__(self) -> None:
        self.interrupt = threading.Event()
        self._worker: WorkerProcess | None = None
        self._path: Path | None = None
        self._limits = Limits()

    @property
    def open(self) -> bool:
        """Whether there is a procedure to build."""
        return self._path is not None

    def load(self, path: Path, limits: Limits) -> Version:
        """Take a version of the procedure up. Raises Broken; there is nothing to build then."""
        self.close()
        wrong = syntax_problem(path, path.parent)
        if wrong:
            raise Broken(wrong)
        try:
            version = self._start(path, limits)
        except ProcedureError as error:
            raise Broken(of_error(error, "time" if error.kind == "time" else "load", path.parent)) from error
        self._path, self._limits = path, limits
        return version

    def build(self, values: Mapping[str, Value]) -> Built | None:
        """Build one shape; None when that was interrupted. Raises Broken when the file has become unusable."""
        assert self._path is not None
        if self._worker is None:
            try:
                self._start(self._path, self._limits)
            except ProcedureError as error:
                raise Broken(of_error(error, "load", self._path.parent)) from error
        assert self._worker is not None
        answer: Built | Failure = self._worker.exchange(dict(values), self.interrupt)
        if isinstance(answer, Built):
            return answer
        self._stop()
        return None if self.interrupt.is_set() else Built(Build(dict(values), None, answer))

    def close(self) -> None:
        """Give the procedure up."""
        self._stop()
        self._path = None

    def _start(self, path: Path, limits: Limits) -> Version:
        payload = bytes(cloudpickle.dumps((str(path), list(sys.path))))
        self._worker = WorkerProcess(payload, limits, _PROGRAM, _PATIENCE, self.interrupt)
        version: Version = self._worker.ready
        return version

    def _stop(self) -> None:
        if self._worker:
            self._worker.stop()
        self._worker = None
