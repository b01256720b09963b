"""Worker processes of this machine that build shapes of one procedure at a time.

Each worker is a fresh interpreter (``python -m shapewright.building.worker``), so an author's script needs no
``__main__`` guard and nothing is inherited from a process that runs torch. Shapes travel in slices; when a worker dies
or hangs, its slice is built again one shape at a time, so that only the shape at fault is lost.
"""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Sequence

from shapewright.building.outcomes import Build, Failure
from shapewright.building.process import WorkerProcess
from shapewright.building.sent import Sent
from shapewright.parameters import Parameters
from shapewright.procedures import ProcedureError
from shapewright.processes import Limits
from shapewright.processes.pool import Pool
from shapewright.threads import in_threads

Took = Callable[[int, Build], object]
"""Takes the build of a row as soon as it is there; from any thread."""


class Builders:
    """Up to ``count`` worker processes, each started when there is work for it, kept until ``close``.

    shown: what the author's code prints goes to standard error; by default its last lines are kept for failures.
    """

    def __init__(self, sent: Sent, count: int, limits: Limits, shown: bool = False) -> None:
        self._payload, self._limits, self._shown = sent.payload, limits, shown
        self.count = count
        self.pool = Pool(self._started, count)

    def _started(self) -> WorkerProcess:
        return WorkerProcess(self._payload, self._limits, self._shown)

    def close(self) -> None:
        """End the processes."""
        self.pool.close()

    def load(self, sent: Sent) -> None:
        """Build shapes of another procedure from now on. Raises ProcedureError when it does not load; all end then."""
        self._payload = sent.payload
        try:
            for worker in self.pool.idle:
                worker.load(self._payload)
        except ProcedureError:
            self.pool.close()
            raise

    def run(
        self,
        parameters: Sequence[Parameters],
        slices: Sequence[range],
        took: Took,
        tick: Callable[[], object] = lambda: None,
    ) -> None:
        """Build the rows of all slices."""
        tasks: queue.SimpleQueue[range] = queue.SimpleQueue()
        for piece in slices:
            tasks.put(piece)

        def serve(worker: WorkerProcess, piece: range, stop: threading.Event) -> WorkerProcess | None:
            """Build one slice; returns the worker, or None when it had to be ended."""
            outcome = worker.build([parameters[i] for i in piece], stop)
            if isinstance(outcome, Failure):
                worker.stop()
                if stop.is_set():
                    return None
                if len(piece) == 1:
                    took(piece[0], Build(parameters[piece[0]], None, outcome))
                else:
                    for i in piece:
                        tasks.put(range(i, i + 1))
                return None
            for i, build in zip(piece, outcome, strict=False):
                took(i, build)
            if len(outcome) < len(piece):
                tasks.put(piece[len(outcome) :])
            return worker

        self.pool.run(tasks, serve, tick)

    def elsewhere(self, builds: Sequence[Build]) -> list[Build]:
        """The same shapes built again, each in another process than the one that it was built in.

        Where that process ends, the shapes that it was still to build stay as they are.
        """
        while len(self.pool.idle) < 2:
            self.pool.idle.append(self._started())
        homes = {worker.number: worker for worker in self.pool.idle}
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
                    self.pool.idle.remove(worker)
                    return

        in_threads(serve, list(asked.items()), len(asked))
        for worker in self.pool.idle[self.count :]:
            worker.stop()
        del self.pool.idle[self.count :]
        return results
