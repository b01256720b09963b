"""How a replica differs from its reference in pictures from all sides, in place: as numbers, and as regions."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any, TypeAlias

import numpy as np

from shapewright.judging import pixels
from shapewright.judging.verdict import Region
from shapewright.rendering.surround import AXES, BELOW, ORDERS, PIXELS, Surround
from shapewright.shapes import Floats, Mesh

_DEEP = 0.2  # of the largest extent: depths that differ by more count alike
_MOST = 0.08  # of the largest extent: a surface farther than this from the other counts alike
_NEAR, _FAR = 0.025, 0.06
"""Of the largest extent: a gap beyond the first is more than 2 % of every Range gives, one beyond the second a part."""
_STANDS_OUT = 4.0  # usual gaps beyond which a gap stands out
_BINS = 501  # of gaps up to _MOST, for their median
_JUMP = 0.03  # of the largest extent: a step of depth that is an edge
_AROUND = 2  # pixels within which two edges are one
_THIN = 0.02  # of the largest extent: thinner shapes count as this thick when sides are compared
_WEIGHTS = np.array([1.0] * 5 + [0.25] + [1.0] * 4 + [0.6] * 4)
"""Of the views. People look from above: soups often have no underside, and those labelled by eye were seen so."""
_SIDES = np.where(np.arange(len(PIXELS)) == BELOW, _WEIGHTS, 1.0) * PIXELS  # of a pixel when regions are compared
_ALIKE = 0.02  # difference of depth below which no other pose is tried
_STAYS = 0.45  # share from which on a stretch explains nothing: it takes less than 1e-7 of a fidelity
_LEAST = 0.004  # share of the surface below which a region is left out


Gaps: TypeAlias = tuple[Any, Any]
"""Of the reference and of the replica, (14, S, S): how far each pixel is from the other, 0 where empty."""


@dataclass(frozen=True)
class Differences:
    """What the judge goes by; 0 is equal. Views count by _WEIGHTS."""

    depth: float  # mean difference of depth where either is, 0 to 1; what only one covers counts whole
    worst_depth: float  # of the view in which it is greatest, but for the one from below
    outline: float  # 1 - intersection over union of the silhouettes
    gap: float  # mean distance between the surfaces, in units of the largest extent
    usual_gap: float  # the median of that distance
    missing: float  # side of the largest region of the reference beyond _NEAR: the root of its area in a view
    surplus: float  # the same of the replica
    far_missing: float  # share of the reference's surface beyond _FAR
    far_surplus: float  # share of the replica's surface beyond _FAR
    missing_beside: float  # as ``missing``, of what stands out: beyond _STANDS_OUT usual gaps
    surplus_beside: float  # as ``surplus``, of what stands out
    edges: float  # 1 - F-score of edges within _AROUND pixels
    proportion: float  # logarithm of how much more one side of the bounding box grows than another
    other_pose: float  # logarithm of the depth difference over that in the best of the other poses
    stretch: float  # share of the depth difference that stays when both bounding boxes are made equal; 1 from _STAYS on

    def row(self) -> Floats:
        """(15,): all of them, in their order."""
        return np.array([getattr(self, field.name) for field in fields(self)])


@dataclass(frozen=True, eq=False)
class Look:
    """A normalised mesh as the judge looks at it."""

    mesh: Mesh
    extent: Floats  # (3,): its size
    surround: Surround
    edges: Any  # see ``Surround.edges``

    @classmethod
    def of(cls, mesh: Mesh) -> Look:
        """Raises ValueError for a mesh of no size."""
        normal = mesh.normalised()
        surround = Surround.of(normal)
        return cls(normal, mesh.extent / mesh.extent.max(), surround, surround.edges(_JUMP))

    @property
    def visible(self) -> bool:
        return bool((self.surround.area > 0.0).any())


def compare(reference: Look, replica: Look) -> tuple[Differences, Gaps]:
    """The differences, and how far each pixel of the reference and of the replica is from the other: both visible."""
    ours, theirs = reference.surround, replica.surround
    depth, outline = _views(ours.nearness, theirs.nearness)
    lost, extra = np.empty((2, *ours.nearness.shape), dtype=np.float32)
    pixels.measure_gaps(ours.nearness, theirs.nearness, PIXELS, _MOST, lost)
    pixels.measure_gaps(theirs.nearness, ours.nearness, PIXELS, _MOST, extra)
    bins = np.zeros(_BINS)
    lost_gap, lost_far = pixels.summarise(lost, ours.area, _WEIGHTS, _FAR, _MOST, bins)
    extra_gap, extra_far = pixels.summarise(extra, theirs.area, _WEIGHTS, _FAR, _MOST, bins)
    filled = np.cumsum(bins)
    usual = float(np.searchsorted(filled, filled[-1] / 2.0) * _MOST / (_BINS - 1))
    beside = min(max(_NEAR, _STANDS_OUT * usual), 0.99 * _MOST)
    missing, surplus = _largest(lost, _NEAR), _largest(extra, _NEAR)
    mean = _mean(depth)
    proportion, unequal = _proportion(reference.extent, replica.extent)
    differences = Differences(
        depth=mean,
        worst_depth=float(np.delete(depth, BELOW).max()),
        outline=_mean(outline),
        gap=(lost_gap + extra_gap) / 2.0,
        usual_gap=usual,
        missing=missing,
        surplus=surplus,
        far_missing=lost_far,
        far_surplus=extra_far,
        missing_beside=_largest(lost, beside) if beside > _NEAR else missing,
        surplus_beside=_largest(extra, beside) if beside > _NEAR else surplus,
        edges=_edges(reference.edges, replica.edges),
        proportion=proportion,
        other_pose=_other_pose(reference, replica, mean),
        stretch=_stretch(reference, replica, depth) if unequal else 1.0,
    )
    return differences, (lost, extra)


def regions(reference: Look, replica: Look, gaps: Gaps) -> tuple[tuple[Region, ...], tuple[Region, ...]]:
    """The missing and the surplus regions, the largest first, by the gaps of ``compare``."""
    return _regions(reference.surround, gaps[0]), _regions(replica.surround, gaps[1])


def _mean(of_views: Floats) -> float:
    return float(of_views @ _WEIGHTS / _WEIGHTS.sum())


def _views(ours: Any, theirs: Any) -> tuple[Floats, Floats]:
    """(14,) each: mean difference of depth where either is, and 1 - IoU of the silhouettes."""
    depths, outlines = np.empty((2, len(ours)))
    pixels.compare_depths(ours, theirs, _DEEP, depths, outlines)
    return depths, outlines


def _largest(gaps: Any, beyond: float) -> float:
    """The side of the largest connected region of a view; the view from below counts a quarter."""
    return float(pixels.longest_side(gaps, beyond, _SIDES))


def _edges(ours: Any, theirs: Any) -> float:
    precise, complete = (_shared(a, b) for a, b in ((ours, theirs), (theirs, ours)))
    return 1.0 - 2.0 * precise * complete / max(precise + complete, 1e-9)


def _shared(some: Any, others: Any) -> float:
    """The share of edges that have others beside them."""
    hits = np.empty((len(some), 2))
    pixels.count_beside(some, others, _AROUND, hits)
    beside, count = _WEIGHTS @ hits
    return float(beside / max(count, 1.0))


def _proportion(ours: Floats, theirs: Floats) -> tuple[float, bool]:
    """How unequal the bounding boxes are, and whether that is enough to be told, by more than a thin side."""
    ratios = np.log(np.maximum(ours, _THIN) / np.maximum(theirs, _THIN))
    unequal = float(np.ptp(ratios))
    return unequal, unequal > 0.2 and float(np.abs(ours - theirs).max()) > 0.035


def _other_pose(reference: Look, replica: Look, depth: float) -> float:
    if depth < _ALIKE:
        return 0.0
    pictures = reference.surround.nearness, replica.surround.nearness
    own, other = pixels.pose_depths(*pictures, *ORDERS, _DEEP, _WEIGHTS / _WEIGHTS.sum())
    return math.log((own + 0.01) / (other + 0.01))


def _stretch(reference: Look, replica: Look, depths: Floats) -> float:
    """By the views that differ most first, until enough stays."""
    scale = reference.extent / np.maximum(replica.extent, 1e-6)
    stretched, weighted, stays = replica.mesh.transformed(np.diag(scale)), _WEIGHTS * depths, 0.0
    whole = max(float(weighted.sum()), 1e-6)
    for view in np.argsort(-weighted):
        one = slice(view, view + 1)
        depth, _ = _views(reference.surround.nearness[one], Surround.of(stretched, one).nearness)
        stays += float(_WEIGHTS[view] * depth[0]) / whole
        if stays >= _STAYS:
            return 1.0
    return stays


def _regions(surround: Surround, gaps: Any) -> tuple[Region, ...]:
    """Where the surface is farther than _NEAR from the other, in most of the views that show the place."""
    whole, apart = np.zeros((2, pixels.GRID**3))
    cells, far = pixels.sort_into_cells(surround.nearness, surround.area, gaps, _NEAR, AXES, PIXELS, whole, apart)
    if not len(cells):
        return ()
    numbers = np.zeros(len(whole), dtype=np.int64)
    count = pixels.connect(apart > 0.5 * whole, numbers)
    boxes = np.tile([np.inf] * 3 + [-np.inf] * 3 + [0.0], (count + 1, 1))
    pixels.enclose(numbers[cells], far, boxes)
    boxes[:, 6] /= whole.sum()
    found = [
        Region(max(b - a for a, b in zip(box[:3], box[3:6], strict=True)), tuple(box[:3]), tuple(box[3:6]), box[6])
        for box in boxes[1:].tolist()
        if box[6] >= _LEAST
    ]
    return tuple(sorted(found, key=lambda region: -region.size))
