"""On the machine that an executor found: chunks of work are done here, and shapes built by safe workers."""

from __future__ import annotations

import os
import pickle
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, Protocol, TypeVar, cast

from shapewright.building.builders import Builders
from shapewright.building.opened import Opened
from shapewright.building.outcomes import Build
from shapewright.building.sent import Sent
from shapewright.parameters import Parameters
from shapewright.procedures import ProcedureError
from shapewright.processes import Limits

Chunk = TypeVar("Chunk")
Item = TypeVar("Item")
Result = TypeVar("Result")
Result_co = TypeVar("Result_co", covariant=True)


class Crew(Protocol):
    """Whatever builds shapes of one procedure: ``Workers``, or a ``Site``."""

    def build(self, parameters: Sequence[Parameters], /) -> list[Build]: ...


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


@dataclass(frozen=True)
class Done(Generic[Result_co]):
    """A chunk of work.

    result: of its task.
    costs, opened: of the shapes that were built for it, see ``Workers``.
    """

    result: Result_co
    costs: tuple[float, ...]
    opened: tuple[Opened, ...]


class Site:
    """A crew of one process of this machine, for one chunk of work; it is started when the first shape is built.

    fresh: in a process that has built nothing before.
    """

    def __init__(self, order: Order, fresh: bool = False) -> None:
        self._order, self._fresh = order, fresh
        self._builders: Builders | None = None
        self.costs: list[float] = []
        self.opened: dict[Opened, None] = {}

    def build(self, parameters: Sequence[Parameters], /) -> list[Build]:
        """Build every vector. A failure costs its own shape only."""
        if self._builders is None:
            order = self._order
            self._builders = Builders(order.sent, 1, order.limits, order.shown) if self._fresh else _idle.taken(order)
        builds: list[Build | None] = [None] * len(parameters)
        self._builders.run(parameters, [range(len(parameters))] if parameters else [], builds.__setitem__)
        made = cast(list[Build], builds)
        self.costs += [build.seconds for build in made if build.seconds]
        self.opened |= dict.fromkeys(file for build in made for file in build.opened)
        return made

    def end(self, broken: bool) -> None:
        """Keep the process for the next chunk, or end it."""
        if self._builders is None:
            return
        if broken or self._fresh:
            self._builders.close()
        else:
            _idle.put(self._order, self._builders)


def worked(
    order: Order, task: Callable[[Site, Chunk], Result], chunk: Chunk, fresh: bool = False
) -> Done[Result] | ProcedureError:
    """A task, done here. An error of the author's is an answer: an executor would take it for one of the machine."""
    try:
        site = Site(replace(order, sent=order.sent.arrived()), fresh)
        try:
            result = task(site, chunk)
        except BaseException:
            site.end(broken=True)
            raise
    except ProcedureError as error:
        return error
    site.end(broken=False)
    return Done(result, tuple(site.costs), tuple(site.opened))


def unpacked(order: Order, work: bytes, fresh: bool) -> Done[Any] | ProcedureError:
    """The same of a task and a chunk that were pickled, as any executor can send them."""
    task, chunk = pickle.loads(work)
    return worked(order, task, chunk, fresh)


def finished(site: Site, chunk: list[Parameters], finish: Callable[[Build], Result]) -> list[Result]:
    """A task: what ``finish`` makes of each vector's build."""
    return [finish(build) for build in site.build(chunk)]


def mapped(site: Site, chunk: list[Item], function: Callable[[Item], Result]) -> list[Result]:
    """A task: what a function makes of each item."""
    return [function(item) for item in chunk]


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
