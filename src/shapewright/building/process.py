"""One worker process, seen from its parent: it is started, gets requests, and is ended when a shape breaks it."""

from __future__ import annotations

import os
import secrets
import subprocess
import sys
import tempfile
import threading
from concurrent.futures import Future
from multiprocessing.connection import Connection, Listener
from pathlib import Path
from typing import Any

from shapewright.building.clock import COMPILING
from shapewright.building.outcomes import Build, Failure, Limits
from shapewright.parameters import Parameters

_PROGRAM = "shapewright.building.worker"
_START_SECONDS = 60.0
"""Seconds that a worker may take to start and to read the procedure's file. A usual start takes a quarter of one."""
SINGLE_THREADED = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")


class WorkerProcess:
    """One worker process and the connection to it.

    payload: the procedure, pickled. Raises ProcedureError when it cannot be loaded.
    """

    def __init__(self, payload: bytes, limits: Limits) -> None:
        self.limits = limits
        key = secrets.token_bytes(32)
        with tempfile.TemporaryDirectory(prefix="shapewright-") as folder:
            address = None if sys.platform == "win32" else str(Path(folder) / "worker")
            with Listener(address, authkey=key) as listener:
                self.process = subprocess.Popen(
                    # -P: a random.py of the author in the working folder is not Python's.
                    [sys.executable, "-P", "-m", _PROGRAM, str(listener.address)],
                    stdin=subprocess.PIPE,
                    stdout=sys.stderr.fileno() if _has_descriptor(sys.stderr) else subprocess.DEVNULL,
                    env={**os.environ, **SINGLE_THREADED},
                )
                assert self.process.stdin is not None
                self.process.stdin.write(key)
                self.process.stdin.close()
                self.connection = self._accept(listener)
        self._load((payload, limits), _START_SECONDS, no_answer(_START_SECONDS))

    def build(self, parameters: list[Parameters], stop: threading.Event) -> list[Build] | Failure:
        """The builds of the first few vectors (at least one), or the failure that ended the worker.

        A worker answers after a fraction of the time limit at the latest, unless a shape exceeds the limit itself.
        stop: ends the wait; the worker is then lost.
        """
        answer: list[Build] | Failure | None = self._exchange(parameters, self._patience, stop)
        return answer or too_long(self.limits)

    def load(self, payload: bytes) -> None:
        """Build shapes of another procedure from now on. Raises ProcedureError; the worker is then lost."""
        self._load(payload, self._patience, too_long(self.limits))

    @property
    def _patience(self) -> float:
        return 1.25 * self.limits.seconds + 0.5

    def _load(self, request: Any, patience: float, late: Failure) -> None:
        answer = self._exchange(request, patience, threading.Event()) or late
        if isinstance(answer, Failure):
            self.stop()
            raise answer.error()

    def _exchange(self, request: Any, patience: float, stop: threading.Event) -> Any:
        """The worker's answer, or why it ended; None after ``patience`` seconds of silence or at ``stop``."""
        answer: Any = COMPILING
        try:
            self.connection.send(request)
            while answer == COMPILING:
                left = patience
                while not self.connection.poll(min(0.2, left)):
                    left -= 0.2
                    if stop.is_set() or left <= 0.0:
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
        for _ in range(int(_START_SECONDS / 0.1)):
            try:
                return accepted.result(timeout=0.1)
            except TimeoutError:
                if self.process.poll() is not None:
                    break
        self.process.kill()
        raise RuntimeError(f"a worker process did not start (exit status {self.process.poll()})")

    def stop(self) -> None:
        if hasattr(self, "connection"):
            self.connection.close()
        self.process.kill()
        self.process.wait()


def crash(process: subprocess.Popen[bytes]) -> Failure:
    """Of a shape with which a process broke off its answer."""
    try:
        status = process.wait(timeout=2.0)
    except subprocess.TimeoutExpired:
        return Failure("crash", "the worker process broke off its answer")
    if status < 0:
        return Failure("crash", f"it killed its process (signal {-status})")
    return Failure("crash", f"it ended its process (exit status {status})")


def too_long(limits: Limits) -> Failure:
    """Of a shape that did not stop at the time limit by itself."""
    return Failure("time", f"it took longer than {limits.seconds:g} s")


def no_answer(seconds: float) -> Failure:
    """Of a procedure's file that did not stop being read."""
    return Failure("time", f"a worker process read the procedure's file and did not answer within {seconds:g} s")


def _has_descriptor(stream: Any) -> bool:
    try:
        return bool(stream.fileno() >= 0)
    except (AttributeError, OSError, ValueError):
        return False
