"""The time that building one shape may take; compiling by numba and the start of another program do not count."""

from __future__ import annotations

import contextlib
import os
import signal
import time
from collections.abc import Callable, Iterator
from types import FrameType

from shapewright.processes.resident import STARTING

MOST = 120.0
"""Seconds from the start in which compiling and starting do not count, at most."""
_TICKS = 10
"""Ticks of the clock to one time limit."""
_NUMBA = f"{os.sep}numba{os.sep}"


class TimeLimit(BaseException):
    """The author's code took too long. Not an Exception, so that the author's ``except Exception`` lets it pass."""


@contextlib.contextmanager
def time_limit(seconds: float, compiling: Callable[[], object] = lambda: None) -> Iterator[None]:
    """Raise TimeLimit in the block after ``seconds``; a system without timers has no limit.

    The first shape of a procedure may need kernels, which are compiled once on a machine and then kept. A clock ticks
    _TICKS times within the limit. A tick at which numba compiles, or a program like Blender starts, does not count; it
    calls ``compiling`` instead.
    """
    if not hasattr(signal, "setitimer"):
        yield
        return
    begun, left = time.monotonic(), _TICKS

    def tick(number: int, frame: FrameType | None) -> None:
        nonlocal left
        if time.monotonic() - begun < MOST and _prepares(frame):
            compiling()
            return
        left -= 1
        if left == 0:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            raise TimeLimit(f"it took longer than {seconds:g} s")

    before = signal.signal(signal.SIGALRM, tick)
    signal.setitimer(signal.ITIMER_REAL, seconds / _TICKS, seconds / _TICKS)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def _prepares(frame: FrameType | None) -> bool:
    while frame:
        if _NUMBA in frame.f_code.co_filename or frame.f_code is STARTING:
            return True
        frame = frame.f_back
    return False
