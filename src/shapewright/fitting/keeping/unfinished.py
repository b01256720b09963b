"""What is done of a fit that is not finished: kept in a folder, piece by piece, so that the same command goes on.

A piece is a file: the length of its head, the head, and bytes. It is there whole or not at all. A piece that took less
time than it takes to repeat a command is not kept, so that short fits write nothing.
"""

from __future__ import annotations

import hashlib
import json
import shutil
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

from shapewright.runs.folder import RunError
from shapewright.storage import remove_leftovers, write_durably

UNFINISHED = ".unfinished"
"""Name of the folder of all unfinished fits of a project: in its folder of runs."""
LEAST_SECONDS = 2.0
"""That a piece has to take to be kept. Writing one takes some hundredths."""
_STALE_SECONDS = 30 * 24 * 3600.0
"""After which an unfinished fit is not gone on with: its procedure has changed since. Our estimate."""
_LENGTH = 8  # bytes that tell the length of the head

Piece = TypeVar("Piece")
Fact = TypeVar("Fact")


@dataclass(frozen=True)
class Form(Generic[Piece]):
    """How a piece is written and read back: ``read`` gets the head and the rest, and may raise anything for others."""

    write: Callable[[Piece], tuple[bytes, Iterable[bytes]]]
    read: Callable[[bytes, memoryview], Piece]


_PLAIN: Form[Any] = Form(lambda fact: (json.dumps(fact).encode(), ()), lambda head, _: json.loads(head))


class Unfinished:
    """The folder of one fit, or of none: then nothing is kept but what memory cannot hold.

    root: the folder of all unfinished fits. fresh: whether to forget what is there of this fit. least: see
    LEAST_SECONDS.
    """

    def __init__(self, root: Path | None = None, fresh: bool = False, least: float = LEAST_SECONDS) -> None:
        self._root, self._fresh, self._least = root, fresh, least
        self._folder: Path | None = None
        self._scratch: tempfile.TemporaryDirectory[str] | None = None

    def begin(self, facts: Mapping[str, Any]) -> bool:
        """Go on with the fit of these facts, plain values that decide its result, or begin it; whether it goes on."""
        if self._root is None:
            return False
        key = hashlib.sha256(json.dumps(facts, sort_keys=True, default=str).encode()).hexdigest()[:20]
        self._folder = self._root / key
        if self._fresh:
            shutil.rmtree(self._folder, ignore_errors=True)
        _remove_stale(self._root)
        return any(self.names(""))

    def piece(self, name: str, form: Form[Piece], make: Callable[[], Piece], always: bool = False) -> Piece:
        """What is kept under a name, or what ``make`` gives, which is kept then if it took long; or ``always``.

        Raises RunError where the disk is full and the piece has to be kept.
        """
        if (known := self.known(name, form)) is not None:
            return known
        started = time.perf_counter()
        made = make()
        if always:
            self.keep(name, form, made)
        else:
            self.offer(name, form, made, time.perf_counter() - started)
        return made

    def offer(self, name: str, form: Form[Piece], piece: Piece, seconds: float) -> None:
        """Keep a piece that took so long, if that is long."""
        if self._folder and seconds >= self._least:
            with suppress(RunError):  # it is in memory still: a full disk is no reason to end before it has to
                self.keep(name, form, piece)

    def known(self, name: str, form: Form[Piece]) -> Piece | None:
        """What is kept under a name; None where nothing is, or something damaged."""
        if self._folder is None and self._scratch is None:
            return None
        try:
            content = memoryview(self._path(name).read_bytes())
            end = _LENGTH + int.from_bytes(content[:_LENGTH], "little")
            return form.read(bytes(content[_LENGTH:end]), content[-(-end // _LENGTH) * _LENGTH :])
        except Exception:  # noqa: BLE001 - of another version, or damaged: it is made again
            return None

    def keep(self, name: str, form: Form[Piece], piece: Piece) -> None:
        """Keep a piece. Raises RunError where the disk is full."""
        head, rest = form.write(piece)
        padding = bytes(-len(head) % _LENGTH)
        path = self._path(name)
        try:
            write_durably(path, [len(head).to_bytes(_LENGTH, "little"), head, padding, *rest])
        except OSError as error:
            remains = "what was done before is kept: free some space and repeat the command" if self._folder else ""
            raise RunError(f"{path.parent}: cannot be written: {error.strerror or error}; {remains}") from error

    def fact(self, name: str) -> Any:
        """A plain value that is kept; None where it is not."""
        return self.known(name, _PLAIN)

    def once(self, name: str, fact: Fact) -> Fact:
        """A plain value that is as it was when the fit began, whatever it would be now."""
        known: Fact | None = self.fact(name)
        if known is None and self._folder is not None:
            with suppress(RunError):
                self.keep(name, _PLAIN, fact)
        return fact if known is None else known

    def forget(self) -> None:
        """Begin anew: what is there is of another fit."""
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)

    def names(self, start: str) -> list[str]:
        """Of the pieces whose names begin so, in order."""
        if self._folder is None:
            return []
        return sorted(path.name for path in self._folder.glob(f"{start}*") if not path.name.startswith("."))

    def remove(self) -> None:
        """The run is written: nothing of it is unfinished any more."""
        self.forget()
        if self._root is not None:
            with suppress(OSError):
                self._root.rmdir()

    def _path(self, name: str) -> Path:
        if self._folder is not None:
            return self._folder / name
        if self._scratch is None:
            self._scratch = tempfile.TemporaryDirectory(prefix="shapewright-", ignore_cleanup_errors=True)
        return Path(self._scratch.name) / name


def _remove_stale(root: Path) -> None:
    """Fits that nobody has gone on with for long, and what killed ones left half written."""
    with suppress(OSError):
        for folder in root.iterdir():
            remove_leftovers(folder)
            if time.time() - folder.stat().st_mtime > _STALE_SECONDS:
                shutil.rmtree(folder, ignore_errors=True)
