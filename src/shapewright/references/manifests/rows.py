"""The lines of a manifest: a CSV table of files, with what is to be done with each."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import cast, get_args

from shapewright.references.errors import CollectionError
from shapewright.references.scans.steps import Kept, kept
from shapewright.settings import DROPPED, Split

_YES = {"yes": True, "true": True, "1": True, "x": True, "no": False, "false": False, "0": False}


@dataclass(frozen=True)
class Switches:
    """What is done with one file alone; None: what is done with all.

    Attributes:
        leave_out: whether it is not fitted.
        drop: what is no part of its shape, as ``Preparing.drop``.
        split: which objects in it are references, as ``Preparing.split``.
        unit: its own, in metres, whatever it states.
        keep: what is left in points, see ``scans.steps``.
    """

    leave_out: bool = False
    drop: str | None = None
    split: Split | None = None
    unit: float | None = None
    keep: tuple[Kept, ...] | None = None


@dataclass(frozen=True)
class Row:
    """A line of a manifest that lists a file.

    Attributes:
        place: the manifest and the number of the line, for messages.
        path: the file, relative to the manifest's folder.
        cells: its cells by column, in small letters; columns that nobody knows among them.
        switches: what is done with the file alone.
    """

    place: str
    path: Path
    cells: Mapping[str, str]
    switches: Switches


def rows_of(manifest: Path) -> Iterator[Row]:
    """The files that a manifest lists. Raises CollectionError, with the line, for what cannot be understood."""
    text = manifest.read_text(encoding="utf-8-sig", errors="replace")
    header, _, _ = text.partition("\n")
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=max(",;\t", key=header.count))
    columns = [cell.strip().lower() for cell in next(rows, [])]
    if "path" not in columns:
        raise CollectionError(f"{manifest} has no column 'path'; its first line has {', '.join(columns) or 'none'}")
    for row in rows:
        cells = {column: cell.strip() for column, cell in zip(columns, row, strict=False)}
        if not any(cells.values()):
            continue
        place = f"{manifest}, line {rows.line_num}"
        if not cells.get("path"):
            raise CollectionError(f"{place}: no path")
        yield Row(place, Path(cells["path"]), cells, _switches(cells, place))


def _switches(cells: Mapping[str, str], place: str) -> Switches:
    drop = cells.get("drop", "").replace(" ", ",").replace("+", ",").lower()
    for word in filter(None, drop.split(",")):
        _among(word, DROPPED, "drop", place)
    try:
        steps = kept(cells["keep"].lower().replace("+", " ").split()) if cells.get("keep") else None
    except CollectionError as error:
        raise CollectionError(f"{place}: {error}") from error
    leave_out, split, unit = (cells.get(column, "").lower() for column in ("leave_out", "split", "unit"))
    return Switches(
        leave_out=bool(leave_out) and _YES[_among(leave_out, tuple(_YES), "leave_out", place)],
        drop=drop or None,
        split=cast("Split", _among(split, get_args(Split), "split", place)) if split else None,
        unit=_metres(unit, place) if unit else None,
        keep=steps,
    )


def _metres(unit: str, place: str) -> float:
    from shapewright.procedures.facts import METRES, Unit  # loads slowly

    return METRES[cast(Unit, _among(unit, tuple(METRES), "unit", place))]


def _among(word: str, known: Sequence[str], column: str, place: str) -> str:
    if word not in known:
        raise CollectionError(f"{place}: {column} is {word!r}; use one of {', '.join(known)}")
    return word
