"""What changed between the records of two iterations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

Record = Mapping[str, Any]


@dataclass(frozen=True)
class Move:
    """A reference that both iterations hold, and its distance in either; None where it had no replica."""

    name: str
    before: float | None
    after: float | None


@dataclass(frozen=True)
class Comparison:
    """Changes from the previous iteration to this one; every reference is counted once at most.

    gained, lost: became compatible, ceased to be. closer, further: stayed on their side of the threshold, but moved by
    more than the tolerance. added, removed: names that only this, or only the previous, iteration holds.
    """

    gained: tuple[Move, ...]
    lost: tuple[Move, ...]
    closer: tuple[Move, ...]
    further: tuple[Move, ...]
    added: tuple[str, ...]
    removed: tuple[str, ...]


def compare(record: Record, previous: Record, tolerance: float = 0.02) -> Comparison:
    """Match the references of two records by name. Moves are in order of their new distance, names as recorded."""
    now = {reference["name"]: reference for reference in record["references"]}
    then = {reference["name"]: reference for reference in previous["references"]}
    moves: dict[str, list[Move]] = {"gained": [], "lost": [], "closer": [], "further": []}
    for name in now.keys() & then.keys():
        before, after = then[name]["distance"], now[name]["distance"]
        if now[name]["compatible"] != then[name]["compatible"]:
            kind = "gained" if now[name]["compatible"] else "lost"
        elif _far(after) < _far(before) - tolerance:
            kind = "closer"
        elif _far(after) > _far(before) + tolerance:
            kind = "further"
        else:
            continue
        moves[kind].append(Move(name, before, after))
    ordered = {
        kind: tuple(sorted(some, key=lambda move: (_far(move.after), move.name))) for kind, some in moves.items()
    }
    return Comparison(
        **ordered,
        added=tuple(name for name in now if name not in then),
        removed=tuple(name for name in then if name not in now),
    )


def _far(distance: float | None) -> float:
    return float("inf") if distance is None else distance
