"""What a program prints, in a file: it never waits for a reader, and nothing is lost when it is killed."""

from __future__ import annotations

import contextlib
import os
import re
import tempfile
from pathlib import Path

_MOST = 64 * 1024
"""Bytes that are taken at a time: some thousand lines. Of more, the first ones are taken, and the rest is counted."""
_HELD = 4 * 2**20
"""Bytes that the file holds before it is emptied: a loop that prints must not fill the disk."""
_CODES = re.compile(r"\x1b\[[0-?]*[ -/]*[@-~]|[\x00-\x08\x0b-\x1f\x7f]")
"""Colours of a terminal, and what it does not show."""


class Printed:
    """The file. stream: what the program is to write to, a file descriptor."""

    def __init__(self) -> None:
        handle, path = tempfile.mkstemp(prefix="shapewright-")
        os.close(handle)
        self._path = Path(path)
        self.stream = os.open(path, os.O_WRONLY | os.O_APPEND)
        self._file = self._path.open("r+b", buffering=0)
        self._at = 0
        with contextlib.suppress(OSError):  # Windows deletes no file that is open
            self._path.unlink()

    def take(self) -> str:
        """What was printed since; at most so much of it."""
        size = os.fstat(self._file.fileno()).st_size
        self._file.seek(self._at)
        found = self._file.read(min(_MOST, size - self._at))
        more = size - self._at - len(found)
        self._at = size
        self.bound()
        text = _CODES.sub("", found.decode("utf-8", "replace"))
        return f"{text}\n… and {more} bytes more\n" if more else text

    def bound(self) -> None:
        """Empty the file where it is too long."""
        if os.fstat(self._file.fileno()).st_size > _HELD:
            self._file.truncate(0)
            self._at = 0

    def close(self) -> None:
        self._file.close()
        os.close(self.stream)
        with contextlib.suppress(OSError):
            self._path.unlink()
