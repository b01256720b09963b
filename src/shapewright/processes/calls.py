"""Functions of this package, called in worker processes that they may take down with them.

The program of such a process calls what its parent names, one call after another.
"""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Sequence
from multiprocessing.connection import Connection
from typing import Any, Generic, TypeVar

from shapewright.processes.limits import Limits, Loss, limit_memory, too_long, too_much
from shapewright.processes.pool import Pool
from shapewright.processes.program import attend
from shapewright.processes.worker import Worker
from shapewright.threads import cores

_PROGRAM = "shapewright.processes.calls"
_TO_END = 1.0
"""Seconds that a late call may still need for its answer."""
Argument = TypeVar("Argument")
Result = TypeVar("Result")


class Calls(Generic[Argument, Result]):
    """Calls of one function in worker processes; a context manager. The results do not depend on their number.

    function: of this package, by whose name the processes find it. It raises nothing but MemoryError.
    count: processes at most; one a core by default.
    """

    def __init__(self, function: Callable[[Argument], Result], count: int | None = None) -> None:
        self._function = function
        self._pool = Pool(_Caller, count or cores())

    def __enter__(self) -> Calls[Argument, Result]:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End the processes; further calls start others."""
        self._pool.close()

    def results(self, calls: Sequence[tuple[Argument, Limits]], most: int | None = None) -> list[Result | Loss]:
        """What the function returns for each argument, or how the call was lost; in order. most: processes at most.

        A call that ends a process in which others were answered before is made once more, in a new process: so none is
        lost by what others left behind.
        """
        tasks: queue.SimpleQueue[int] = queue.SimpleQueue()
        for number in range(len(calls)):
            tasks.put(number)
        results: dict[int, Result | Loss] = {}

        def serve(caller: _Caller, number: int, stop: threading.Event) -> _Caller | None:
            argument, limits = calls[number]
            used = caller.answers > 0
            answer = caller.call(self._function, argument, limits, stop)
            if isinstance(answer, Loss) and answer.kind != "time" and used:
                tasks.put(number)
            else:
                results[number] = answer
            if isinstance(answer, Loss):
                caller.stop()
                return None
            return caller

        self._pool.run(tasks, serve, most=most)
        return [results[number] for number in range(len(calls))]


class _Caller:
    """A worker that calls functions, and how many it has answered."""

    def __init__(self) -> None:
        self._worker = Worker(_PROGRAM)
        self.answers = 0

    def call(self, function: Callable[[Any], Any], argument: Any, limits: Limits, stop: threading.Event) -> Any:
        answer = self._worker.ask((function, argument, limits), limits.seconds + _TO_END, stop)
        self.answers += 1
        return too_long(limits) if answer is None else answer

    def stop(self) -> None:
        self._worker.stop()


def serve(connection: Connection) -> None:
    """Answer calls until the other side closes."""
    while True:
        function, argument, limits = connection.recv()
        limit_memory(limits.memory_mb)
        try:
            connection.send(function(argument))
        except MemoryError:
            connection.send(too_much(limits))


if __name__ == "__main__":
    attend(serve)
