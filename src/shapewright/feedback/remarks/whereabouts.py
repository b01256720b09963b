"""Where a piece of a surface is, as an author says it: by the parts of the replica, and by height."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from shapewright.feedback.remarks.part_boxes import Part
from shapewright.shapes import Floats

Relation = Literal[
    "above", "below", "in front of", "behind", "left of", "right of", "between", "inside", "around", "at", "nowhere"
]
_SIDES: tuple[tuple[Relation, Relation], ...] = (
    ("left of", "right of"),
    ("below", "above"),
    ("behind", "in front of"),
)
"""Of the axes X, Y and Z: as one sees a shape whose front looks at one."""
# In units of the reference's largest extent, chosen by hand on lamps, chairs and tables.
_SLACK = 0.03  # by which boxes of neighbours may overlap
_NEAR = 0.08  # between a piece and both parts that it stands between
_LOOSE = 0.02  # that the words "at" cost, where another part says it better


@dataclass(frozen=True)
class Whereabouts:
    """Where something is."""

    relation: Relation  # to the parts; "nowhere" where the replica has none
    parts: tuple[str, ...]  # labels of the replica: one, or the two that it is between, or none
    low: float  # where it begins, as a part of the reference's height, 0 to 1
    high: float  # where it ends

    @property
    def words(self) -> str:
        """Such as "above seat, at 40 to 95 % of the height"."""
        low, high = round(100 * self.low), round(100 * self.high)
        tall = f"at {low} to {high} % of the height" if high > low + 1 else f"at {low} % of the height"
        return f"{self.relation} {' and '.join(self.parts)}, {tall}" if self.parts else tall


def whereabouts(bounds: Floats, parts: Sequence[Part], whole: Floats) -> Whereabouts:
    """Where a box (2, 3) stands among the parts of a replica laid over its reference.

    whole: bounds (2, 3) of the reference.
    """
    low, high = ((float(bounds[i, 1]) - whole[0, 1]) / max(whole[1, 1] - whole[0, 1], 1e-9) for i in (0, 1))
    low, high = (float(np.clip(place, 0.0, 1.0)) for place in (low, high))
    if not parts:
        return Whereabouts("nowhere", (), low, high)
    found = [(*_relation(bounds, part), part) for part in parts]
    cost, relation, part = min(found, key=lambda each: (each[0], np.prod(np.ptp(each[2].bounds, axis=0))))
    for axis, (before, behind) in enumerate(_SIDES):
        if relation in (before, behind):
            opposite = behind if relation == before else before
            others = [each for each in found if each[1] == opposite and max(each[0], cost) < _NEAR]
            if others:
                pair = sorted([part, min(others, key=lambda each: each[0])[2]], key=lambda p: float(p.bounds[0, axis]))
                return Whereabouts("between", (pair[0].label, pair[1].label), low, high)
    return Whereabouts(relation, (part.label,), low, high)


def _relation(bounds: Floats, part: Part) -> tuple[float, Relation]:
    """How far a box is from a part, and how it stands to it."""
    own = part.bounds
    gaps = np.maximum(bounds[0] - own[1], own[0] - bounds[1])
    away = float(np.linalg.norm(np.maximum(gaps, 0.0)))
    axis = int(gaps.argmax())
    if gaps[axis] > -_SLACK and gaps[axis] > -0.5 * float(np.ptp(bounds[:, axis])):
        return away, _SIDES[axis][int(bounds[:, axis].sum() > own[:, axis].sum())]
    if (bounds[0] > own[0] - _SLACK).all() and (bounds[1] < own[1] + _SLACK).all():
        middle = bounds.mean(axis=0)
        held = ((part.pieces[:, 0] < middle) & (part.pieces[:, 1] > middle)).all(axis=1).any()
        return 0.0, "between" if len(part.pieces) > 1 and not held else "inside"
    flat = [0, 2]
    if (bounds[0, flat] < own[0, flat] + _SLACK).all() and (bounds[1, flat] > own[1, flat] - _SLACK).all():
        return 0.0, "around"
    return _LOOSE, "at"
