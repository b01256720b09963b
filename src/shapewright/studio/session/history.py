"""The runs of a project, and what changed between two of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from shapewright.runs.changes import Move as RunMove
from shapewright.runs.changes import compare
from shapewright.runs.difference import difference
from shapewright.runs.folder import EXPLANATION, RECORD, RunError, read_record
from shapewright.runs.helpers import text_in
from shapewright.runs.result import grade_in, judge_in
from shapewright.studio.session.board import counted
from shapewright.studio.session.standard import Standard
from shapewright.studio.wire.values import Slug, message_of
from shapewright.studio.wire.work import Comparison, DiffLine, Move, Run

Address = Callable[[Path], str | None]


def summaries(folders: list[Path], current: str | None) -> list[Run]:
    """The runs of all folders that hold one that can be read."""
    readable = []
    for folder in folders:
        try:
            stamp = (folder / RECORD).stat().st_mtime_ns
            explained = (folder / EXPLANATION).is_file()
            readable.append(replace(_summary(folder, stamp), explained=explained, current=folder.name == current))
        except (OSError, RunError):
            continue
    return readable


@lru_cache(maxsize=512)
def _summary(folder: Path, stamp: int) -> Run:
    record = read_record(folder)
    return Run(
        run=folder.name,
        created=record["created"],
        references=len(record["references"]),
        judge=judge_in(record),
        counts=counted((grade_in(entry), entry["compatible"]) for entry in record["references"]),
        groups=len(record["groups"]),
        digest=record["procedure"]["digest"],
        procedure=record["procedure"]["name"],
        seconds=sum(record["seconds"].values()),
        explained=False,
        current=False,
    )


def source_of(run: Path) -> str:
    """The procedure that a run was made with; empty where the run has none."""
    path = text_in(run)
    inside = path.is_file() and path.resolve().parent == run.resolve()
    return path.read_text(encoding="utf-8") if inside else ""


def comparison(
    before: Path, after: Path, runs: Mapping[str, Run], slugs: Mapping[str, Slug], address: Address
) -> Comparison:
    """Two runs side by side.

    runs: summaries by name.
    slugs: by name of the reference.
    address: of a picture's file.
    """
    old, new = read_record(before), read_record(after)
    changes = compare(old, new)
    thens = {entry["name"]: entry for entry in old["references"]}
    nows = {entry["name"]: entry for entry in new["references"]}
    standards = [Standard.of_run(record).by(changes.judge) for record in (old, new)]

    def picture(folder: Path, entry: Mapping[str, Any], side: str) -> str | None:
        return address(folder / "thumbnails" / f"{entry['slug']}.{side}.png")

    def judged(name: str) -> dict[str, Any]:
        fields: dict[str, Any] = {}
        for when, entry, standard in zip(("before", "after"), (thens[name], nows[name]), standards, strict=True):
            paper = changes.judge == "paper"
            grade = standard.grade(None, entry["compatible"]) if paper else grade_in(entry)
            fields[f"grade_{when}"] = grade
            fields[f"colour_{when}"] = standard.colour(grade, entry.get("fidelity"), entry["distance"])
        return fields

    def pictured(moves: Iterable[RunMove]) -> list[Move]:
        return [
            message_of(
                Move,
                move,
                slug=slugs.get(move.name),
                reference=picture(after, nows[move.name], "reference"),
                replica_before=picture(before, thens[move.name], "replica"),
                replica_after=picture(after, nows[move.name], "replica"),
                **judged(move.name),
            )
            for move in moves
        ]

    moved = {kind: pictured(getattr(changes, kind)) for kind in ("gained", "lost", "closer", "further")}
    return Comparison(
        before=runs[before.name],
        after=runs[after.name],
        judge=changes.judge,
        **moved,
        same=len(nows.keys() & thens.keys()) - sum(map(len, moved.values())),
        added=list(changes.added),
        removed=list(changes.removed),
        diff=[DiffLine(**vars(line)) for line in difference(source_of(before), source_of(after))],
    )
