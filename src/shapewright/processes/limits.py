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
        memory_mb: megabytes of a worker's address space, beyond what it has at its start (POSIX).
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
    """Cap the address space at what is mapped now plus the limit; on systems without rlimits there is no cap."""
    try:
        import resource
    except ImportError:
        return
    with contextlib.suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_AS, (_mapped() + megabytes * 2**20, resource.RLIM_INFINITY))


def memory_left() -> int | None:
    """Megabytes that this process may still map; None without a limit."""
    try:
        import resource
    except ImportError:
        return None
    most = resource.getrlimit(resource.RLIMIT_AS)[0]
    return None if most == resource.RLIM_INFINITY else max(0, most - _mapped()) // 2**20


def _mapped() -> int:
    """Bytes of address space that this process has; 0 where that is not known."""
    with contextlib.suppress(OSError), Path("/proc/self/statm").open() as statm:
        return int(statm.read().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    return 0
