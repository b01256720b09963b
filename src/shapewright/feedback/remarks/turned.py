"""Parts that stand another way in the reference: upside down, mirrored, turned."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.spatial import cKDTree

from shapewright.feedback.remarks.part_boxes import Part
from shapewright.feedback.surfaces.residuals import Region, Residuals
from shapewright.shapes import Floats

Turn = Literal["upside down", "mirrored", "back to front", "turned by 90 degrees"]
_TURNS: dict[Turn, Floats] = {
    "upside down": np.diag([1.0, -1.0, 1.0]),
    "mirrored": np.diag([-1.0, 1.0, 1.0]),
    "back to front": np.diag([1.0, 1.0, -1.0]),
    "turned by 90 degrees": np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]),
}
# By trial on lamps, chairs and umbrellas.
_POINTS = 240  # of a part and of what is missing near it
_FAR = 0.1  # distances beyond count as this
_NEARBY = 0.2  # around a part's box, in which what is missing may be that part
_CLEARLY = 0.5  # of the distance as it stands, that is left at most
_LEAST = 0.02  # mean distance as it stands, below which nothing is told


@dataclass(frozen=True)
class Turned:
    """A part that stands another way in the reference."""

    label: str
    turn: Turn
    left: float  # of the distance between the two, when it is turned: 0 to 1

    @property
    def words(self) -> str:
        return f"{self.label}: {self.turn} in the reference"


def turned(residuals: Residuals, regions: Sequence[Region], parts: Sequence[Part]) -> tuple[Turned, ...]:
    """The parts of the replica that lie nearer to the reference when they are turned about their middle.

    regions: of both sides, that are another form.
    """
    missing = [region.points for region in regions if region.side == "unexplained"]
    labels = {region.label for region in regions if region.side == "surplus"}
    found = []
    for part in parts:
        if part.label in labels and len(part.points) and missing:
            points = np.concatenate(missing)
            near = (points > part.bounds[0] - _NEARBY).all(axis=1) & (points < part.bounds[1] + _NEARBY).all(axis=1)
            if near.any() and (best := _best(residuals, part, points[near])):
                found.append(best)
    return tuple(found)


def _best(residuals: Residuals, part: Part, missing: Floats) -> Turned | None:
    own, lacks = _some(part.points), _some(missing)
    middle = part.bounds.mean(axis=0)

    def apart(matrix: Floats) -> float:
        places = (own - middle) @ matrix.T + middle
        there = np.minimum(residuals.reference.distance(places), _FAR).mean()
        back = np.minimum(cKDTree(places).query(lacks)[0], _FAR).mean()
        return float(there + back)

    before = apart(np.eye(3))
    left = {turn: apart(matrix) for turn, matrix in _TURNS.items()}
    turn = min(left, key=lambda each: left[each])
    if before < _LEAST or left[turn] > _CLEARLY * before:
        return None
    return Turned(part.label, turn, left[turn] / before)


def _some(points: Floats) -> Floats:
    return points[:: max(1, len(points) // _POINTS)]
