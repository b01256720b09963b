"""Places in the author's files: where an error arose."""

from __future__ import annotations

import traceback
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Place:
    """A line of an author's file.

    file: path of the file.
    line: number of the line, from 1; None where only the file is known.
    text: the line itself; None where it is not known.
    function: the function that is meant as a whole; None where one line is meant.
    """

    file: str
    line: int | None
    text: str | None = None
    function: str | None = None

    def __str__(self) -> str:
        line = "" if self.line is None else f":{self.line}"
        return f"{self.file}{line}" + (f", {self.function}()" if self.function else "")

    def says(self, message: str) -> str:
        """A message with its place, for a person: ``file.py:12: ValueError: ... (the line)``."""
        return f"{self}: {message}" + (f"  ({self.text})" if self.text else "")


def place_of(error: BaseException, path: Path | None) -> Place | None:
    """The deepest of the author's lines that an error passed; None when it passed none.

    path: the procedure's file; the author's lines are those of its folder, or all but this package's without one.
    """
    frames = traceback.extract_tb(error.__traceback__)
    theirs = [frame for frame in frames if path is None or Path(frame.filename).is_relative_to(path.parent)]
    own = [frame for frame in theirs if not Path(frame.filename).is_relative_to(Path(__file__).parents[1])]
    return Place(own[-1].filename, own[-1].lineno, own[-1].line or None) if own else None


def describe(error: BaseException) -> str:
    """The kind of an error and what it says."""
    return f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
