"""What the author's code prints while it builds: a worker keeps it, and the last lines are shown with a failure.

A worker's standard output and standard error are one file without a name, which its parent holds as well: so a process
that dies leaves its last words. The file is emptied after every shape.
"""

from __future__ import annotations

import contextlib
import io
import os
import sys
import tempfile
from dataclasses import dataclass
from typing import IO

_BYTES = 4096
"""Of what was printed last, at most."""
_LINES = 3
_LETTERS = 200
"""Of a line that is shown, at most."""


def kept_file() -> IO[bytes]:
    """A file for the standard streams of a worker."""
    return tempfile.TemporaryFile(prefix="shapewright-")


@dataclass(frozen=True)
class Prints:
    """The file in the worker. file: a descriptor of it, which stays ours whatever the author does with the streams."""

    file: int

    @classmethod
    def of_streams(cls) -> Prints:
        """What is printed goes into the file line by line from now on, so that a crash loses no whole line."""
        for stream in (sys.stdout, sys.stderr):
            if isinstance(stream, io.TextIOWrapper):
                stream.reconfigure(line_buffering=True, errors="backslashreplace")
        return cls(os.dup(1))

    def taken(self) -> str:
        """The last lines that were printed; the file is empty then."""
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(OSError, ValueError, AttributeError):  # the author may have closed or replaced it
                stream.flush()
        if not os.lseek(self.file, 0, os.SEEK_CUR):
            return ""
        text = _last(self.file)
        os.lseek(self.file, 0, os.SEEK_SET)
        os.ftruncate(self.file, 0)
        return text


def left_in(file: IO[bytes]) -> str:
    """In the parent: the last lines that a worker printed which has ended."""
    with contextlib.suppress(OSError, ValueError):
        return _last(file.fileno())
    return ""


def _last(file: int) -> str:
    size = os.lseek(file, 0, os.SEEK_END)
    os.lseek(file, max(0, size - _BYTES), os.SEEK_SET)
    lines = [line.strip() for line in os.read(file, _BYTES).decode(errors="replace").splitlines()]
    return "\n".join(line[:_LETTERS] for line in [line for line in lines if line][-_LINES:])
