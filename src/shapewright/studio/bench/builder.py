"""The program of the studio's builder process: one version of the procedure, and one shape after another of it.

Only this process runs the author's code. It says which parameters matter as well as what they build, because a ``when``
is the author's code too, and it stops code that takes too long at the author's line; what does not stop (a loop in a
library written in C) is killed by the parent.
"""

from __future__ import annotations

import pickle
import signal
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, TypeVar

from shapewright.building.clock import TimeLimit, time_limit
from shapewright.building.outcomes import Build, Failure
from shapewright.building.worker import build
from shapewright.parameters import Parameters, to_record
from shapewright.procedures import Procedure, ProcedureError, describe, load_procedure, place_of
from shapewright.processes.limits import Limits, limit_memory
from shapewright.shapes import Mesh
from shapewright.studio.bench.planning.plan import Plan, planned
from shapewright.studio.bench.workshop import LOADING_SECONDS, Built, Version
from shapewright.studio.wire.child import own_streams, read_frame, write_frame
from shapewright.studio.wire.collection import Parameter

Some = TypeVar("Some")
MOST_TRIANGLES = 400_000
"""More than a page can turn smoothly."""


def try_build(
    procedure: Procedure,
    values: Parameters,
    limits: Limits,
    compiling: Callable[[], object] = lambda: None,
    beyond: Sequence[str] = (),
) -> Built:
    """Build the shape at these values, carried over into the procedure's space.

    compiling: see ``time_limit``. beyond: see ``ParameterSpace.carry``.
    """
    try:
        with time_limit(limits.seconds, compiling):
            parameters = procedure.space.carry(values, beyond=beyond)
            made = build(procedure, parameters, limits)
            if isinstance(made.shape, Mesh) and len(made.shape.faces) > MOST_TRIANGLES:
                much = f"{len(made.shape.faces)} triangles are more than the studio shows ({MOST_TRIANGLES})"
                return Built(Build(parameters, None, Failure("no shape", much), made.seconds))
            return Built(made, procedure.space.active(parameters), procedure.space.at_limit(parameters))
    except TimeLimit as error:
        return Built(Build(dict(values), None, Failure("time", describe(error), place_of(error, procedure.path))))
    except ValueError as error:  # a `when` failed
        return Built(Build(dict(values), None, Failure("raised", str(error), procedure.place)))


def serve(requests: BinaryIO, answers: BinaryIO) -> None:
    """Load the procedure that the first request names and build the shape of every later one, until there are no more.

    Requests "sample" and "plan" ask for parameters of many shapes. Requests and answers are pickled payloads; a message
    "working" asks the other side for patience.
    """

    def answer(value: Version | Built | Failure | Plan | list[Parameters]) -> None:
        write_frame(answers, "answer", pickle.dumps(value))

    def working() -> None:
        write_frame(answers, "working")

    working()
    first = _received(requests)
    if first is None:
        return
    target, sys.path[:], limits = first[1]
    try:
        with time_limit(LOADING_SECONDS):
            procedure = load_procedure(target)
            version = _version(procedure)
    except TimeLimit as error:
        answer(Failure("time", describe(error), place_of(error, Path(target))))
        return
    except ProcedureError as error:
        answer(Failure("raised", error.message, error.place))
        return
    limit_memory(limits.memory_mb)
    limits = replace(limits, seconds=procedure.seconds or limits.seconds)
    answer(version)
    while (received := _received(requests)) is not None:
        kind, asked = received
        if kind == "sample":
            answer(_listed(procedure, partial(procedure.space.sample, *asked)))
        elif kind == "plan":
            answer(_listed(procedure, partial(planned, procedure.space, asked)))
        else:
            values, beyond = asked
            answer(try_build(procedure, values, limits, working, beyond))


def _received(requests: BinaryIO) -> tuple[str, Any] | None:
    frame = read_frame(requests)
    return (frame[0], pickle.loads(frame[1])) if frame else None


def _listed(procedure: Procedure, work: Callable[[], Some]) -> Some | Failure:
    """What lists parameters of shapes, or why there are none."""
    try:
        with time_limit(LOADING_SECONDS):
            return work()
    except TimeLimit as error:
        return Failure("time", describe(error), place_of(error, procedure.path))
    except ValueError as error:  # a `when` failed
        return Failure("raised", str(error), procedure.place)


def _version(procedure: Procedure) -> Version:
    said = procedure.signature.meanings
    parameters = [
        Parameter(**to_record(p), meaning=said.get(p.name, ""), conditional=p.when is not None) for p in procedure.space
    ]
    return Version(procedure.name, parameters, procedure.space.defaults, procedure.facts, procedure.seconds)


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    serve(*own_streams())
