"""What OpenSCAD and its evaluators say is wrong, as errors with a place."""

from __future__ import annotations

import re
from pathlib import Path

from shapewright.procedures.errors import Infeasible, ProcedureError
from shapewright.procedures.places import Place

_WHERE = re.compile(
    r",? (?:in file|from) \"?([^,\"]*?)\"?, line (\d+)|, import\(\) at line (?P<imported>\d+)(?!.*, from )"
)
"""The place in a message. An import that fails names its line without the file; the call that led to it is behind."""
_ASSERTION = re.compile(r"Assertion '(.*)' failed(?:: \"?(.*?)\"?)?$", re.DOTALL)

_LACKING = ("Ignoring unknown module", "Ignoring unknown function", "Can't open", "Could not read", "mesh could not")
"""How warnings begin, or what they say, after which a part of the shape is not there."""


def is_lacking(warning: str) -> bool:
    """Whether a part of the shape is not there after this warning."""
    return any(lack in warning for lack in _LACKING)


def failure(file: Path, said: str) -> Exception:
    """The error of what is said about a file.

    An assertion that fails is how a file says that values have no shape: it is Infeasible. Else ProcedureError.
    """
    message, place = located(file, said.removeprefix("ERROR: "))
    if match := _ASSERTION.match(message):
        return Infeasible(match[2] or match[1])
    return ProcedureError(message, place)


def located(file: Path, message: str) -> tuple[str, Place]:
    """The first line of a message without the place that it names, and this place, or the file."""
    head = message.strip().partition("\n")[0]
    if not (match := _WHERE.search(head)):
        return head, Place(str(file), None)
    named, line = (file, match["imported"]) if match["imported"] else (file.parent / match[1], match[2])
    return head[: match.start()].partition(", import() at")[0], place(named, int(line))


def place(file: Path, line: int) -> Place:
    """A line of a file, with its text where it can be read."""
    try:
        text = file.read_text("utf-8").splitlines()[line - 1].strip()
    except (OSError, UnicodeDecodeError, IndexError):
        text = ""
    return Place(str(file), line, text or None)
