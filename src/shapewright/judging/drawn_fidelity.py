"""The default judge of drawings: the probability that a person calls a replica and its reference the same.

Both are looked at in place: nothing is turned or mirrored. The numbers here are provisional.
"""

from __future__ import annotations

import functools
import math

import shapely

from shapewright.comparison.pictures import intersection_over_union
from shapewright.judging.verdict import Evidence, Region
from shapewright.shapes import Drawing, Floats, Shape

_LEAST = 0.01  # share of an area that makes a region


class DrawnFidelity:
    """A reference, described when it is first needed; any thread may ask."""

    def __init__(self, reference: Drawing) -> None:
        self._reference = reference
        self._area = functools.cache(lambda: reference.normalised().geometry)

    def evidence(self, replica: Shape | None) -> Evidence:
        """What there is to say of a replica; a value of NaN where the two cannot be compared."""
        if not isinstance(replica, Drawing):
            return Evidence(math.nan)
        area, other = self._area(), replica.normalised().geometry
        value = _logistic(20.0 * (intersection_over_union(self._reference, replica) - 0.8))
        return Evidence(value, _regions(area - other, area.area), _regions(other - area, other.area))


def _regions(difference: shapely.Geometry, area: float) -> tuple[Region, ...]:
    """The connected pieces of a difference, the largest first. area: of the drawing that they belong to."""
    parts = shapely.get_parts(difference)
    shares = shapely.area(parts) / area
    found = [_region(box, share) for box, share in zip(shapely.bounds(parts), shares, strict=True) if share >= _LEAST]
    return tuple(sorted(found, key=lambda region: -region.size))


def _region(box: Floats, share: float) -> Region:
    left, bottom, right, top = (float(end) for end in box)
    low, high = (left, bottom, 0.0), (right, top, 0.0)
    return Region(max(high[0] - low[0], high[1] - low[1]), low, high, float(share))


def _logistic(x: float) -> float:
    return 1.0 / (1.0 + math.exp(-x))
