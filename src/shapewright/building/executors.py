"""The seam to other machines: whatever has ``submit(function, *args)`` does chunks of work where it likes.

What crosses is a procedure as ``Sent``, rows of parameters or references, a function, and what it makes of them, in
chunks. On each machine the safe workers of this room build, see ``sites``. Where a chunk is done, and with which
others, changes nothing in its result.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Generator, Iterable, Sequence
from contextlib import AbstractContextManager, closing, nullcontext, suppress
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice
from typing import Any, Protocol, TypeVar

import cloudpickle

from shapewright.building.builders import Took
from shapewright.building.outcomes import Build
from shapewright.building.sent import Sent
from shapewright.building.sites import Done, Order, Site, finished, unpacked, worked
from shapewright.parameters import Parameters
from shapewright.procedures import ProcedureError
from shapewright.processes import Limits

_AHEAD = 256
"""Chunks that are submitted before the first of them is taken, at most: so many machines work, and so much lies in
memory where they are faster than who takes."""
_FEW = 8
"""Items that are not worth the way through a queue of jobs: they are done here, as the first shapes of a run are."""
_ADVICE = "see that the cluster runs, and that its machines have memory enough, then repeat the command"
Finished = TypeVar("Finished")
Result = TypeVar("Result")


class Pending(Protocol):
    """A result that will be there."""

    def result(self) -> Any: ...
    def cancel(self) -> Any: ...


class Executor(Protocol):
    """``concurrent.futures``' executors, ``client.get_executor()`` of dask, loky's, submitit's.

    One with a context manager ``batch``, as submitit's, hands what is submitted in its block to a queue at once.
    """

    def submit(self, function: Callable[..., Any], /, *args: Any) -> Pending: ...


class ExecutorError(RuntimeError):
    """An executor has lost the same chunk twice, or takes no more; the message says why."""


@dataclass(frozen=True)
class Cluster:
    """An executor of which it is known how many shapes it builds at the same time.

    executor: of the cluster.
    count: shapes at the same time, as far as is known now.
    """

    executor: Executor
    count: int

    def submit(self, function: Callable[..., Any], /, *args: Any) -> Pending:
        return self.executor.submit(function, *args)


class Elsewhere:
    """Builders behind an executor. It has the verbs of ``Builders``, and those for other work."""

    def __init__(self, executor: Executor, sent: Sent, limits: Limits, shown: bool = False) -> None:
        self._executor = executor.executor if isinstance(executor, Cluster) else executor
        self._ahead = min(_AHEAD, executor.count) if isinstance(executor, Cluster) and self.is_queue else _AHEAD
        self._order = Order(sent, limits, shown)

    @property
    def is_queue(self) -> bool:
        """Whether each chunk waits for its turn as a job of its own, so that it has to be worth that."""
        return hasattr(self._executor, "batch")

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
        chunks = [[parameters[i] for i in piece] for piece in slices]
        with closing(self.answers(partial(finished, finish=_as_it_is), chunks)) as answers:
            for piece, done in zip(slices, answers, strict=True):
                for i, build in zip(piece, done.result, strict=True):
                    took(i, build)
                tick()

    def elsewhere(self, builds: Sequence[Build]) -> list[Build]:
        """The same shapes built again, in new processes."""
        return list(self.stream([[build.parameters for build in builds]], _as_it_is, fresh=True))

    def stream(
        self, chunks: Sequence[Sequence[Parameters]], finish: Callable[[Build], Finished], fresh: bool = False
    ) -> Generator[Finished, None, None]:
        """What ``finish`` makes of each build there, in order. Raises as ``answers`` does."""
        with closing(self.answers(partial(finished, finish=finish), chunks, fresh)) as answers:
            for done in answers:
                yield from done.result

    def answers(
        self, task: Callable[[Site, Any], Result], chunks: Iterable[Sequence[Any]], fresh: bool = False
    ) -> Generator[Done[Result], None, None]:
        """What the task makes of each chunk there, in order.

        A chunk that was lost with its machine is submitted once more. Raises ExecutorError when it is lost again,
        ProcedureError when the procedure is not the same there, or does not load.
        """
        chunks = iter(chunks)
        if self.is_queue:
            first = list(islice(chunks, _FEW + 1))
            if sum(map(len, first)) <= _FEW:
                for chunk in first:
                    yield _told_apart(worked(self._order, task, chunk, fresh))
                return
            chunks = iter([*first, *chunks])
        waiting: deque[tuple[Callable[[], Pending], Pending]] = deque()
        try:
            while True:
                if len(waiting) <= self._ahead // 2:
                    some = islice(chunks, self._ahead - len(waiting))
                    waiting += self._submitted([partial(self._submit, task, chunk, fresh) for chunk in some])
                if not waiting:
                    return
                yield _answer(*waiting.popleft())
        except ExecutorError:
            waiting.clear()  # an engine that is gone answers to each of them late, or never
            raise
        finally:
            for _, pending in waiting:
                with suppress(Exception):  # of an engine that is gone
                    pending.cancel()

    def _submitted(self, submits: Sequence[Callable[[], Pending]]) -> list[tuple[Callable[[], Pending], Pending]]:
        """All of them, in one batch where the executor knows batches."""
        if not submits:
            return []
        batch: AbstractContextManager[Any] = getattr(self._executor, "batch", nullcontext)()
        with batch:
            return [(submit, submit()) for submit in submits]

    def _submit(self, task: Callable[[Site, Any], Any], chunk: Sequence[Any], fresh: bool) -> Pending:
        try:
            work = cloudpickle.dumps((task, chunk))  # conditions of parameters are functions of the author's file
        except Exception as error:
            raise ExecutorError(f"this work cannot be sent to other machines: {_told(error)}") from error
        try:
            return self._executor.submit(unpacked, self._order, work, fresh)
        except Exception as error:
            raise ExecutorError(f"the executor takes no more work: {_told(error)}; {_ADVICE}") from error


def _answer(submit: Callable[[], Pending], pending: Pending) -> Any:
    """The results of a chunk, which is submitted once more where its machine was lost."""
    answer = _awaited(pending)
    if isinstance(answer, _Lost):
        again = _awaited(submit())
        if isinstance(again, _Lost):
            why = f"{answer.reason}, then {again.reason}"
            raise ExecutorError(f"the executor lost a chunk of shapes twice: {why}; {_ADVICE}")
        answer = again
    return _told_apart(answer)


def _told_apart(answer: Done[Result] | ProcedureError) -> Done[Result]:
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


def _as_it_is(build: Build) -> Build:
    return build
