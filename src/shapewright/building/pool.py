"""Building many shapes: in worker processes that a bad procedure cannot take down with it.

Each worker is a fresh interpreter (``python -m shapewright.building.worker``), so an author's script needs no
``__main__`` guard and nothing is inherited from a process that runs torch. Shapes travel in slices; when a worker dies
or hangs, its slice is built again one shape at a time, so that only the shape at fault is lost.
"""

from __future__ import annotations

import pickle
import queue
import sys
import threading
from collections.abc import Callable, Sequence
from dataclasses import replace

import cloudpickle

from shapewright.building.opened import Opened
from shapewright.building.outcomes import Build, Failure, commonest_place, describe_failures
from shapewright.building.process import WorkerProcess
from shapewright.parameters import Parameters
from shapewright.procedures import Procedure, ProcedureError
from shapewright.processes import Limits
from shapewright.processes.pool import Pool
from shapewright.settings import Settings
from shapewright.threads import cores, in_threads

SLICE = 64
"""Shapes in one request to a worker, at most."""
_PROBES = (3, 8)
"""First shapes that say whether a procedure is broken: all too slow, or all failed."""


class Workers:
    """Worker processes that build shapes of one procedure at a time; a context manager.

    The results are in the order of the request and do not depend on the number of workers.

    shown: what the author's code prints goes to standard error; by default its last lines are kept for failures.

    Attributes:
        home: the folder of the first procedure's file, None where it has none: what it reads lies there.
        costs: seconds of every shape that was built so far, also while others are.
        opened: files of the author's that were read meanwhile.
    """

    def __init__(
        self, procedure: Procedure, count: int | None = None, limits: Limits | None = None, shown: bool = False
    ) -> None:
        self.procedure = procedure
        self.home = procedure.path.parent if procedure.path else None
        self.count = count or cores()
        limits = limits or Limits()
        self.limits = replace(limits, seconds=procedure.seconds) if procedure.seconds else limits
        self.costs: list[float] = []
        self.opened: set[Opened] = set()
        self._payload, self._shown = _payload(procedure), shown
        self._pool = Pool(lambda: WorkerProcess(self._payload, self.limits, shown), self.count)

    @classmethod
    def of(cls, procedure: Procedure, settings: Settings) -> Workers:
        """As many as the settings say, with their limits of what building one shape may cost."""
        limits = Limits(settings.shape_seconds, settings.shape_memory_mb)
        return cls(procedure, settings.workers, limits, settings.verbose)

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End the processes."""
        self._pool.close()

    def turn_to(self, procedure: Procedure) -> None:
        """Build shapes of another procedure from now on, in the same processes: starting a process takes far longer.

        Raises ProcedureError when the procedure does not load there.
        """
        self._payload, self.procedure = _payload(procedure), procedure
        try:
            for worker in self._pool.idle:
                worker.load(self._payload)
        except ProcedureError:
            self._pool.close()
            raise

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
        for count in _PROBES if give_up else ():
            probes = range(done, min(count, len(parameters)))
            self._run(parameters, [probes[i : i + 1] for i in range(len(probes))], results, progress)
            done = max(done, probes.stop)
            _give_up_if_broken([result for result in results[:done] if result is not None], count)
        size = max(1, min(SLICE, (len(parameters) - done) // (4 * self.count)))
        slices = [range(i, min(i + size, len(parameters))) for i in range(done, len(parameters), size)]
        self._run(parameters, slices, results, progress)
        return [result for result in results if result is not None]

    def elsewhere(self, builds: Sequence[Build]) -> list[Build]:
        """The same shapes built again, each in another process than the one that it was built in.

        Where that process ends, the shapes that it was still to build stay as they are.
        """
        if not builds:
            return []
        while len(self._pool.idle) < 2:
            self._pool.idle.append(WorkerProcess(self._payload, self.limits, self._shown))
        homes = {worker.number: worker for worker in self._pool.idle}
        asked: dict[WorkerProcess, list[int]] = {}
        for i, build in enumerate(builds):
            other = next(worker for number, worker in homes.items() if number != build.process)
            asked.setdefault(other, []).append(i)
        results = list(builds)

        def serve(item: tuple[WorkerProcess, list[int]]) -> None:
            worker, rows = item
            for i in rows:
                made = worker.build([builds[i].parameters], threading.Event())
                results[i] = Build(builds[i].parameters, None, made) if isinstance(made, Failure) else made[0]
                if isinstance(made, Failure):
                    worker.stop()
                    self._pool.idle.remove(worker)
                    return

        in_threads(serve, list(asked.items()), len(asked))
        for worker in self._pool.idle[self.count :]:
            worker.stop()
        del self._pool.idle[self.count :]
        return results

    def _run(
        self,
        parameters: Sequence[Parameters],
        slices: list[range],
        results: list[Build | None],
        progress: Callable[[int, int], None] | None,
    ) -> None:
        tasks: queue.SimpleQueue[range] = queue.SimpleQueue()
        for piece in slices:
            tasks.put(piece)

        def serve(worker: WorkerProcess, piece: range, stop: threading.Event) -> WorkerProcess | None:
            return self._serve(worker, parameters, piece, results, tasks, stop)

        def tick() -> None:
            if progress:
                progress(sum(result is not None for result in results), len(results))

        self._pool.run(tasks, serve, tick)

    def _serve(
        self,
        worker: WorkerProcess,
        parameters: Sequence[Parameters],
        piece: range,
        results: list[Build | None],
        tasks: queue.SimpleQueue[range],
        stop: threading.Event,
    ) -> WorkerProcess | None:
        """Build one slice; returns the worker, or None when it had to be ended."""
        outcome = worker.build([parameters[i] for i in piece], stop)
        if isinstance(outcome, Failure):
            worker.stop()
            if stop.is_set():
                return None
            if len(piece) == 1:
                results[piece[0]] = Build(parameters[piece[0]], None, outcome)
            else:
                for i in piece:
                    tasks.put(range(i, i + 1))
            return None
        for i, build in zip(piece, outcome, strict=False):
            results[i] = build
            self.costs.append(build.seconds)
            self.opened.update(build.opened)
        if len(outcome) < len(piece):
            tasks.put(piece[len(outcome) :])
        return worker


def _give_up_if_broken(probes: Sequence[Build], enough: int) -> None:
    kinds = {build.failure.kind if build.failure else None for build in probes}
    hopeless = kinds == {"time"} or (enough == _PROBES[-1] and not kinds & {None, "infeasible"})
    if len(probes) >= enough and hopeless:
        message = f"every one of the first {len(probes)} shapes failed: {describe_failures(probes)}"
        raise ProcedureError(message, commonest_place(probes), summary=True)


def _payload(procedure: Procedure) -> bytes:
    target = f"{procedure.path}:{procedure.name}" if procedure.path else procedure
    try:
        # What the procedure needs is found by this process's path: a worker needs that before it reads the procedure.
        return pickle.dumps((list(sys.path), procedure.working, bytes(cloudpickle.dumps(target))))
    except Exception as error:
        raise ProcedureError(
            f"it cannot be sent to the worker processes ({error}); "
            "put the procedure in a file of its own and load it with load_procedure",
            procedure.place,
        ) from error
