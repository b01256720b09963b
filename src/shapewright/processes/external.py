"""Programs of others, run one at a time: what they say is kept, and they end with all that they started."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import subprocess
import tempfile
import threading
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import FrameType
from typing import IO

_KEPT = 16_384
"""Bytes at the end of what a program says that are kept."""


@dataclass(frozen=True)
class Ended:
    """How a program ended.

    Attributes:
        status: its exit status; below 0 the number of the signal that ended it; None where it took too long.
        said: the last lines of its standard error, or of its standard output where that is empty.
    """

    status: int | None
    said: tuple[str, ...]

    @property
    def last_words(self) -> str:
        """Its last line, and behind it up to four lines before; empty where it said nothing."""
        last, before = self.said[-1:], self.said[-5:-1]
        return "".join(last) + (f" (before it: {' | '.join(before)})" if before else "")


def run_program(
    words: Sequence[str],
    folder: Path,
    seconds: float | None = None,
    memory_mb: int | None = None,
    environment: Mapping[str, str] | None = None,
) -> Ended:
    """Run a program to its end. Whatever ends the wait ends the program and all that it started, too.

    Raises OSError where it cannot be started.

    Args:
        words: the program and its arguments.
        folder: that it runs in.
        seconds: wall time that it may take; None without a limit.
        memory_mb: megabytes that it may write to (Linux); None without a limit.
        environment: further variables.
    """
    with tempfile.TemporaryFile() as told, tempfile.TemporaryFile() as failed:
        with _without_limit():
            process = subprocess.Popen(
                list(words),
                cwd=folder,
                env={**os.environ, **(environment or {})},
                stdin=subprocess.DEVNULL,
                stdout=told,
                stderr=failed,
                start_new_session=True,
                preexec_fn=partial(allow, memory_mb) if memory_mb and os.name == "posix" else None,
            )
        try:
            with _ended_by_terminate():
                late = not _wait(process, seconds)
        finally:
            _end(process)
        return Ended(None if late else process.returncode, last_lines(failed) or last_lines(told))


@contextlib.contextmanager
def _without_limit() -> Iterator[None]:
    """A program that is started here does not inherit this process's limit of memory.

    A function that lifts it in the new process would cost 18 ms of CPU: Python then copies this process's page tables.
    Only a program that has a limit of its own costs that; what it starts itself has to have the limit as well.
    """
    try:
        import resource
    except ImportError:
        yield
        return
    own = resource.getrlimit(resource.RLIMIT_DATA)
    with contextlib.suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_DATA, (own[1], own[1]))
    try:
        yield
    finally:
        with contextlib.suppress(ValueError, OSError):
            resource.setrlimit(resource.RLIMIT_DATA, own)


def allow(memory_mb: int | None) -> None:
    """In the new process: its own limit of memory, in place of the one that this process has."""
    import resource

    with contextlib.suppress(ValueError, OSError):
        most = resource.RLIM_INFINITY if memory_mb is None else memory_mb * 2**20
        resource.setrlimit(resource.RLIMIT_DATA, (most, resource.getrlimit(resource.RLIMIT_DATA)[1]))


def _wait(process: subprocess.Popen[bytes], seconds: float | None) -> bool:
    """Whether it ended in time. Popen's own wait looks every 50 ms; a program of 10 ms should not wait for that."""
    if hasattr(os, "pidfd_open"):
        handle = os.pidfd_open(process.pid)
        try:
            if not select.select([handle], [], [], seconds)[0]:
                return False
        finally:
            os.close(handle)
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        return False
    return True


@contextlib.contextmanager
def _ended_by_terminate() -> Iterator[None]:
    """A worker that is told to end while a program runs leaves the block as an error does."""

    def leave(number: int, frame: FrameType | None) -> None:
        raise SystemExit(128 + number)

    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, leave)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _end(process: subprocess.Popen[bytes]) -> None:
    """End what is left of the program's session: itself, and what it started."""
    if hasattr(os, "killpg"):
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()
    process.wait()


def last_lines(stream: IO[bytes]) -> tuple[str, ...]:
    """The last lines of a file that a program writes, without empty ones."""
    end = stream.seek(0, os.SEEK_END)
    stream.seek(max(0, end - _KEPT))
    lines = stream.read().decode("utf-8", "replace").splitlines()
    return tuple(line.strip() for line in lines if line.strip())


def words_of(status: int) -> str:
    """An exit status in words: "exit status 2", "signal 11, SIGSEGV"."""
    if status >= 0:
        return f"exit status {status}"
    with contextlib.suppress(ValueError):
        return f"signal {-status}, {signal.Signals(-status).name}"
    return f"signal {-status}"
