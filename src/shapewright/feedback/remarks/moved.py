"""Parts that stand elsewhere in the reference than in the replica."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapewright.feedback.remarks.form import copies_of
from shapewright.feedback.remarks.part_boxes import Part
from shapewright.feedback.remarks.whereabouts import Whereabouts, whereabouts
from shapewright.feedback.surfaces.residuals import Region
from shapewright.shapes import Floats

_WAYS = (("further left", "further right"), ("lower", "higher"), ("further back", "further forward"))
"""Along X, Y and Z."""
_LEAST = 0.04  # of a shift along an axis that is told, in units of the largest extent: FAR of a region


@dataclass(frozen=True)
class Moved:
    """A part of the replica that the reference has in another place."""

    label: str
    shift: tuple[float, float, float]  # from the replica to the reference, in units of the largest extent
    there: Whereabouts  # where it stands in the reference, among the other parts

    @property
    def words(self) -> str:
        """Such as "shade: 0.50 further forward in the reference, in front of base, at 70 to 95 % of the height"."""
        order = np.argsort(-np.abs(self.shift))[:2]
        ways = [
            f"{abs(self.shift[axis]):.2f} {_WAYS[axis][int(self.shift[axis] > 0.0)]}"
            for axis in order
            if abs(self.shift[axis]) >= _LEAST
        ]
        return f"{self.label}: {' and '.join(ways)} in the reference, {self.there.words}"


def moved(
    pairs: Sequence[tuple[Region, Region]], regions: Sequence[Region], parts: Sequence[Part], whole: Floats
) -> tuple[Moved, ...]:
    """The parts that stand elsewhere, the weightiest first, each once.

    pairs: of a missing region and a surplus one that are the same thing in two places. regions: all. whole: bounds
    (2, 3) of the reference.
    """
    found: dict[str, Moved] = {}
    for missing, surplus in sorted(pairs, key=lambda pair: -pair[0].weight):
        shift = missing.box.centre - surplus.box.centre
        if surplus.label in found or np.abs(shift).max() < _LEAST or not _whole(surplus, parts):
            continue
        if len(copies_of(missing, regions)) != len(copies_of(surplus, regions)):
            continue  # a post in place of four legs is none that has moved
        points = missing.points
        others = [part for part in parts if part.label != surplus.label]
        there = whereabouts(np.stack([points.min(axis=0), points.max(axis=0)]), others, whole)
        label = str(surplus.label)
        found[label] = Moved(label, (float(shift[0]), float(shift[1]), float(shift[2])), there)
    return tuple(found.values())


def _whole(surplus: Region, parts: Sequence[Part]) -> bool:
    """Whether a region is about a whole piece of its part: of a piece that is only thicker nothing has moved."""
    low, high = surplus.points.min(axis=0), surplus.points.max(axis=0)
    pieces = [piece for part in parts if part.label == surplus.label for piece in part.pieces]
    return any(max(np.abs(piece[0] - low).max(), np.abs(piece[1] - high).max()) < _LEAST for piece in pieces)
