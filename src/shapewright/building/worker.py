"""The program of a worker process: build the shapes that its parent asks for, one procedure a process."""

from __future__ import annotations

import contextlib
import os
import pickle
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from multiprocessing.connection import Connection
from pathlib import Path

from shapewright.building.clock import TimeLimit, time_limit
from shapewright.building.opened import Readings
from shapewright.building.outcomes import Build, Failure
from shapewright.building.prints import Prints
from shapewright.parameters import Parameters
from shapewright.procedures import Infeasible, Procedure, ProcedureError, describe, load_procedure, place_of
from shapewright.processes import Limits
from shapewright.processes.limits import limit_memory, too_much
from shapewright.processes.program import attend
from shapewright.processes.worker import AT_WORK

_ANSWER_WITHIN = 0.25
"""Share of the time limit after which a worker answers with the shapes it has, so that its parent notices a hang."""
_READY = "ready"
_OWN = tuple(sys.path)
"""Where a new process looks for modules."""
_HOME = Path.cwd()
"""The working folder of a new process."""


def serve(connection: Connection) -> None:
    """Answer requests, vectors to build or a procedure to load, until the other side closes or one does not load."""
    payload: bytes
    limits: Limits
    try:
        with _one_core():
            payload, limits, kept = connection.recv()
            readings = Readings()
            printed = Prints.of_streams() if kept else None
            procedure = _received(payload)
            if printed:
                printed.taken()
        limit_memory(limits.memory_mb)
        connection.send(_READY)
        while True:
            requests: list[Parameters] | bytes = connection.recv()
            if isinstance(requests, bytes):
                procedure = _received(requests)
                connection.send(_READY)
            else:
                connection.send(
                    _build_some(procedure, requests, limits, printed, readings, lambda: connection.send(AT_WORK))
                )
    except ProcedureError as error:  # of a file that does not load: the parent ends this process
        connection.send(Failure("raised", error.message, error.place))


def _received(payload: bytes) -> Procedure:
    """The procedure. Raises ProcedureError when its file does not load, or a module that it needs is not found.

    Its modules are looked for where its own process looks for them. Where that fails, this process's own places come
    first: a library may change the search for its second import, as bpy does, so that no other process can import it.
    """
    theirs, working, inner = pickle.loads(payload)
    sys.path[:] = theirs
    os.chdir(working or _HOME)
    try:
        return _read(inner)
    except ProcedureError as error:
        sys.path[:] = [*_OWN, *(place for place in theirs if place not in _OWN)]
        if not isinstance(error.__cause__, ImportError):
            raise
        with contextlib.suppress(ProcedureError):
            return _read(inner)
        raise


def _read(inner: bytes) -> Procedure:
    try:
        target = pickle.loads(inner)
    except Exception as error:
        missing = isinstance(error, ModuleNotFoundError)
        advice = "; put it in a file of its own and load it with load_procedure" if missing else ""
        raise ProcedureError(f"a worker process cannot read it: {describe(error)}{advice}") from error
    return load_procedure(target) if isinstance(target, str) else target


@contextlib.contextmanager
def _one_core() -> Iterator[None]:
    """Libraries that are loaded here start threads for one core only.

    manifold3d's would spin between its booleans, on the cores that the other workers build on.
    """
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {sorted(cores)[os.getpid() % len(cores)]})
    try:
        yield
        if "manifold3d" in sys.modules:
            cube = sys.modules["manifold3d"].Manifold.cube((1.0, 1.0, 1.0))
            (cube + cube.translate((0.5, 0.5, 0.5))).status()  # its threads are started by the first boolean
    finally:
        os.sched_setaffinity(0, cores)


def _build_some(
    procedure: Procedure,
    requests: list[Parameters],
    limits: Limits,
    printed: Prints | None,
    readings: Readings,
    compiling: Callable[[], object],
) -> list[Build]:
    """Build in order until a fraction of the time limit has passed, so that a hang is noticed soon."""
    started = time.perf_counter()
    builds: list[Build] = []
    for parameters in requests:
        try:
            with time_limit(limits.seconds, compiling):
                builds.append(build(procedure, parameters, limits))
        except TimeLimit as error:
            late = Failure("time", describe(error), place_of(error, procedure.path))
            builds.append(Build(parameters, None, late, limits.seconds))
        if printed:
            builds[-1] = _with_printed(builds[-1], printed.taken())
        if opened := readings.taken(procedure.path):
            builds[-1] = replace(builds[-1], opened=opened)
        if time.perf_counter() - started > _ANSWER_WITHIN * limits.seconds:
            break
    return builds


def _with_printed(build: Build, printed: str) -> Build:
    """A failure tells what was printed before; an infeasible shape is none."""
    if build.failure is None or build.failure.kind == "infeasible":
        return build
    return replace(build, failure=replace(build.failure, printed=printed))


def build(procedure: Procedure, parameters: Parameters, limits: Limits) -> Build:
    """Call the procedure in this process; whatever it raises is part of the result."""
    started = time.perf_counter()
    shape, failure = None, None
    try:
        shape = procedure(**parameters)
    except Infeasible as error:
        failure = Failure("infeasible", str(error) or "it is infeasible")
    except ProcedureError as error:
        failure = Failure("no shape" if error.kind == "broken" else error.kind, error.message, error.place)
    except MemoryError:
        failure = Failure.of(too_much(limits))
    except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever the author's code raises is a result
        failure = Failure("raised", describe(error), place_of(error, procedure.path))
    return Build(parameters, shape, failure, time.perf_counter() - started, os.getpid())


if __name__ == "__main__":
    attend(serve)
