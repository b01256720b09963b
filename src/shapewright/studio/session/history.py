"""The runs of a project: what each found, and what changed between two of them."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from shapewright.judging.paper import Metric
from shapewright.runs.changes import Move, compare
from shapewright.runs.folder import EXPLANATION, RECORD, RunError, read_record
from shapewright.studio.session.board import tint

Address = Callable[[Path], str | None]


def summaries(folders: list[Path], current: str | None) -> list[dict[str, Any]]:
    """The page's ``Run`` of every folder that holds one that can be read."""
    found = []
    for folder in folders:
        try:
            stamp = (folder / RECORD).stat().st_mtime_ns
            explained = (folder / EXPLANATION).is_file()
            found.append({**_summary(folder, stamp), "explained": explained, "current": folder.name == current})
        except (OSError, RunError):
            continue
    return found


@lru_cache(maxsize=512)
def _summary(folder: Path, stamp: int) -> Mapping[str, Any]:
    record = read_record(folder)
    return {
        "run": folder.name,
        "created": record["created"],
        "references": len(record["references"]),
        "compatible": sum(entry["compatible"] for entry in record["references"]),
        "groups": len(record["groups"]),
        "digest": record["procedure"]["digest"],
        "procedure": record["procedure"]["name"],
        "seconds": sum(record["seconds"].values()),
    }


def source_of(run: Path) -> str:
    """The procedure that a run was made with; empty where the run has none."""
    path = run / "procedure.py"
    inside = path.is_file() and path.resolve().parent == run.resolve()
    return path.read_text(encoding="utf-8") if inside else ""


def comparison(before: Path, after: Path, slugs: Mapping[str, str], address: Address) -> dict[str, Any]:
    """The page's ``Comparison`` of two runs, but for the summaries. slugs: by name; address: of a picture's file."""
    old, new = read_record(before), read_record(after)
    found = compare(old, new)
    thens = {entry["name"]: entry for entry in old["references"]}
    nows = {entry["name"]: entry for entry in new["references"]}

    def picture(folder: Path, entry: Mapping[str, Any], side: str) -> str | None:
        return address(folder / "thumbnails" / f"{entry['slug']}.{side}.png")

    def told(move: Move) -> dict[str, Any]:
        then, now = thens[move.name], nows[move.name]
        return {
            "name": move.name,
            "slug": slugs.get(move.name),
            "before": move.before,
            "after": move.after,
            "colour_before": tint(move.before, Metric.of_record(old)),
            "colour_after": tint(move.after, Metric.of_record(new)),
            "reference": picture(after, now, "reference"),
            "replica_before": picture(before, then, "replica"),
            "replica_after": picture(after, now, "replica"),
        }

    kinds = ("gained", "lost", "closer", "further")
    moves = {kind: [told(move) for move in getattr(found, kind)] for kind in kinds}
    return {
        **moves,
        "same": len(nows.keys() & thens.keys()) - sum(map(len, moves.values())),
        "added": list(found.added),
        "removed": list(found.removed),
        "diff": list(difference(source_of(before), source_of(after))),
    }


def difference(before: str, after: str) -> Iterator[dict[str, Any]]:
    """Two texts line by line: what both have, what was removed, what was added; with the numbers of the lines."""
    old, new = before.splitlines(), after.splitlines()
    for _, i, i_end, j, j_end in difflib.SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if old[i:i_end] == new[j:j_end]:
            for k in range(i_end - i):
                yield {"kind": "same", "before": i + k + 1, "after": j + k + 1, "text": old[i + k]}
            continue
        for k in range(i, i_end):
            yield {"kind": "removed", "before": k + 1, "after": None, "text": old[k]}
        for k in range(j, j_end):
            yield {"kind": "added", "before": None, "after": k + 1, "text": new[k]}
