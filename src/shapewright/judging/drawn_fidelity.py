"""The default judge of drawings: the probability that a person calls a replica and its reference the same.

Both are looked at in place: nothing is turned or mirrored. ``benchmarks/judging_drawings.py`` chose and fitted what is
weighed here.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from shapewright.judging.verdict import Evidence, Region
from shapewright.rendering.ink import HALF, coverage
from shapewright.shapes import Drawing, Floats, Shape

PAGE = 160  # pixels along a picture
_PIXEL = 2.0 * HALF / PAGE  # in largest extents, as all lengths
_INK = 0.2  # least share of a pixel that is ink to the other drawing: a line of 0.2 % counts, a gap as narrow does not
_FROM, _FAR = 0.01, 0.02  # ink farther than this from the other's is a region; as far as this it is unexplained
_SLIVER = 5e-4  # area of a region that nobody sees: 1 % of the extent wide, 5 % long
_LEAST = 0.01  # share of its drawing that makes a region worth telling
_KEPT = 0.12  # log ratio up to which proportions may differ; 2 % of every Range keep below 0.10 in nine pairs of ten
_WEIGHTS = np.array([1.0, 2.18, 0.94, -50.0])
_BIAS = -10.94


@dataclass(frozen=True)
class Likeness:
    """What of a pair of drawings is weighed.

    iou: of areas, 0 to 1.
    depth: how far the ink of the deepest region, missing or surplus, is from the other drawing.
    share: of its drawing, the area of the largest region that is unexplained.
    stretch: absolute logarithm of how much wider one is for its height than the other.
    """

    iou: float
    depth: float
    share: float
    stretch: float

    def terms(self) -> Floats:
        """(4,): what the weights are for. A region counts by its logarithm, the more so while it is small."""
        depth, share = -math.log(0.02 + self.depth), -math.log(0.005 + self.share)
        return np.array([self.iou, depth, share, max(0.0, self.stretch - _KEPT)])

    @property
    def value(self) -> float:
        """The probability that a person calls the two the same, 0 to 1."""
        return 1.0 / (1.0 + math.exp(-float(_WEIGHTS @ self.terms()) - _BIAS))


class DrawnFidelity:
    """A reference, described when it is first needed; any thread may ask."""

    def __init__(self, reference: Drawing) -> None:
        self._seen = functools.cache(functools.partial(Seen.of, reference))

    def evidence(self, replica: Shape | None) -> Evidence:
        """What there is to say of a replica; a value of NaN where the two cannot be compared."""
        if not isinstance(replica, Drawing):
            return Evidence(math.nan)
        likeness, *found = beside(self._seen(), Seen.of(replica))
        return Evidence(likeness.value, *(largest_first(regions) for regions in found))

    def likeness(self, replica: Drawing) -> Likeness:
        """The evidence in numbers."""
        return beside(self._seen(), Seen.of(replica))[0]


def beside(ours: Seen, its: Seen) -> tuple[Likeness, list[Region], list[Region]]:
    """The reference beside the replica: in numbers, and the regions that are missing and surplus."""
    common = float(np.minimum(ours.ink, its.ink).sum())
    missing, surplus = ours.without(its), its.without(ours)
    likeness = Likeness(
        iou=common / (ours.area + its.area - common),
        depth=max(missing.depth, surplus.depth),
        share=max(missing.share, surplus.share),
        stretch=abs(ours.proportion - its.proportion),
    )
    return likeness, missing.regions, surplus.regions


def largest_first(regions: Iterable[Region]) -> tuple[Region, ...]:
    return tuple(sorted(regions, key=lambda region: -region.size))


@dataclass(frozen=True)
class _Unexplained:
    depth: float  # 0 where no region is larger than a sliver
    share: float
    regions: list[Region]


class Seen:
    """A drawing, or a silhouette, as a picture."""

    def __init__(self, ink: Floats, proportion: float) -> None:
        """ink: (PAGE, PAGE), the share of each pixel that is covered. proportion: log of the width for the height."""
        self.ink, self.proportion = ink, proportion
        self.area = float(ink.sum())
        solid = ink > min(_INK, float(ink.max()) / 2.0)
        self.away = np.asarray(ndimage.distance_transform_edt(~solid)) * _PIXEL

    @classmethod
    def of(cls, drawing: Drawing) -> Seen:
        (left, bottom), (right, top) = drawing.bounds
        return cls(coverage(drawing, PAGE), math.log((right - left) / (top - bottom)))

    def without(self, other: Seen) -> _Unexplained:
        """The connected pieces of ink that have none of the other drawing's near them."""
        far = (self.ink > 0.05) & (other.away > _FROM)
        labels, count = ndimage.label(far, np.ones((3, 3)))
        if not count:
            return _Unexplained(0.0, 0.0, [])
        numbers, ink, away = labels[far] - 1, self.ink[far], other.away[far]
        areas = np.bincount(numbers, ink, count)
        unexplained = np.bincount(numbers, ink * (away > _FAR), count)
        depths = np.zeros(count)
        np.maximum.at(depths, numbers, away)
        shares = areas / self.area
        boxes = zip(ndimage.find_objects(labels), shares.tolist(), strict=True)
        return _Unexplained(
            float(np.max(depths[areas * _PIXEL**2 >= _SLIVER], initial=0.0)),
            float(unexplained.max()) / self.area,
            [_region(rows, columns, share) for (rows, columns), share in boxes if share >= _LEAST],
        )


def _region(rows: slice, columns: slice, share: float) -> Region:
    left, right = columns.start * _PIXEL - HALF, columns.stop * _PIXEL - HALF
    low, high = HALF - rows.stop * _PIXEL, HALF - rows.start * _PIXEL
    return Region(max(right - left, high - low), (left, low, 0.0), (right, high, 0.0), share)
