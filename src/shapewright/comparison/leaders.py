"""Groups of many shapes that look alike, without the distance of every pair."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from shapewright.comparison.grouping import CUT, Group, group
from shapewright.shapes import Floats
from shapewright.threads import in_threads

Between = Callable[[Sequence[int], Sequence[int]], Floats]
"""Distances (N, M) of shapes with these numbers to those with the others."""

LARGE = 1000
"""Shapes above which leaders save time: all pairs of 1,000 take 10 s of CPU, at 21 us each (docs/benchmarks.md)."""
LEADERS = 150
"""With as many, the groups of 600 random tables are those of all pairs (docs/benchmarks.md)."""
_SURE = 1.02
"""Of the limit: pairs whose bound lies beyond are not measured. Above 1, since light field distances break the triangle
inequality at times."""


def group_by_leaders(
    names: Sequence[str],
    between: Between,
    cut: float = CUT,
    absolute: bool = False,
    most: int = LEADERS,
    threads: int | None = None,
) -> tuple[Group, ...]:
    """The groups of ``grouping.group``, without the distances of pairs that are surely too far apart for one group.

    Leaders are chosen one by one, each the shape furthest from those before (Gonzalez 1985, "Clustering to minimize the
    maximum intercluster distance"). The distances of two shapes to a leader differ by at most the distance between the
    two. This bound leaves few pairs to measure: those that may lie within the cut. most: leaders. threads: that call
    ``between``, all cores by default.
    """
    if len(names) < 2:
        return tuple(Group(name, (name,)) for name in names)
    to_leaders = _lead(len(names), between, most)
    limit = cut if absolute else cut * float(to_leaders.max())
    distances = np.zeros((len(names), len(names)))

    def fill_row(i: int) -> None:
        row = np.abs(to_leaders[i + 1 :] - to_leaders[i]).max(axis=1)
        near = np.flatnonzero(row <= _SURE * limit)
        if len(near):
            row[near] = between([i], (i + 1 + near).tolist())[0]
        distances[i, i + 1 :] = distances[i + 1 :, i] = row

    in_threads(fill_row, range(len(names) - 1), threads)
    return group(names, distances, limit, absolute=True)


def _lead(count: int, between: Between, most: int) -> Floats:
    """Distances (N, L) of all shapes to leaders, of which no two are the same."""
    columns: list[Floats] = []
    gap, furthest = np.full(count, np.inf), 0
    while len(columns) < min(most, count) and gap[furthest] > 0.0:
        columns.append(between([furthest], range(count))[0])
        gap = np.minimum(gap, columns[-1])
        furthest = int(gap.argmax())
    return np.stack(columns, axis=1)
