"""References of a collection that are the same shape, or nearly the same."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from shapewright.references import Reference
from shapewright.shapes import Bytes, Drawing, Floats, Ints, Mesh, Points, ReferenceShape
from shapewright.survey.likeness import differences, ink

NEAR = 0.006
"""Largest difference of pictures of near-duplicates. Of 543 shapes of furniture, cuboids, vessels, buildings and trees
eight pairs are nearer than this: bottles and pots that differ in their contents, and cuboids of one model that was
listed twice; the next nearest pairs, at .010 and more, are pieces of different makers. Shapes that are stretched by 1 %
lie .005 apart in the middle, rounded to a thousandth of their extent .0003."""
_AT_ONCE = 1000  # pairs that are compared in one step, some 20 ms
_SAME = 1e-4
"""Units of the largest extent: corners nearer than this stand at one place, whatever precision a file has."""


@dataclass(frozen=True)
class Duplicate:
    """A reference that is like one before it.

    Attributes:
        name: its own.
        of: the name of the one before it, which is no duplicate itself.
        is_equal: whether it is the same shape but for its size, place and format; else it only looks nearly the same.
        difference: of small pictures of the two, 0 to 1.
        quarters: quarter turns about the up axis that bring it into the pose of the other.
    """

    name: str
    of: str
    is_equal: bool
    difference: float
    quarters: int

    @property
    def words(self) -> str:
        turned = f", turned by {90 * self.quarters} degrees" if self.quarters else ""
        return f"{'the same as' if self.is_equal else 'nearly the same as'} {self.of}{turned}"


def duplicates(references: Sequence[Reference], seen: Bytes) -> tuple[Duplicate, ...]:
    """The references that are like one before them, in their order. seen: see ``likeness.pictures``."""
    search = sought(references, seen)
    while True:
        try:
            next(search)
        except StopIteration as end:
            found: tuple[Duplicate, ...] = end.value
            return found


def sought(references: Sequence[Reference], seen: Bytes) -> Generator[None, None, tuple[Duplicate, ...]]:
    """The same in steps, for those who have other work between them."""
    pairs = _candidates(ink(seen))
    apart, turns = np.empty(len(pairs)), np.empty(len(pairs), dtype=np.int64)
    for start in range(0, len(pairs), _AT_ONCE):
        some = slice(start, start + _AT_ONCE)
        apart[some], turns[some] = differences(seen, pairs[some, 0], pairs[some, 1])
        yield
    near = np.flatnonzero(apart <= NEAR)
    found: dict[int, Duplicate] = {}
    for k in near[np.lexsort((pairs[near, 0], pairs[near, 1]))]:
        first, second = (int(i) for i in pairs[k])
        known = found.get(second)
        if first in found or (known and known.is_equal):
            continue
        one, other = references[first], references[second]
        quarters = int(turns[k])
        is_equal = equal(one.shape, other.turned(quarters).shape)
        if known is None or is_equal:
            found[second] = Duplicate(other.name, one.name, is_equal, round(float(apart[k]), 5), quarters)
        yield
    return tuple(found[row] for row in sorted(found))


def equal(one: ReferenceShape, other: ReferenceShape) -> bool:
    """Whether two normalised shapes are the same, in whatever order their corners and faces are."""
    if isinstance(one, Drawing) or isinstance(other, Drawing):
        return isinstance(one, Drawing) and isinstance(other, Drawing) and _same_area(one, other)
    first, second = _places(one), _places(other)
    if first.shape[1] != second.shape[1] or len(first) != len(second):
        return False
    return bool(max(_furthest(first, second), _furthest(second, first)) <= _SAME)


def _same_area(one: Drawing, other: Drawing) -> bool:
    apart = one.geometry.symmetric_difference(other.geometry).area
    return bool(apart <= _SAME * one.geometry.area)


def _places(shape: ReferenceShape) -> Floats:
    """Of each triangle its middle and the length of its sides in order (F, 6), of each point its place (N, 3)."""
    if isinstance(shape, Points):
        return shape.positions
    assert isinstance(shape, Mesh)
    corners = shape.triangles
    sides = np.sort(np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2), axis=1)
    return np.column_stack([corners.mean(axis=1), sides])


def _furthest(points: Floats, others: Floats) -> float:
    return float(cKDTree(others).query(points, distance_upper_bound=2.0 * _SAME)[0].max())


def _candidates(sums: Ints) -> Ints:
    """(K, 2): pairs of rows, the lesser first, whose sums differ by so little that their pictures may be near."""
    order = np.argsort(sums, kind="stable")
    ends = np.searchsorted(sums[order], sums[order] * (1.0 + NEAR) / (1.0 - NEAR), side="right")
    pairs = [np.column_stack([np.full(end - i - 1, order[i]), order[i + 1 : end]]) for i, end in enumerate(ends)]
    return np.sort(np.concatenate([np.empty((0, 2), dtype=np.int64), *pairs]), axis=1)
