"""The seam to other machines: whatever has ``submit(function, *args)`` builds chunks of shapes where it likes.

What crosses is a procedure as ``Sent``, rows of parameters, and what is made of the shapes, in chunks. On each machine
the safe workers of this room build. Where a chunk is built, and with which others, changes nothing in its result.
"""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Callable, Generator, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Protocol, TypeVar, cast

from shapewright.building.builders import Builders, Took
from shapewright.building.outcomes import Build
from shapewright.building.sent import Sent
from shapewright.parameters import Parameters
from shapewright.procedures import ProcedureError
from shapewright.processes import Limits

_AHEAD = 256
"""Chunks that are submitted before the first of them is taken, at most: so many machines work, and so much lies in
memory where they are faster than who takes."""
Finished = TypeVar("Finished")


class Pending(Protocol):
    """A result that will be there."""

    def result(self) -> Any: ...
    def cancel(self) -> Any: ...


class Executor(Protocol):
    """``concurrent.futures``' executors, ``client.get_executor()`` of dask, loky's, submitit's."""

    def submit(self, function: Callable[..., Any], /, *args: Any) -> Pending: ...


class ExecutorError(RuntimeError):
    """An executor has lost the same chunk twice, or takes no more; the message says why."""


@dataclass(frozen=True)
class Order:
    """What is to be built.

    sent: the procedure.
    limits: of each shape.
    shown: see ``Builders``.
    """

    sent: Sent
    limits: Limits
    shown: bool


class Elsewhere:
    """Builders behind an executor. It has the verbs of ``Builders``, and ``stream``."""

    def __init__(self, executor: Executor, sent: Sent, limits: Limits, shown: bool = False) -> None:
        self._executor = executor
        self._order = Order(sent, limits, shown)

    def close(self) -> None:
        """The executor is its owner's: nothing ends here."""

    def load(self, sent: Sent) -> None:
        """Build shapes of another procedure from now on; where it does not load there, the next shapes say so."""
        self._order = replace(self._order, sent=sent)

    def run(
        self,
        parameters: Sequence[Parameters],
        slices: Sequence[range],
        took: Took,
        tick: Callable[[], object] = lambda: None,
    ) -> None:
        """Build the rows of all slices."""
        with closing(self.stream([[parameters[i] for i in piece] for piece in slices], _as_it_is)) as builds:
            for piece in slices:
                for i in piece:
                    took(i, next(builds))
                tick()

    def elsewhere(self, builds: Sequence[Build]) -> list[Build]:
        """The same shapes built again, in new processes."""
        return list(self.stream([[build.parameters for build in builds]], _as_it_is, fresh=True))

    def stream(
        self, chunks: Sequence[Sequence[Parameters]], finish: Callable[[Build], Finished], fresh: bool = False
    ) -> Generator[Finished, None, None]:
        """What ``finish`` makes of each build there, in order.

        A chunk that was lost with its machine is submitted once more. Raises ExecutorError when it is lost again,
        ProcedureError when the procedure is not the same there, or does not load.
        """
        waiting: deque[tuple[Callable[[], Pending], Pending]] = deque()
        try:
            for chunk in chunks:
                submit = partial(self._submitted, list(chunk), finish, fresh)
                waiting.append((submit, submit()))
                if len(waiting) == _AHEAD:
                    yield from _answer(*waiting.popleft())
            while waiting:
                yield from _answer(*waiting.popleft())
        finally:
            for _, pending in waiting:
                with suppress(Exception):  # of an engine that is gone
                    pending.cancel()

    def _submitted(self, chunk: list[Parameters], finish: Callable[[Build], Any], fresh: bool) -> Pending:
        try:
            return self._executor.submit(built, self._order, chunk, finish, fresh)
        except Exception as error:
            raise ExecutorError(f"the executor takes no more work: {_told(error)}") from error


def _answer(submit: Callable[[], Pending], pending: Pending) -> Any:
    """The results of a chunk, which is submitted once more where its machine was lost."""
    answer = _awaited(pending)
    if isinstance(answer, _Lost):
        again = _awaited(submit())
        if isinstance(again, _Lost):
            raise ExecutorError(f"the executor lost a chunk of shapes twice: {answer.reason}, then {again.reason}")
        answer = again
    if isinstance(answer, ProcedureError):
        raise answer
    return answer


@dataclass(frozen=True)
class _Lost:
    """A chunk that was lost with its machine."""

    reason: str


def _awaited(pending: Pending) -> Any:
    try:
        return pending.result()
    except (KeyboardInterrupt, SystemExit):
        raise
    except BaseException as error:  # noqa: BLE001 - that of a cancelled future is no Exception
        return _Lost(_told(error))


def _told(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}".rstrip(": ")


def built(
    order: Order, chunk: list[Parameters], finish: Callable[[Build], Finished], fresh: bool = False
) -> list[Finished] | ProcedureError:
    """On the machine that builds: what ``finish`` makes of each vector's build.

    fresh: in a process that has built nothing before. An error of the author's is an answer, so that the executor does
    not take it for one of the machine.
    """
    try:
        order = replace(order, sent=order.sent.arrived())
        builders = Builders(order.sent, 1, order.limits, order.shown) if fresh else _idle.taken(order)
        builds: list[Build | None] = [None] * len(chunk)
        try:
            builders.run(chunk, [range(len(chunk))], builds.__setitem__)
        except BaseException:
            builders.close()
            raise
    except ProcedureError as error:
        return error
    if fresh:
        builders.close()
    else:
        _idle.put(order, builders)
    return [finish(build) for build in cast(list[Build], builds)]


class _Idle:
    """Builders that this process keeps for its next chunks: to start one takes as long as to build a hundred shapes.

    They are kept by the process that started them: one that is forked from it starts its own.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._kept: dict[int, list[tuple[Order, Builders]]] = {}

    def taken(self, order: Order) -> Builders:
        """Builders for an order, which nobody else has. Raises ProcedureError when the procedure does not load."""
        with self._lock:
            kept = self._kept.setdefault(os.getpid(), [])
            same = next((i for i, (known, _) in enumerate(kept) if known == order), None)
            if same is not None:
                return kept.pop(same)[1]
            alike = [
                i for i, (known, _) in enumerate(kept) if (known.limits, known.shown) == (order.limits, order.shown)
            ]
            other = kept.pop(alike[-1])[1] if alike else None
        if other is None:
            return Builders(order.sent, 1, order.limits, order.shown)
        other.load(order.sent)
        return other

    def put(self, order: Order, builders: Builders) -> None:
        """Keep them, in place of any that have other limits."""
        with self._lock:
            kept = self._kept.setdefault(os.getpid(), [])
            stale = [each for each in kept if (each[0].limits, each[0].shown) != (order.limits, order.shown)]
            for each in stale:
                kept.remove(each)
                each[1].close()
            kept.append((order, builders))


_idle = _Idle()


def _as_it_is(build: Build) -> Build:
    return build
