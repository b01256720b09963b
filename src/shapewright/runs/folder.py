"""Folders of runs on disk: numbered, written whole or not at all, never overwritten."""

from __future__ import annotations

import json
import math
import re
import tempfile
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from functools import lru_cache
from itertools import accumulate
from pathlib import Path
from typing import Any

from shapewright.runs import table
from shapewright.storage import is_free, whole_folder

FORMAT, LARGE_FORMAT = 1, 2
"""Of records; one of a large run has its references in a table beside it."""
RECORD, EXPLANATION = "iteration.json", "explanation.json"
_NUMBER = re.compile(r"\d+")


class RunError(Exception):
    """A run's folder cannot be written or read; the message says why and what to do."""


@contextmanager
def new_folder(folder: Path) -> Iterator[Path]:
    """A hidden folder to write into, which becomes ``folder`` at the end of the block; or vanishes if that fails.

    Raises RunError when ``folder`` holds something already, or the disk cannot be written.
    """
    check_free(folder)
    try:
        with whole_folder(folder) as partial:
            yield partial
    except OSError as error:
        raise RunError(f"{folder}: cannot be written: {error.strerror or error}; nothing was left there") from error


def check_free(folder: Path) -> None:
    """Raise RunError when there is something at ``folder`` already."""
    if not is_free(folder):
        raise RunError(
            f"{folder}: there is something here already, and runs are never overwritten; name another folder"
        )


def check_writable(folder: Path) -> None:
    """Raise RunError when a run could not be written to ``folder``: before an hour of work, not after it."""
    check_free(folder)
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=folder.parent, prefix=f".{folder.name}.") as probe:
            probe.write(bytes(4096))
    except OSError as error:
        raise RunError(f"{folder}: a run cannot be written here: {error.strerror or error}") from error


def runs(root: Path) -> list[Path]:
    """The folders of whole runs under ``root``, oldest first.

    Their numbers decide, and among runs of other names the time that their record says: times of files are those of
    the last copy. A record that cannot be read counts as old as the run before it.
    """
    found = [path.parent for path in root.glob(f"*/{RECORD}") if not path.parent.name.startswith(".")]
    numbered = sorted(
        (folder for folder in found if _NUMBER.fullmatch(folder.name)), key=lambda folder: int(folder.name)
    )
    # A clock may have gone wrong, a number cannot: what has a greater one is not older.
    ages = dict(zip(numbered, accumulate(map(_created, numbered), max), strict=True))
    numbers = {folder: int(folder.name) for folder in numbered}
    return sorted(
        found, key=lambda folder: (ages.get(folder) or _created(folder), numbers.get(folder, math.inf), folder.name)
    )


def _created(folder: Path) -> str:
    try:
        return _created_as_written(folder, (folder / RECORD).stat().st_mtime_ns)
    except OSError:
        return ""


@lru_cache(maxsize=4096)
def _created_as_written(folder: Path, stamp: int) -> str:
    """Date and time in ISO 8601, UTC; empty where the record cannot be read."""
    try:
        return str(read_record(folder)["created"])
    except (RunError, KeyError):
        return ""


def next_run(root: Path) -> Path:
    """The folder of the next numbered run: 001, 002, ... after the greatest number there."""
    taken = [int(path.name) for path in root.glob("*") if _NUMBER.fullmatch(path.name)]
    return root / f"{max(taken, default=0) + 1:03d}"


def previous_run(folder: Path, names: set[str] | None = None) -> Path | None:
    """The newest run beside ``folder`` that is older than it and shares one of the names; None where there is none."""
    beside = runs(folder.parent)
    older = beside[: beside.index(folder)] if folder in beside else beside
    for run in reversed(older):
        theirs = {entry["name"] for entry in read_record(run)["references"]}
        if names is None or names & theirs:
            return run
    return None


def read_record(folder: Path) -> dict[str, Any]:
    """The record of a run's folder. Raises RunError when there is none, or one of an unknown format.

    The references of a large run are read from its table when they are asked for.
    """
    path = folder / RECORD
    try:
        record = read_json(path)
    except FileNotFoundError as error:
        raise RunError(f"{folder}: no run here: it holds no {RECORD}") from error
    except (OSError, ValueError) as error:
        raise RunError(f"{path}: cannot be read: {error}") from error
    if record.get("format") == LARGE_FORMAT:
        try:
            record["references"] = table.entries(folder, record["procedure"]["parameters"])
        except ImportError as error:
            raise RunError(f"{folder}: a large run; it needs pyarrow: pip install 'shapewright[scale]'") from error
        except (OSError, ValueError, KeyError) as error:
            raise RunError(f"{folder / table.TABLE}: cannot be read: {error}") from error
    elif record.get("format") != FORMAT:
        found = record.get("format")
        raise RunError(f"{path} has format {found!r}; this version of shapewright reads formats up to {LARGE_FORMAT}")
    return record


def read_json(path: Path) -> dict[str, Any]:
    """A file of a run; None for a number that is not finite, which browsers refuse. Raises OSError or ValueError."""
    record: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"), parse_constant=lambda _: None)
    return record


def suggested_parameters(run: Path, names: Collection[str]) -> dict[str, list[dict[str, Any]]]:
    """What suggestions for a run found, by the name of the reference: of those whose parameters a procedure has all.

    run: its folder. names: of the procedure's parameters. Empty where the run is not explained.
    """
    try:
        suggestions = read_json(run / EXPLANATION).get("suggestions", [])
    except (OSError, ValueError):
        return {}
    found: dict[str, list[dict[str, Any]]] = {}
    for suggestion in suggestions:
        for name, values in ((suggestion.get("tried") or {}).get("parameters") or {}).items():
            if set(values) <= set(names):
                found.setdefault(name, []).append(values)
    return found
