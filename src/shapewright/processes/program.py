"""What every program of a worker process does first."""

from __future__ import annotations

import contextlib
import signal
import sys
from collections.abc import Callable
from multiprocessing.connection import Client, Connection


def attend(serve: Callable[[Connection], None]) -> None:
    """Connect to the parent, by the address in the arguments and the key on standard input, and serve it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    key = sys.stdin.buffer.read(32)
    with contextlib.suppress(EOFError, ConnectionError), Client(sys.argv[1], authkey=key) as connection:
        serve(connection)
