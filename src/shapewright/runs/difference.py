"""Two texts line by line: what both have, what was removed, what was added."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

CONTEXT = 3
"""Lines around a change that are shown with it, as in unified diffs."""


@dataclass(frozen=True)
class Line:
    """A line of one or both texts."""

    kind: Literal["same", "added", "removed"]
    before: int | None  # its number in the older one, from 1
    after: int | None  # its number in the newer one
    text: str


def difference(before: str, after: str) -> Iterator[Line]:
    """All lines of both texts, those that were removed before those that took their place."""
    old, new = before.splitlines(), after.splitlines()
    for change, i, i_end, j, j_end in difflib.SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if change == "equal":
            for k in range(i_end - i):
                yield Line("same", i + k + 1, j + k + 1, old[i + k])
            continue
        for k in range(i, i_end):
            yield Line("removed", k + 1, None, old[k])
        for k in range(j, j_end):
            yield Line("added", None, k + 1, new[k])


def changed(before: str, after: str) -> list[Line]:
    """The lines that differ, and CONTEXT lines around each."""
    lines = list(difference(before, after))
    places = [i for i, line in enumerate(lines) if line.kind != "same"]
    kept = {i + k for i in places for k in range(-CONTEXT, CONTEXT + 1)}
    return [line for i, line in enumerate(lines) if i in kept]
