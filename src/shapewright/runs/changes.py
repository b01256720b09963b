"""What changed between two iterations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from shapewright.runs.folder import read_record
from shapewright.runs.result import grade_in, judge_in
from shapewright.settings import JudgeName

if TYPE_CHECKING:
    from shapewright.runs.iteration import Iteration

Run: TypeAlias = "Iteration | str | Path | Mapping[str, Any]"  # an iteration, the folder of its run, or its record


TOLERANCES: Mapping[JudgeName, float] = {"fidelity": 0.1, "paper": 0.02}
"""Smaller moves do not count: of fidelity, and of the paper's distance."""
_NO_REPLICA = 1e9  # further than any replica


@dataclass(frozen=True)
class Move:
    """A reference that both iterations hold, and its fidelity or its distance, as the comparison's judge has it."""

    name: str  # of the reference
    before: float | None  # in the earlier iteration, None without a replica
    after: float | None  # in the later iteration, None without a replica


@dataclass(frozen=True)
class Comparison:
    """Changes from an earlier iteration to a later one; every reference is counted once at most."""

    judge: JudgeName  # of both; the paper's where they had different ones, and replicated means compatible then
    gained: tuple[Move, ...]  # references that became replicated
    lost: tuple[Move, ...]  # references that are replicated no more
    closer: tuple[Move, ...]  # better by more than the tolerance, and replicated both times or neither time
    further: tuple[Move, ...]  # worse by more than the tolerance, and replicated both times or neither time
    added: tuple[str, ...]  # names that only the later iteration holds
    removed: tuple[str, ...]  # names that only the earlier iteration holds


def compare(before: Run, after: Run, tolerance: float | None = None) -> Comparison:
    """Match the references of two iterations by name. Moves are in order of what they are now, the best first.

    before, after: iterations, the folders of their runs, or their records. tolerance: a fidelity, or a distance by the
    paper's judge; smaller moves do not count; by default 0.1 and 0.02. Raises RunError for a folder without a run.
    """
    records = [_record(run) for run in (before, after)]
    judge: JudgeName = "paper" if any(judge_in(record) == "paper" for record in records) else "fidelity"
    then, now = ({reference["name"]: reference for reference in record["references"]} for record in records)
    least = TOLERANCES[judge] if tolerance is None else tolerance
    moves: dict[str, list[Move]] = {"gained": [], "lost": [], "closer": [], "further": []}
    for name in now.keys() & then.keys():
        (was, old), (is_now, new) = _judged(then[name], judge), _judged(now[name], judge)
        better = _badness(old, judge) - _badness(new, judge)
        if was != is_now:
            kind = "gained" if is_now else "lost"
        elif abs(better) > least:
            kind = "closer" if better > 0 else "further"
        else:
            continue
        moves[kind].append(Move(name, old, new))
    for some in moves.values():
        some.sort(key=lambda move: (_badness(move.after, judge), move.name))
    return Comparison(
        judge,
        **{kind: tuple(some) for kind, some in moves.items()},
        added=tuple(name for name in now if name not in then),
        removed=tuple(name for name in then if name not in now),
    )


def _record(run: Run) -> Mapping[str, Any]:
    if isinstance(run, str | Path):
        return read_record(Path(run).expanduser())
    return run if isinstance(run, Mapping) else run.record


def _judged(entry: Mapping[str, Any], judge: JudgeName) -> tuple[bool, float | None]:
    """Whether a reference of a record is replicated, and its fidelity or distance."""
    if judge == "paper":
        return entry["compatible"], entry["distance"]
    return grade_in(entry) == "replicated", entry["fidelity"]


def _badness(value: float | None, judge: JudgeName) -> float:
    """Less is better: a distance, or a fidelity with the opposite sign; finite without a replica too."""
    if value is None:
        return _NO_REPLICA
    return value if judge == "paper" else -value
