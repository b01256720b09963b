"""What one piece of work may cost, and how it was lost when it cost more."""

from __future__ import annotations

import contextlib
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

LossKind = Literal["time", "memory", "crash"]


@dataclass(frozen=True)
class Limits:
    """What one piece of work may cost, such as building a shape.

    Attributes:
        seconds: wall time.
        memory_mb: megabytes that a worker may write to, beyond what it has at its start (Linux).
    """

    seconds: float = 10.0
    memory_mb: int = 2048


@dataclass(frozen=True)
class Loss:
    """Why a piece of work has no result.

    kind: which limit was reached, or that the process ended.
    message: the same in words; "it" is the work.
    """

    kind: LossKind
    message: str


def crash(process: subprocess.Popen[bytes]) -> Loss:
    """Of work with which a process broke off its answer."""
    try:
        status = process.wait(timeout=2.0)
    except subprocess.TimeoutExpired:
        return Loss("crash", "the worker process broke off its answer")
    if status < 0:
        return Loss("crash", f"it killed its process (signal {-status})")
    return Loss("crash", f"it ended its process (exit status {status})")


def too_long(limits: Limits) -> Loss:
    """Of work that did not stop at the time limit by itself."""
    return Loss("time", f"it took longer than {limits.seconds:g} s")


def too_much(limits: Limits) -> Loss:
    """Of work that asked for memory beyond the limit."""
    return Loss("memory", f"it needed more than {limits.memory_mb} MB of memory")


def limit_memory(megabytes: int) -> None:
    """Cap the memory that this process may write to at what it has now plus the limit; on Linux, which counts it.

    Not the address space: libraries map much of it that they never use, usd-core 1.1 GB on two cores and more on more.
    """
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_DATA, (_taken() + megabytes * 2**20, resource.RLIM_INFINITY))


def memory_left() -> int | None:
    """Megabytes that this process may still take; None without a limit."""
    try:
        import resource

        most, taken = resource.getrlimit(resource.RLIMIT_DATA)[0], _taken()
    except (ImportError, OSError):
        return None
    return None if most == resource.RLIM_INFINITY else max(0, most - taken) // 2**20


def _taken() -> int:
    """Bytes of data and stacks. Raises OSError where the system does not tell them."""
    return int(Path("/proc/self/statm").read_text().split()[5]) * os.sysconf("SC_PAGE_SIZE")
