"""The builder process of the newest version of the procedure, started again when a shape takes it down."""

from __future__ import annotations

import pickle
import queue
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from shapewright.building.outcomes import Build, Failure
from shapewright.building.process import no_answer
from shapewright.parameters import Parameters, Value
from shapewright.procedures import Facts, ProcedureError
from shapewright.processes.limits import Limits, crash, too_long
from shapewright.processes.worker import SINGLE_THREADED
from shapewright.studio.bench.planning.plan import Plan
from shapewright.studio.wire.child import Child, Frame
from shapewright.studio.wire.collection import Parameter
from shapewright.studio.wire.printed import Printed
from shapewright.studio.wire.problems import Problem, of_error, syntax_problem
from shapewright.studio.wire.requests import Explore
from shapewright.studio.wire.values import Slug

LOADING_SECONDS = 20.0
"""What reading the author's file may take, its imports included."""
_PROGRAM = "shapewright.studio.bench.builder"
_START_SECONDS = 60.0
"""Until the process runs, on a machine with much else to do."""
_PATIENCE = LOADING_SECONDS + 5.0
_STEP = 0.1


@dataclass(frozen=True)
class Version:
    """A procedure that was read."""

    name: str
    parameters: list[Parameter]  # as the page gets them
    defaults: Parameters
    facts: Facts
    seconds: float | None = None  # that a shape may take, where the procedure's file says so


@dataclass(frozen=True)
class Built:
    """A shape that was built, or could not be."""

    build: Build
    active: tuple[str, ...] = ()  # names of the parameters that matter there
    at_limit: tuple[str, ...] = ()  # names of those at an end of their Range


class Broken(Exception):
    """The procedure's file cannot be used; ``problem`` says why."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem.message)
        self.problem = problem


class Workshop:
    """Builds shapes of one procedure.

    interrupt: set by another thread, it ends a build that is under way.
    on_printed: called with what the procedure has printed, and the reference whose replica was built.
    """

    def __init__(self) -> None:
        self.interrupt = threading.Event()
        self.on_printed: Callable[[Slug | None, str], object] = lambda slug, text: None
        self._printed: Printed | None = None
        self._child: Child | None = None
        self._answers: queue.SimpleQueue[Frame | None] = queue.SimpleQueue()
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
        self._path = path
        return version

    def build(self, values: Mapping[str, Value], beyond: Sequence[str] = (), slug: Slug | None = None) -> Built | None:
        """Build one shape; None when that was interrupted. Raises Broken when the file has become unusable.

        beyond: names of numbers that may lie outside their Ranges. slug: the reference that it is a replica of.
        """
        self._ask("build", (dict(values), tuple(beyond)))
        patience = 1.25 * self._limits.seconds + 0.5
        answer = self._wait(patience, patience) or Failure.of(too_long(self._limits))
        self._pass_on(slug)
        if isinstance(answer, Built):
            return answer
        self._stop()
        return None if self.interrupt.is_set() else Built(Build(dict(values), None, answer))

    def sample(self, count: int, seed: int) -> list[Parameters]:
        """Parameters of random shapes; none when that was interrupted or failed. Raises Broken as ``build`` does."""
        self._ask("sample", (count, seed))
        answer = self._wait(_PATIENCE, _PATIENCE)
        if isinstance(answer, list):
            return answer
        self._stop()
        return []

    def plan(self, order: Explore) -> Plan | Failure | None:
        """The parameters of the shapes that an author wants to see, or why there are none; None when that was
        interrupted. Raises Broken as ``build`` does."""
        self._ask("plan", order)
        answer = self._wait(_PATIENCE, _PATIENCE) or no_answer(_PATIENCE)
        if not isinstance(answer, Plan):
            self._stop()
        return None if self.interrupt.is_set() else answer

    def _ask(self, kind: str, value: object) -> None:
        """Send a request to the builder, which is started where it is not there."""
        assert self._path is not None
        if self._child is None:
            try:
                self._start(self._path, self._limits)
            except ProcedureError as error:
                raise Broken(of_error(error, "load", self._path.parent)) from error
        assert self._child is not None
        self._child.send(kind, pickle.dumps(value))

    def close(self) -> None:
        """Give the procedure up."""
        self._stop()
        self._path = None

    def _start(self, path: Path, limits: Limits) -> Version:
        self._limits = limits
        self._answers = queue.SimpleQueue()
        self._printed = Printed()
        apart: dict[str, Any] = {"own_group": False, "environment": SINGLE_THREADED, "printed": self._printed}
        self._child = Child(_PROGRAM, self._answers.put, **apart)
        self._child.send("load", pickle.dumps((str(path), list(sys.path), limits)))
        version: Version | Failure = self._wait(_START_SECONDS, _PATIENCE) or no_answer(_PATIENCE)
        self._pass_on(None)
        if isinstance(version, Failure):
            self._stop()
            raise version.error()
        self._limits = replace(limits, seconds=version.seconds or limits.seconds)
        return version

    def _wait(self, patience: float, again: float) -> Any:
        """The builder's next answer, or how it ended; None when it takes too long, or when interrupted.

        patience: seconds to wait for the first sign of life. again: seconds after every other one.
        """
        assert self._child is not None
        while patience > 0.0 and not self.interrupt.is_set():
            try:
                frame = self._answers.get(timeout=min(_STEP, patience))
            except queue.Empty:
                patience -= _STEP
                if self._printed:
                    self._printed.bound()
                continue
            if frame is None:
                return Failure.of(crash(self._child.process))
            if frame[0] == "answer":
                return pickle.loads(frame[1])
            patience = again
        return None

    def _pass_on(self, slug: Slug | None) -> None:
        """Tell what was printed; the terminal says it, too."""
        text = self._printed.take() if self._printed else ""
        if text:
            sys.stderr.write(text)
            self.on_printed(slug, text)

    def _stop(self) -> None:
        if self._child:
            self._child.end()
            self._pass_on(None)
        if self._printed:
            self._printed.close()
        self._child = self._printed = None
