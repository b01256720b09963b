"""Building many shapes: in worker processes that a bad procedure cannot take down with it, here or elsewhere."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Sequence
from contextlib import closing
from dataclasses import replace
from functools import partial
from typing import TypeVar, cast

from shapewright.building.builders import Builders
from shapewright.building.executors import Cluster, Elsewhere, Executor
from shapewright.building.opened import Opened
from shapewright.building.outcomes import Build, commonest_place, describe_failures
from shapewright.building.sent import Sent
from shapewright.building.sites import Crew, mapped
from shapewright.parameters import Parameters
from shapewright.procedures import Procedure, ProcedureError
from shapewright.processes import Limits
from shapewright.settings import Settings
from shapewright.threads import cores, in_threads

SLICE = 64
"""Shapes in one request to a worker, at most."""
_JOB = 2_000
"""Shapes in one job of a queue, at most: their files are some 100 MB, which cross at once."""
_PROBES = (3, 8)
"""First shapes that say whether a procedure is broken: all too slow, or all failed."""
Finished = TypeVar("Finished")
Item = TypeVar("Item")
Part = TypeVar("Part")
Result = TypeVar("Result")


class Workers:
    """Worker processes that build shapes of one procedure at a time; a context manager.

    The results are in the order of the request and do not depend on the number of workers, nor on where they are.

    count: how many build at the same time; one a core by default. Those of a ``Cluster`` are its own.
    shown: what the author's code prints goes to standard error; by default its last lines are kept for failures.
    executor: builds on other machines; by default this one builds.

    Attributes:
        home: the folder of the first procedure's file, None where it has none: what it reads lies there.
        costs: seconds of every shape that was built so far, also while others are.
        opened: files of the author's that were read meanwhile.
    """

    def __init__(
        self,
        procedure: Procedure,
        count: int | None = None,
        limits: Limits | None = None,
        shown: bool = False,
        executor: Executor | None = None,
    ) -> None:
        self.procedure = procedure
        self.home = procedure.path.parent if procedure.path else None
        self.executor = executor
        self.count = executor.count if isinstance(executor, Cluster) else count or cores()
        limits = limits or Limits()
        self.limits = replace(limits, seconds=procedure.seconds) if procedure.seconds else limits
        self.costs: list[float] = []
        self.opened: set[Opened] = set()
        self._send = partial(Sent.outward, home=self.home) if executor else Sent.of
        sent = self._send(procedure)
        self.builders: Builders | Elsewhere = (
            Elsewhere(executor, sent, self.limits, shown)
            if executor
            else Builders(sent, self.count, self.limits, shown)
        )

    @classmethod
    def of(cls, procedure: Procedure, settings: Settings, executor: Executor | None = None) -> Workers:
        """As many as the settings say, with their limits of what building one shape may cost."""
        limits = Limits(settings.shape_seconds, settings.shape_memory_mb)
        return cls(procedure, settings.workers, limits, settings.verbose, executor)

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End the processes of this machine."""
        self.builders.close()

    def turn_to(self, procedure: Procedure) -> None:
        """Build shapes of another procedure from now on, in the same processes: starting a process takes far longer.

        Raises ProcedureError when the procedure does not load there.
        """
        self.procedure = procedure
        self.builders.load(self._send(procedure))

    def build(
        self,
        parameters: Sequence[Parameters],
        progress: Callable[[int, int], None] | None = None,
        give_up: bool = False,
    ) -> list[Build]:
        """Build every vector. A failure costs its own shape only.

        give_up: raise ProcedureError when the first shapes all fail for another reason than Infeasible: 3 that exceed
        the time limit, or 8 of any kind. Then the procedure itself is broken, and more shapes would all fail.
        """
        results: list[Build | None] = [None] * len(parameters)
        done = 0

        def took(row: int, build: Build) -> None:
            results[row] = build
            self.opened.update(build.opened)
            if build.seconds:  # nobody knows those of a shape that was lost with its process
                self.costs.append(build.seconds)

        def tick() -> None:
            if progress:
                progress(sum(result is not None for result in results), len(results))

        for count in _PROBES if give_up else ():
            probes = range(done, min(count, len(parameters)))
            self.builders.run(parameters, [probes[i : i + 1] for i in range(len(probes))], took, tick)
            done = max(done, probes.stop)
            _give_up_if_broken([result for result in results[:done] if result is not None], count)
        self.builders.run(parameters, self.slices(range(done, len(parameters))), took, tick)
        return cast(list[Build], results)

    def make(
        self,
        parameters: Sequence[Parameters],
        finish: Callable[[Build], Finished],
        progress: Callable[[int], object] = lambda done: None,
        give_up: bool = False,
        wave: int = 256,
    ) -> Generator[Finished, None, None]:
        """What ``finish`` makes of every vector's build, in order; it is called where the shape is built.

        finish: a function of a module, or a ``partial`` of one, so that it can be sent. give_up: as of ``build``.
        wave: shapes of this machine that are held until something is made of them.
        """

        def begun(done: int, _: int) -> None:
            progress(done)

        first = self.build(parameters[: _PROBES[-1]], begun, give_up=True) if give_up else []
        yield from in_threads(finish, first, self.count)
        rest = range(len(first), len(parameters))
        if isinstance(self.builders, Elsewhere):
            chunks = [[parameters[i] for i in piece] for piece in self.slices(rest)]
            for done, finished in enumerate(self.builders.stream(chunks, finish), len(first) + 1):
                progress(done)
                yield finished
            return
        for start in rest[::wave]:

            def told(done: int, _: int, start: int = start) -> None:
                progress(start + done)

            yield from in_threads(finish, self.build(parameters[start : start + wave], told), self.count)

    def each(self, function: Callable[[Item], Result], items: Sequence[Item]) -> list[Result]:
        """What a function makes of each item, in order: in threads, or in chunks on the machines of the executor.

        function: of a module, or a ``partial`` of one, so that it can be sent, as the items can.
        """
        if not isinstance(self.builders, Elsewhere):
            return in_threads(function, items, self.count)
        chunks = [[items[i] for i in piece] for piece in self.slices(range(len(items)))]
        return [result for part in self.spread(partial(mapped, function=function), chunks) for result in part]

    def spread(self, task: Callable[[Crew, Part], Result], parts: Iterable[Part]) -> Generator[Result, None, None]:
        """What a task makes of each part of some work, in order; the shapes that it needs are built where it is done.

        task: as the function of ``each``. parts: have lengths, and can be sent; see ``slices``.
        """
        if not isinstance(self.builders, Elsewhere):
            yield from (task(self, part) for part in parts)
            return
        with closing(self.builders.answers(task, cast(Iterable[Sequence[object]], parts))) as answers:
            for done in answers:
                self.costs += done.costs
                self.opened.update(done.opened)
                yield done.result

    def elsewhere(self, builds: Sequence[Build]) -> list[Build]:
        """The same shapes built again, each in another process than the one that it was built in.

        Where that process ends, the shapes that it was still to build stay as they are.
        """
        return self.builders.elsewhere(builds) if builds else []

    def slices(self, rows: range, most: int = SLICE) -> list[range]:
        """Rows in chunks: some for each that builds, of ``most`` rows at most; of a queue one for each of its jobs."""
        if isinstance(self.builders, Elsewhere) and self.builders.is_queue:
            size = min(_JOB, -(-len(rows) // self.count))
        else:
            size = min(most, len(rows) // (4 * self.count))
        return [rows[i : i + size] for size in [max(1, size)] for i in range(0, len(rows), size)]


def _give_up_if_broken(probes: Sequence[Build], enough: int) -> None:
    kinds = {build.failure.kind if build.failure else None for build in probes}
    hopeless = kinds == {"time"} or (enough == _PROBES[-1] and not kinds & {None, "infeasible"})
    if len(probes) >= enough and hopeless:
        message = f"every one of the first {len(probes)} shapes failed: {describe_failures(probes)}"
        raise ProcedureError(message, commonest_place(probes), summary=True)
