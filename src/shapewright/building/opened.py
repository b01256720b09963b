"""Files that the author's code reads beside itself and from the working folder: workers note them, a run keeps them."""

from __future__ import annotations

import contextlib
import importlib.util
import os
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

_PACKAGE = Path(__file__).parents[1]
_NOT_READ = os.O_WRONLY | os.O_RDWR


@dataclass(frozen=True, order=True)
class Opened:
    """A file that the author's code read.

    path: in full.
    named: its path from the working folder, where the code named it so; empty where it did not.
    """

    path: str
    named: str = ""


class Readings:
    """What Python code of this process opens to read, from now on; what a library in C opens is not seen."""

    def __init__(self) -> None:
        self._new: set[Opened] = set()
        self._known: set[Opened] = set()
        sys.addaudithook(self._note)

    def _note(self, event: str, arguments: tuple[Any, ...]) -> None:
        if event != "open" or arguments[2] & _NOT_READ:
            return
        with contextlib.suppress(Exception):  # an error here would keep the author from the file
            name = os.fspath(arguments[0])
            if isinstance(name, str):
                path = Path(os.path.normpath(name))
                self._new.add(Opened(str(path.absolute()), "" if path.is_absolute() else str(path)))

    def taken(self, procedure: Path | None) -> tuple[Opened, ...]:
        """Those that were not told yet, of the procedure's folder or named from the working folder.

        What belongs to installed packages, to this one, or is hidden is none of the author's.
        """
        if procedure is None or not self._new:
            return ()
        fresh = {_source(opened) for opened in self._new} - self._known
        self._new.clear()
        self._known |= fresh
        return tuple(sorted(opened for opened in fresh if is_own(opened, procedure)))


def is_own(opened: Opened, procedure: Path) -> bool:
    """Whether a file is one of the author's that lies where a run can keep it."""
    path = Path(opened.path)
    inside = path.is_relative_to(procedure.parent)
    parts = path.relative_to(procedure.parent).parts if inside else Path(opened.named).parts
    foreign = any(part in ("..", "site-packages", "__pycache__") or part.startswith(".") for part in parts)
    return bool(parts) and not foreign and path != procedure and not path.is_relative_to(_PACKAGE) and path.is_file()


def _source(opened: Opened) -> Opened:
    """The file of a module that was read as compiled; any other as it is."""
    if opened.path.endswith(".pyc"):
        with contextlib.suppress(ValueError):
            return Opened(importlib.util.source_from_cache(opened.path))
    return opened
