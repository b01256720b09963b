"""Groups of very many shapes that look alike, without the distance of every pair."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from shapewright.comparison.grouping import CUT, Group, clusters

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Between = Callable[[Sequence[int], Sequence[int]], NDArray[np.float64]]
"""Distances (N, M) of shapes with these numbers to those with the others."""

LARGE = 2000
"""Shapes above which distances of all pairs are not worth their time."""
_SAMPLE = 300
_FINE = 0.1  # of the limit: radius, at first, of the sets that are never taken apart again
_WIDER = 1.25
_BATCH = 128
_JUDGES = 64  # members that the middle of a group is measured from


def group_by_leaders(
    names: Sequence[str],
    between: Between,
    cut: float = CUT,
    absolute: bool = False,
    most: int = 600,
    seed: int = 0,
) -> tuple[Group, ...]:
    """Like ``grouping.group``, from at most ``most`` distances for each shape, and a few more.

    Every shape joins the first leader near to it or becomes one (Hartigan, "Clustering Algorithms", 1975, chapter 3);
    the leaders, a few hundred at most, are merged by complete linkage. So members of a group may be further apart than
    the cut by what their leaders' sets are wide: docs/benchmarks.md has measured bounds.
    """
    if len(names) < 2:
        return tuple(Group(name, (name,)) for name in names)
    rng = np.random.default_rng(seed)
    some = np.sort(rng.choice(len(names), min(_SAMPLE, len(names)), replace=False)).tolist()
    largest = float(between(some, some).max())
    radius = _FINE * (cut if absolute else cut * largest)
    leaders, owner, gap = _lead(len(names), between, radius, most)
    apart = _apart(leaders, owner, gap, between)
    labels = clusters(apart, cut if absolute else cut * max(largest, float(apart.max())))
    of_shape = labels[owner]
    groups = [_group(names, np.flatnonzero(of_shape == label), between, rng) for label in np.unique(labels)]
    return tuple(sorted(groups, key=lambda group: (-len(group), group.representative)))


def _lead(count: int, between: Between, radius: float, most: int) -> tuple[list[int], Ints, Floats]:
    """The leaders, the index among them of each shape's, and its distance to that one.

    With a wider radius where there would be too many leaders.
    """
    while True:
        leaders: list[int] = []
        owner, gap = np.zeros(count, dtype=np.int64), np.zeros(count)
        for start in range(0, count, _BATCH):
            if len(leaders) > max(most, 2):
                break
            batch = list(range(start, min(start + _BATCH, count)))
            nearest = np.full(len(batch), np.inf)
            if leaders:
                distances = between(batch, leaders)
                owner[batch], nearest = distances.argmin(axis=1), distances.min(axis=1)
                gap[batch] = nearest
            alone = [number for number, distance in zip(batch, nearest, strict=True) if distance > radius]
            apart = between(alone, alone) if alone else np.zeros((0, 0))
            new: list[int] = []
            for i, number in enumerate(alone):
                near = min(new, key=lambda other: apart[i, other], default=None)
                if near is not None and apart[i, near] <= radius:
                    owner[number], gap[number] = owner[alone[near]], apart[i, near]
                else:
                    owner[number], gap[number] = len(leaders), 0.0
                    leaders.append(number)
                    new.append(i)
        if len(leaders) <= max(most, 2):
            return leaders, owner, gap
        radius *= _WIDER


def _apart(leaders: list[int], owner: Ints, gap: Floats, between: Between) -> Floats:
    """Distances of the leaders' sets (L, L): the largest among the leader of each and the member furthest from it."""
    furthest = list(leaders)
    for number in np.argsort(gap, kind="stable").tolist():
        furthest[owner[number]] = number
    ends = [*leaders, *furthest]
    apart = between(ends, ends).reshape(2, len(leaders), 2, len(leaders)).max(axis=(0, 2))
    np.fill_diagonal(apart, 0.0)
    return np.asarray(apart)


def _group(names: Sequence[str], rows: Ints, between: Between, rng: np.random.Generator) -> Group:
    """Members nearest to the middle first: by mean distance to some of them."""
    judges = rows if len(rows) <= _JUDGES else np.sort(rng.choice(rows, _JUDGES, replace=False))
    inward = between(rows.tolist(), judges.tolist()).mean(axis=1)
    order = rows[np.lexsort((rows, inward))]
    return Group(names[order[0]], tuple(names[i] for i in order))
