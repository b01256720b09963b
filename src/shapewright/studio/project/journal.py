"""What was told of references, one change after another, with what held before: a list that undoes and lasts.

A file for each, ``000001.json`` and so on, as the undo list of the procedure has them.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path

import msgspec
from msgspec import Struct

from shapewright.storage import write_file
from shapewright.studio.wire.detail import Told
from shapewright.studio.wire.revisions import Noted, ToldChange, ToldKind

_KEPT = 1000
"""Older ones are deleted, as those of the procedure are."""


class Said(Struct, frozen=True, kw_only=True):
    """What holds of one reference, as far as a change is about it."""

    noted: Noted | None = None
    told: Told | None = None  # of its file


class Entry(Struct, frozen=True, kw_only=True):
    """One change. before, after: by name of the reference."""

    written: str  # date and time, ISO 8601, UTC
    kind: ToldKind
    before: dict[str, Said]
    after: dict[str, Said]
    undoes: int | None = None  # number of the change that this one takes back


class Journal:
    """That of one project.

    home: gives the folder that holds it, and makes it where it is missing.
    """

    def __init__(self, folder: Path, home: Callable[[], Path]) -> None:
        self._folder, self._home = folder, home

    def all(self) -> list[ToldChange]:
        """The newest first; what cannot be read is passed over."""
        found: list[ToldChange] = []
        undone: set[int] = set()
        for path in reversed(self._paths()):
            with suppress(KeyError):
                number = int(path.stem)
                entry = self.entry(number)
                found.append(_summary(number, entry, number in undone))
                if number not in undone and entry.undoes is not None:
                    undone.add(entry.undoes)
        return found

    def entry(self, number: int) -> Entry:
        """Raises KeyError for one that is not there, or cannot be read."""
        try:
            return msgspec.json.decode((self._folder / _name(number)).read_bytes(), type=Entry)
        except (OSError, msgspec.DecodeError, RecursionError) as error:
            raise KeyError(number) from error

    def add(
        self, kind: ToldKind, before: Mapping[str, Said], after: Mapping[str, Said], undoes: int | None = None
    ) -> int:
        """Note a change; returns its number. Raises OSError."""
        home, paths = self._home(), self._paths()
        number = int(paths[-1].stem) + 1 if paths else 1
        written = datetime.now(UTC).isoformat(timespec="seconds")
        entry = Entry(written=written, kind=kind, before=dict(before), after=dict(after), undoes=undoes)
        write_file(home / _name(number), json.dumps(msgspec.to_builtins(entry)))
        for old in paths[: 1 - _KEPT]:
            with suppress(OSError):
                old.unlink()
        return number

    def _paths(self) -> list[Path]:
        """The oldest first."""
        found = [path for path in self._folder.glob("*.json") if path.stem.isdecimal()]
        return sorted(found, key=lambda path: int(path.stem))


def _name(number: int) -> str:
    return f"{number:06d}.json"


def _summary(number: int, entry: Entry, undone: bool) -> ToldChange:
    tags = [(set(_tags(entry.after[name])), set(_tags(said))) for name, said in entry.before.items()]
    return ToldChange(
        number=number,
        written=entry.written,
        kind=entry.kind,
        references=list(entry.before),
        added=_joined(after - before for after, before in tags),
        removed=_joined(before - after for after, before in tags),
        undoes=entry.undoes,
        undone=undone,
    )


def _tags(said: Said) -> list[str]:
    return said.noted.tags if said.noted else []


def _joined(several: Iterable[set[str]]) -> list[str]:
    return sorted(set[str]().union(*several))
