"""How many copies stand in a row: of a part of the replica, and of the reference in the same place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapewright.feedback.remarks.part_boxes import Part
from shapewright.feedback.surfaces.residuals import Residuals
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.shapes import Floats

# Chosen by hand on backs of chairs, shelves and fences.
_FEWEST, _MOST = 2, 40  # pieces of a row
_ALIGNED = 0.03  # difference of sizes and places across the row
_EVEN = 0.35  # of the mean step, by which steps may differ
_ACROSS = 0.6  # of the row's box, across it, that is looked at: rails above and below join slats
_CELL = 0.008  # along the row; of surfaces with 4,000 points, in which slats have no holes
_HOLES = 2  # cells between points of one piece


@dataclass(frozen=True)
class Count:
    """A row of copies of which the reference has more or fewer."""

    label: str  # of the replica's part
    reference: int  # how many the reference has
    replica: int  # how many the replica has

    @property
    def words(self) -> str:
        return f"the reference has {self.reference} {self.label}, the replica {self.replica}"


def counts(residuals: Residuals, parts: Sequence[Part]) -> tuple[Count, ...]:
    """Parts that stand in a row, and of which the reference has another number at the same place."""
    found = []
    for part in parts:
        axis = _row(part.pieces)
        if axis is None:
            continue
        own = _runs(residuals.replica, part.bounds, axis)
        theirs = _runs(residuals.reference, part.bounds, axis)
        if own == len(part.pieces) != theirs and theirs >= 1:
            found.append(Count(part.label, theirs, own))
    return tuple(found)


def _row(pieces: Floats) -> int | None:
    """The axis along which boxes (K, 2, 3) of one size stand in a row with even steps."""
    if not _FEWEST < len(pieces) <= _MOST:
        return None
    sizes, centres = pieces[:, 1] - pieces[:, 0], pieces.mean(axis=1)
    if np.ptp(sizes, axis=0).max() > _ALIGNED:
        return None
    spread = np.ptp(centres, axis=0)
    axis = int(spread.argmax())
    steps = np.diff(np.sort(centres[:, axis]))
    across = np.delete(spread, axis).max()
    even = np.ptp(steps) < _EVEN * steps.mean()
    return axis if across < _ALIGNED and even and steps.min() > sizes[:, axis].max() else None


def _runs(surface: VisibleSurface, bounds: Floats, axis: int) -> int:
    """How many pieces of a surface one passes along an axis through the middle of a box (2, 3)."""
    middle, half = bounds.mean(axis=0), np.ptp(bounds, axis=0) / 2.0
    half = np.where(np.arange(3) == axis, half + _ALIGNED, np.maximum(_ACROSS * half, _ALIGNED))
    inside = (np.abs(surface.points - middle) < half).all(axis=1) & surface.visible
    cells = np.unique((surface.points[inside, axis] / _CELL).astype(int))
    return int((np.diff(cells) > _HOLES).sum()) + 1 if len(cells) else 0
