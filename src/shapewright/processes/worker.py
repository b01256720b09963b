"""One worker process, seen from its parent: it is started, gets requests, and is ended when one of them breaks it."""

from __future__ import annotations

import contextlib
import os
import secrets
import subprocess
import sys
import tempfile
import threading
from concurrent.futures import Future
from multiprocessing.connection import Connection, Listener
from pathlib import Path
from typing import IO, Any

from shapewright.processes.limits import crash

AT_WORK = "at work"
"""Message of a worker to its parent, which then waits for the answer from the beginning."""
START_SECONDS = 60.0
"""Seconds that a worker may take to start. A usual start takes a quarter of one."""
_TO_END = 0.5
"""Seconds that a worker may take to end a program that it runs."""
SINGLE_THREADED = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")


class Worker:
    """A program of this package in a process of its own, and the connection to it.

    program: the module that it runs, which calls ``program.attend``.
    printed: where what it prints goes; by default to this process's standard error.
    """

    def __init__(self, program: str, printed: IO[bytes] | None = None) -> None:
        key = secrets.token_bytes(32)
        with tempfile.TemporaryDirectory(prefix="shapewright-") as folder:
            address = None if sys.platform == "win32" else str(Path(folder) / "worker")
            with Listener(address, authkey=key) as listener:
                self.process = subprocess.Popen(
                    # -P: a random.py of the author in the working folder is not Python's.
                    [sys.executable, "-P", "-m", program, str(listener.address)],
                    stdin=subprocess.PIPE,
                    stdout=printed or (sys.stderr.fileno() if _has_descriptor(sys.stderr) else subprocess.DEVNULL),
                    stderr=printed,
                    env={**os.environ, **SINGLE_THREADED},
                )
                assert self.process.stdin is not None
                self.process.stdin.write(key)
                self.process.stdin.close()
                self.connection = self._accept(listener)

    def ask(self, request: Any, patience: float, stop: threading.Event | None = None) -> Any:
        """The worker's answer, or the Loss of its process; None after ``patience`` seconds of silence or at ``stop``.

        After anything but an answer the worker is of no more use.
        """
        answer: Any = AT_WORK
        try:
            self.connection.send(request)
            while isinstance(answer, str) and answer == AT_WORK:
                left = patience
                while not self.connection.poll(min(0.2, left)):
                    left -= 0.2
                    if left <= 0.0 or (stop is not None and stop.is_set()):
                        return None
                answer = self.connection.recv()
        except (EOFError, OSError):
            return crash(self.process)
        return answer

    def _accept(self, listener: Listener) -> Connection:
        accepted: Future[Connection] = Future()

        def wait() -> None:
            try:
                accepted.set_result(listener.accept())
            except BaseException as error:  # noqa: BLE001 - handed to the caller's thread
                accepted.set_exception(error)

        threading.Thread(target=wait, daemon=True).start()
        for _ in range(int(START_SECONDS / 0.1)):
            try:
                return accepted.result(timeout=0.1)
            except TimeoutError:
                if self.process.poll() is not None:
                    break
        self.process.kill()
        raise RuntimeError(f"a worker process did not start (exit status {self.process.poll()})")

    def stop(self) -> None:
        """End the process at once; one that runs another program ends that first."""
        if hasattr(self, "connection"):
            self.connection.close()
        self.process.terminate()
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.process.wait(_TO_END)
        self.process.kill()
        self.process.wait()


def _has_descriptor(stream: Any) -> bool:
    try:
        return bool(stream.fileno() >= 0)
    except (AttributeError, OSError, ValueError):
        return False
