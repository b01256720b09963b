"""Workers that serve tasks side by side, and are kept for the next ones."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait
from typing import Generic, Protocol, TypeAlias, TypeVar


class Stoppable(Protocol):
    """What a pool holds: something with a process behind it, which ``stop`` ends."""

    def stop(self) -> None: ...


W = TypeVar("W", bound=Stoppable)
Task = TypeVar("Task")
Tasks: TypeAlias = queue.SimpleQueue[Task]


class Pool(Generic[W]):
    """Up to ``count`` workers, each started when there is a task for it, kept until ``close``."""

    def __init__(self, start: Callable[[], W], count: int) -> None:
        self.idle: list[W] = []
        self.count = count
        self._start = start

    def run(
        self,
        tasks: Tasks[Task],
        serve: Callable[[W, Task, threading.Event], W | None],
        tick: Callable[[], object] = lambda: None,
        most: int | None = None,
    ) -> None:
        """Serve tasks until there are none. What goes wrong in ``serve``, and in ``tick``, ends all and is raised.

        Args:
            tasks: the tasks; ``serve`` may add more.
            serve: serves one, and returns the worker, or None where that had to be ended. The event says: break off.
            tick: called every 20 ms.
            most: workers at most, where fewer than ``count`` are wanted.
        """
        stop = threading.Event()

        def work() -> None:
            worker: W | None = None
            while not stop.is_set():
                try:
                    task = tasks.get_nowait()
                except queue.Empty:
                    break
                worker = serve(worker or self._take(), task, stop)
            if worker:
                self.idle.append(worker)

        with ThreadPoolExecutor(self.count) as threads:
            waiting = {threads.submit(work) for _ in range(min(self.count, tasks.qsize(), most or self.count))}
            try:
                while waiting:
                    done, waiting = wait(waiting, timeout=0.02)
                    for server in done:
                        server.result()
                    tick()
            except BaseException:
                stop.set()
                raise

    def _take(self) -> W:
        try:
            return self.idle.pop()
        except IndexError:
            return self._start()

    def close(self) -> None:
        """End all workers that are kept."""
        for worker in self.idle:
            worker.stop()
        self.idle.clear()
