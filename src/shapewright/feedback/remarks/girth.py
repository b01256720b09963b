"""How wide a shape is at some height, where reference and replica differ in that."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapewright.feedback.surfaces.residuals import Residuals
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.shapes import Floats

_DIFFERENT = 1.15  # ratio of two widths from which they are told
_APART = 0.04  # and their difference, in units of the largest extent: what a region holds at least
_INNER = 0.25  # of a band, at both its ends, that is left out: what lies above and below is other
_LEAST = 12  # points that tell a width
_TAILS = 0.02  # of the points, at each end, that do not count


@dataclass(frozen=True)
class Girth:
    """The width of both shapes at one height."""

    along: str  # "wide" or "deep"
    reference: float  # in units of the reference's largest extent
    replica: float  # the same
    height: float  # where, as a part of the reference's height, 0 to 1

    @property
    def words(self) -> str:
        """Such as "the reference is 0.30 wide at 70 % of the height, the replica 0.52"."""
        at = f"{self.height:.0%}".replace("%", " %")
        return (
            f"the reference is {self.reference:.2f} {self.along} at {at} of the height, the replica {self.replica:.2f}"
        )


def girth(residuals: Residuals, bounds: Floats, whole: Floats) -> Girth | None:
    """Both shapes' width or depth at the height of a box (2, 3), the one that differs more; None where neither does.

    whole: bounds (2, 3) of the reference.
    """
    low, high = bounds[:, 1]
    band = low + _INNER * (high - low), high - _INNER * (high - low)
    found = []
    for axis, word in ((0, "wide"), (2, "deep")):
        theirs, ours = (_width(surface, band, axis) for surface in (residuals.reference, residuals.replica))
        if theirs and ours and max(theirs / ours, ours / theirs) > _DIFFERENT and abs(theirs - ours) > _APART:
            height = (float(np.mean(band)) - whole[0, 1]) / max(float(np.ptp(whole[:, 1])), 1e-9)
            found.append(Girth(word, theirs, ours, float(np.clip(height, 0.0, 1.0))))
    return max(found, key=lambda one: max(one.reference / one.replica, one.replica / one.reference), default=None)


def _width(surface: VisibleSurface, band: tuple[float, float], axis: int) -> float | None:
    height = surface.points[:, 1]
    places = surface.points[surface.visible & (height >= band[0]) & (height <= band[1]), axis]
    return float(np.ptp(np.quantile(places, [_TAILS, 1.0 - _TAILS]))) if len(places) >= _LEAST else None
