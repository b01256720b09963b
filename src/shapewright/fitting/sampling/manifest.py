"""What a folder of samples lists: ``manifest.csv``, a row for every parameter vector, and ``manifest.samples.json``,
which says what the samples are of."""

from __future__ import annotations

import csv
import hashlib
import io
import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from shapewright.fitting.sampling.likeness import Likeness
from shapewright.fitting.sampling.making import MEASURES, Made
from shapewright.fitting.sampling.shards import Shard
from shapewright.parameters import Parameters
from shapewright.procedures import Procedure, source_digest
from shapewright.runs.folder import RunError, check_free
from shapewright.storage import remove_leftovers, write_file
from shapewright.versions import version_of

MANIFEST, RECORD = "manifest.csv", "manifest.samples.json"
COLUMNS = ("path", *MEASURES, "failure")
"""Columns of a manifest that are no parameters."""
_FORMAT = 1
Record = Mapping[str, Any]
Row = list[str]


def header(names: Iterable[str]) -> Row:
    """The columns, for parameters of these names."""
    return [COLUMNS[0], *names, *COLUMNS[1:]]


def row(sample: Made, path: str) -> Row:
    """One sample's. path: of its file in the folder; empty where there is none."""
    measures = [str(sample.measures.get(name, "")) for name in MEASURES]
    return [path, *map(str, sample.parameters.values()), *measures, str(sample.failure or "")]


def record_of(
    procedure: Procedure,
    files: str,
    seed: int,
    given: Mapping[str, Parameters] | None = None,
    like: Likeness | None = None,
) -> dict[str, Any]:
    """What ``RECORD`` holds. The digest is not that of runs: with another value no older folder could resume."""
    return {
        "format": _FORMAT,
        "procedure": procedure.name,
        "source": hashlib.blake2b(procedure.source.encode(), digest_size=8).hexdigest(),
        "files": files,
        "seed": seed,
        "version": version_of("shapewright"),
        **({} if given is None else {"parameters": source_digest(json.dumps(given))}),
        **({} if like is None else {"like": like.digest}),
    }


def of_shard(record: Record, shard: Shard, count: int, rows: int) -> dict[str, Any]:
    """The record of a shard of ``count`` samples, of which it has ``rows``."""
    return {**record, "shard": str(shard), "count": count, "rows": rows}


def of_all(record: Record) -> dict[str, Any]:
    """The record of all samples, from that of one of their shards."""
    return {key: value for key, value in record.items() if key not in ("shard", "count", "rows")}


def write(folder: Path, columns: Row, rows: Iterable[Row]) -> None:
    """Write the manifest, whole or not at all."""
    table = io.StringIO(newline="")
    csv.writer(table).writerows([columns, *rows])
    write_file(folder / MANIFEST, table.getvalue())


def read(folder: Path) -> tuple[dict[str, Any], list[Row]]:
    """The record of a folder, and the rows of its manifest, the header first. Raises RunError."""
    try:
        record = json.loads((folder / RECORD).read_text(encoding="utf-8"))
        lines = (folder / MANIFEST).read_text(encoding="utf-8") if (folder / MANIFEST).exists() else ""
    except FileNotFoundError as error:
        raise RunError(f"{folder}: no samples here: it holds no {RECORD}") from error
    except ValueError as error:
        raise RunError(f"{folder / RECORD}: cannot be read: {error}") from error
    return record, list(csv.reader(io.StringIO(lines)))


def write_record(folder: Path, record: Record) -> None:
    """Say what the samples in a folder are of."""
    write_file(folder / RECORD, json.dumps(record, indent=1))


def resume(folder: Path, record: Record, columns: Row, vectors: Sequence[Parameters]) -> list[Row]:
    """The rows of the manifest that a folder has already; a new folder is begun.

    Raises RunError when there is something else in it.
    """
    if not (folder / RECORD).exists():
        check_free(folder)
        folder.mkdir(parents=True, exist_ok=True)
        write_record(folder, record)
        write(folder, columns, [])
    remove_leftovers(folder, age=0.0)
    begun, rows = read(folder)
    if begun != record:
        differing = ", ".join(key for key in {**record, **begun} if begun.get(key) != record.get(key))
        raise RunError(f"{folder}: there are samples of another kind here (other {differing}); name another folder")
    rows = rows[1:][: len(vectors)]
    for listed, vector in zip(rows, vectors, strict=False):
        if listed[1 : 1 + len(vector)] != [str(value) for value in vector.values()]:
            raise RunError(f"{folder}: its samples are not the first of these {len(vectors)}; name another folder")
    return rows
