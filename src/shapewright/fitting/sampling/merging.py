"""Joining shards into the one folder that would have been written without them."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from shapewright.fitting.sampling import manifest, parquet
from shapewright.fitting.sampling.manifest import COLUMNS, Record, Row
from shapewright.fitting.sampling.packing import join_tars
from shapewright.fitting.sampling.shards import Shard
from shapewright.runs.folder import RunError, new_folder


@dataclass(frozen=True)
class _Part:
    """One shard on disk."""

    folder: Path
    shard: Shard
    record: Record
    columns: Row
    rows: list[Row]


def merge(folders: Sequence[Path], out: Path) -> int:
    """Join folders of shards into a new folder, whole or not at all; returns how many samples it lists.

    The new folder is to the bit what one command without ``--shard`` writes, the manifest in Parquet included if all
    shards have it. The shards stay as they are: their files are linked where the disk can do that, else copied. Raises
    RunError when one is missing, unfinished, twice there or of other samples, and when ``out`` holds something already.
    """
    parts = _ordered([_part(folder) for folder in folders])
    if tabled := all((part.folder / parquet.PARQUET).is_file() for part in parts):
        parquet.check_installed()
    with new_folder(out) as whole:
        for name, places in _files(parts).items():
            if len(places) == 1:
                _link(places[0], whole / name)
            else:
                join_tars(places, whole / name)
        rows = [row for part in parts for row in part.rows]
        manifest.write_record(whole, manifest.of_all(parts[0].record))
        manifest.write(whole, parts[0].columns, rows)
        if tabled:
            parquet.write(whole, parquet.types_in(parts[0].folder))
    return len(rows)


def _part(folder: Path) -> _Part:
    record, (columns, *rows) = manifest.read(folder)
    if "shard" not in record:
        raise RunError(f"{folder}: it holds all samples of its command, and is no shard: nothing is to be joined")
    shard = Shard.parse(record["shard"])
    if len(rows) < record["rows"]:
        raise RunError(
            f"{folder}: shard {shard} is not finished: {len(rows)} of {record['rows']} samples are there; "
            "repeat its command to go on"
        )
    return _Part(folder, shard, record, columns, rows)


def _ordered(parts: list[_Part]) -> list[_Part]:
    """The shards in order. Raises RunError when they are not those of one command, each once."""
    if not parts:
        raise RunError("no shards are named")
    first = parts[0]
    for part in parts[1:]:
        expected, found = _common(first), _common(part)
        if differing := [key for key in {**expected, **found} if expected.get(key) != found.get(key)]:
            what = ", ".join(f"{key}: {found.get(key)}, not {expected.get(key)}" for key in differing)
            raise RunError(f"{part.folder}: its samples are not those of {first.folder} ({what})")
    by_number: dict[int, _Part] = {}
    for part in parts:
        if (other := by_number.get(part.shard.number)) is not None:
            raise RunError(f"{part.folder}: shard {part.shard} is there twice: {other.folder} holds it as well")
        by_number[part.shard.number] = part
    numbers = range(1, first.shard.of + 1)
    if missing := [number for number in numbers if number not in by_number]:
        some = ", ".join(f"{number}/{first.shard.of}" for number in missing[:10])
        raise RunError(f"{len(missing)} of {first.shard.of} shards are missing: {some}{' ...' * (len(missing) > 10)}")
    return [by_number[number] for number in numbers]


def _common(part: _Part) -> dict[str, object]:
    """What all shards of the same samples have alike."""
    return {**manifest.of_all(part.record), "count": part.record["count"], "shards": part.shard.of}


def _files(parts: Sequence[_Part]) -> dict[str, list[Path]]:
    """Where each file of the new folder comes from; a tar that shards share has several places."""
    places: dict[str, list[Path]] = {}
    for part in parts:
        for name in dict.fromkeys(_named(part.rows)):
            path = part.folder / name
            if not path.is_file():
                raise RunError(f"{path}: no such file, though {manifest.MANIFEST} lists it; write this shard anew")
            places.setdefault(name, []).append(path)
    return places


def _named(rows: Sequence[Row]) -> Iterator[str]:
    return (row[COLUMNS.index("path")].partition("/")[0] for row in rows if row[COLUMNS.index("path")])


def _link(source: Path, target: Path) -> None:
    """The same file at another path; a copy of it where the disk has no links."""
    with suppress(OSError):
        os.link(source, target)
        return
    shutil.copyfile(source, target)
