"""The time that building one shape may take; what numba compiles on the way does not count."""

from __future__ import annotations

import contextlib
import os
import signal
import time
from collections.abc import Callable, Iterator
from types import FrameType

COMPILING = "compiling"
"""What a worker tells its parent while numba is compiling: the clock stands still."""
MOST = 120.0
"""Seconds that are granted for compiling, at most."""
_TICKS = 10
_NUMBA = f"{os.sep}numba{os.sep}"


class TimeLimit(BaseException):
    """The author's code took too long. Not an Exception, so that the author's ``except Exception`` lets it pass."""


@contextlib.contextmanager
def time_limit(seconds: float, compiling: Callable[[], object] = lambda: None) -> Iterator[None]:
    """Raise TimeLimit in the block after so many seconds; on systems without timers the block takes what it takes.

    The first shape of a procedure may need kernels that are compiled only once on a machine and then kept: of the ticks
    of a clock, ten to the limit, those at which numba compiles do not count, and ``compiling`` is called.
    """
    if not hasattr(signal, "setitimer"):
        yield
        return
    begun, left = time.monotonic(), _TICKS

    def tick(number: int, frame: FrameType | None) -> None:
        nonlocal left
        if time.monotonic() - begun < MOST and _compiles(frame):
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


def _compiles(frame: FrameType | None) -> bool:
    while frame:
        if _NUMBA in frame.f_code.co_filename:
            return True
        frame = frame.f_back
    return False
