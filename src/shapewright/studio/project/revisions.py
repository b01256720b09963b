"""The undo list: every write of the procedure on disk, with the text before it, the text after it, and what wrote it.

A file for each, ``000001.json``, ``000002.json`` and so on. They follow one another without a gap: what other programs
wrote in between is one of them.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from functools import lru_cache
from pathlib import Path
from typing import Any

from shapewright.procedures import source_digest
from shapewright.runs.difference import difference
from shapewright.storage import write_file
from shapewright.studio.wire.revisions import Revision, RevisionDetail, Writer
from shapewright.studio.wire.work import DiffLine

_KEPT = 1000
"""Older ones are deleted. A day of work makes some hundred, of some ten kilobytes each."""


class Revisions:
    """Those of one project.

    home: gives the folder that holds them, and makes it where it is missing.
    """

    def __init__(self, folder: Path, home: Callable[[], Path]) -> None:
        self._folder, self._home = folder, home

    def all(self) -> list[Revision]:
        """The newest first; one that cannot be read is passed over."""
        found = []
        for path in reversed(self._paths()):
            with suppress(OSError, ValueError, KeyError, TypeError):
                found.append(_summary(path, path.stat().st_mtime_ns))
        return found

    def detail(self, number: int) -> RevisionDetail:
        """One in full. Raises KeyError for one that is not there, or cannot be read."""
        before, after = self.texts(number)
        lines = [DiffLine(**vars(line)) for line in difference(before, after)]
        path = self._path(number)
        return RevisionDetail(revision=_summary(path, path.stat().st_mtime_ns), diff=lines)

    def texts(self, number: int) -> tuple[str, str]:
        """The text before a write and the one after it. Raises KeyError as ``detail`` does."""
        try:
            entry = _read(self._path(number))
            return str(entry["before"]), str(entry["after"])
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise KeyError(number) from error

    def catch_up(self, last: str | None, now: str) -> None:
        """Note that another program has written the text that is there now.

        last: the text that was there when somebody looked last, for a list that is empty. Raises OSError.
        """
        before = next(self._texts_after(), last)
        if before is not None and before != now:
            self._add(before, now, "another program", "")

    @contextmanager
    def of_write(self, before: str, after: str, writer: Writer, of: str) -> Iterator[int]:
        """The number of a write, which happens in the block; if that fails, it is not in the list. Raises OSError."""
        self.catch_up(None, before)
        path = self._add(before, after, writer, of)
        try:
            yield int(path.stem)
        except BaseException:
            with suppress(OSError):
                path.unlink()
            raise

    def _texts_after(self) -> Iterator[str]:
        """The texts after the writes, the newest first; of those that can be read."""
        for path in reversed(self._paths()):
            with suppress(KeyError):
                yield self.texts(int(path.stem))[1]

    def _add(self, before: str, after: str, writer: Writer, of: str) -> Path:
        home, paths = self._home(), self._paths()
        path = home / self._path(int(paths[-1].stem) + 1 if paths else 1).name
        written = datetime.now(UTC).isoformat(timespec="seconds")
        entry = {"written": written, "writer": writer, "of": of, "before": before, "after": after}
        write_file(path, json.dumps(entry))
        for old in paths[: 1 - _KEPT]:
            with suppress(OSError):
                old.unlink()
        return path

    def _path(self, number: int) -> Path:
        return self._folder / f"{number:06d}.json"

    def _paths(self) -> list[Path]:
        """The oldest first."""
        found = [path for path in self._folder.glob("*.json") if path.stem.isdecimal()]
        return sorted(found, key=lambda path: int(path.stem))


def _read(path: Path) -> dict[str, Any]:
    entry: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return entry


@lru_cache(maxsize=2 * _KEPT)
def _summary(path: Path, stamp: int) -> Revision:
    entry = _read(path)
    kinds = [line.kind for line in difference(entry["before"], entry["after"])]
    return Revision(
        number=int(path.stem),
        written=entry["written"],
        writer=entry["writer"],
        of=entry["of"],
        added=kinds.count("added"),
        removed=kinds.count("removed"),
        before=source_digest(entry["before"]),
        after=source_digest(entry["after"]),
    )
