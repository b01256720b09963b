"""What changed between two iterations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from shapewright.runs.folder import read_record

if TYPE_CHECKING:
    from shapewright.runs.iteration import Iteration

Run: TypeAlias = "Iteration | str | Path | Mapping[str, Any]"  # an iteration, the folder of its run, or its record


@dataclass(frozen=True)
class Move:
    """A reference that both iterations hold."""

    name: str  # of the reference
    before: float | None  # its distance in the earlier iteration, None without a replica
    after: float | None  # its distance in the later iteration, None without a replica


@dataclass(frozen=True)
class Comparison:
    """Changes from an earlier iteration to a later one; every reference is counted once at most."""

    gained: tuple[Move, ...]  # references that became compatible
    lost: tuple[Move, ...]  # references that are compatible no more
    closer: tuple[Move, ...]  # nearer by more than the tolerance, on the same side of the threshold
    further: tuple[Move, ...]  # further away by more than the tolerance, on the same side of the threshold
    added: tuple[str, ...]  # names that only the later iteration holds
    removed: tuple[str, ...]  # names that only the earlier iteration holds


def compare(before: Run, after: Run, tolerance: float = 0.02) -> Comparison:
    """Match the references of two iterations by name. Moves are in order of their new distance, names as recorded.

    before, after: iterations, the folders of their runs, or their records. tolerance: a distance; smaller moves do not
    count. Raises RunError for a folder without a run.
    """
    then, now = ({reference["name"]: reference for reference in _record(run)["references"]} for run in (before, after))
    moves: dict[str, list[Move]] = {"gained": [], "lost": [], "closer": [], "further": []}
    for name in now.keys() & then.keys():
        old, new = then[name]["distance"], now[name]["distance"]
        if now[name]["compatible"] != then[name]["compatible"]:
            kind = "gained" if now[name]["compatible"] else "lost"
        elif _far(new) < _far(old) - tolerance:
            kind = "closer"
        elif _far(new) > _far(old) + tolerance:
            kind = "further"
        else:
            continue
        moves[kind].append(Move(name, old, new))
    for some in moves.values():
        some.sort(key=lambda move: (_far(move.after), move.name))
    return Comparison(
        **{kind: tuple(some) for kind, some in moves.items()},
        added=tuple(name for name in now if name not in then),
        removed=tuple(name for name in then if name not in now),
    )


def _record(run: Run) -> Mapping[str, Any]:
    if isinstance(run, str | Path):
        return read_record(Path(run).expanduser())
    return run if isinstance(run, Mapping) else run.record


def _far(distance: float | None) -> float:
    return float("inf") if distance is None else distance
