"""Groups of many shapes that look alike, without the distance of every pair."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from shapewright.comparison.grouping import CUT, Group, group
from shapewright.shapes import Floats, Ints
from shapewright.threads import in_threads

Between = Callable[[Sequence[int], Sequence[int]], Floats]
"""Distances (N, M) of shapes with these numbers to those with the others."""

LARGE = 1000
"""Shapes above which leaders save time: all pairs of 1,000 take 10 s of CPU, at 21 us each (docs/benchmarks.md)."""
LEADERS = 150
"""With as many, the groups of 600 random tables are those of all pairs (docs/benchmarks.md)."""
MANY = 4000
"""Shapes of which the distances of all pairs are held, 128 MB: of more some are grouped, and the others join them."""
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
    many: int = MANY,
) -> tuple[Group, ...]:
    """The groups of ``grouping.group``, without the distances of pairs that are surely too far apart for one group.

    Leaders are chosen one by one, each the shape furthest from those before (Gonzalez 1985, "Clustering to minimize the
    maximum intercluster distance"). The distances of two shapes to a leader differ by at most the distance between the
    two. This bound leaves few pairs to measure: those that may lie within the cut. most: leaders. threads: that call
    ``between``, all cores by default.

    Of more than ``many`` shapes some, drawn at random, are grouped. Each other one joins the group whose
    representative is nearest, where it lies no further than the members do, or than half of the cut. What joins none is
    grouped in the same way. So a group may be wider than the cut, up to twice; memory grows with the number of shapes.
    """
    if len(names) < 2:
        return tuple(Group(name, (name,)) for name in names)
    to_leaders = _lead(len(names), between, most)
    limit = cut if absolute else cut * float(to_leaders.max())
    left, found = np.random.default_rng(0).permutation(len(names)) if len(names) > many else np.arange(len(names)), []
    while len(left):
        some, left = np.sort(left[:many]), left[many:]
        distances = _distances(some, to_leaders, between, limit, threads)
        groups = group([str(i) for i in some], distances, limit, absolute=True)
        rows = [[int(member) for member in each.members] for each in groups]
        if len(left):
            place = {int(row): at for at, row in enumerate(some)}
            widths = np.array([max(distances[place[each[0]], [place[row] for row in each]]) for each in rows])
            joined = _joined(
                left, [each[0] for each in rows], np.maximum(widths, limit / 2.0), to_leaders, between, threads
            )
            for row, number in zip(left.tolist(), joined, strict=True):
                if number is not None:
                    rows[number].append(row)
            left = left[[number is None for number in joined]]
        found += [Group(names[each[0]], tuple(names[row] for row in each)) for each in rows]
    return tuple(sorted(found, key=lambda each: (-len(each), each.representative)))


def _distances(some: Ints, to_leaders: Floats, between: Between, limit: float, threads: int | None) -> Floats:
    """(K, K) of some shapes; of pairs that are surely further apart than the limit the bound."""
    led, distances = to_leaders[some], np.zeros((len(some), len(some)))

    def fill_row(i: int) -> None:
        row = np.abs(led[i + 1 :] - led[i]).max(axis=1)
        near = np.flatnonzero(row <= _SURE * limit)
        if len(near):
            row[near] = between([int(some[i])], some[i + 1 + near].tolist())[0]
        distances[i, i + 1 :] = distances[i + 1 :, i] = row

    in_threads(fill_row, range(len(some) - 1), threads)
    return distances


def _joined(
    rows: Ints, centres: Sequence[int], widths: Floats, to_leaders: Floats, between: Between, threads: int | None
) -> list[int | None]:
    """For each of the rows the number of the nearest centre that is within that one's width; None where none is."""
    led = to_leaders[centres]

    def nearest(row: int) -> int | None:
        bounds = np.abs(led - to_leaders[row]).max(axis=1)
        best, least = None, np.inf
        for number in np.argsort(bounds, kind="stable"):
            if bounds[number] > _SURE * min(least, widths.max()):
                break
            if bounds[number] <= _SURE * widths[number]:
                apart = float(between([row], [centres[number]])[0, 0])
                if apart <= widths[number] and apart < least:
                    best, least = int(number), apart
        return best

    return in_threads(nearest, rows.tolist(), threads)


def _lead(count: int, between: Between, most: int) -> Floats:
    """Distances (N, L) of all shapes to leaders, of which no two are the same."""
    columns: list[Floats] = []
    gap, furthest = np.full(count, np.inf), 0
    while len(columns) < min(most, count) and gap[furthest] > 0.0:
        columns.append(between([furthest], range(count))[0])
        gap = np.minimum(gap, columns[-1])
        furthest = int(gap.argmax())
    return np.stack(columns, axis=1)
