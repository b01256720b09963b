"""What two surfaces' differences say about the parts of a shape: one is missing, one too many, or of another form."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from shapewright.feedback.surfaces.areas import Areas
from shapewright.feedback.surfaces.residuals import Region, Residuals, pieces
from shapewright.shapes import Floats

PartCause: TypeAlias = Literal["missing part", "surplus part", "wrong form"]

# Where nothing else is said, chosen on seed 0 of benchmarks/causes.py.
_APART = 0.06  # mean distance from the replica at which a region is a part of its own, not the same part's other form
_WHOLE = 0.6  # share of a part that has to be too much for the part to be
_ALIKE = 1.6  # ratio of the sides of two boxes up to which they are the same part in two places
_EQUAL = 1.25  # of sides and of shares, up to which two regions are one part wherever they are
_SLACK = 0.03  # added to sides before they are compared
_NEARBY = 0.15  # how far apart the middles of such boxes may be, where both are smaller
_LESSER = 0.25  # of a surplus part where something is unexplained: it stands in for that
_MINOR = 0.3  # of the weightiest difference: below it is left out


@dataclass(frozen=True, eq=False)
class Difference:
    """What is different in one way, over all regions where it is."""

    kind: PartCause
    regions: tuple[Region, ...]  # the weightiest first; none where the difference is in small detail all over
    weight: float  # share of the surface times distance


def differences(residuals: Residuals | Areas) -> tuple[Difference, ...]:
    """What is different in the parts of a shape, the weightiest first; at least one, also where nothing stands out.

    A drawing has no parts: what of the replica lies as far apart as a missing part is too much.
    """
    if isinstance(residuals, Residuals):
        whole = _whole_parts(residuals)
    else:
        whole = {id(region) for region in residuals.of("surplus") if region.distance > _APART}
    moved = {id(region) for pair in moved_pairs(residuals) for region in pair}
    sorted_out: dict[PartCause, list[Region]] = {"missing part": [], "surplus part": [], "wrong form": []}
    for region in residuals:
        if id(region) in moved:
            kind: PartCause = "wrong form"
        elif region.side == "unexplained":
            kind = "missing part" if region.distance > _APART else "wrong form"
        else:
            kind = "surplus part" if id(region) in whole else "wrong form"
        sorted_out[kind].append(region)
    weights = {kind: sum(region.weight for region in regions) for kind, regions in sorted_out.items()}
    most = max(weights.values())
    if most == 0.0:
        return (Difference("wrong form", (), 0.0),)
    unexplained = sum(region.weight for region in residuals.of("unexplained"))
    kept = [kind for kind in weights if weights[kind] >= _MINOR * most]
    weights["surplus part"] *= 1.0 if unexplained < _MINOR * most else _LESSER
    kinds = sorted(kept, key=lambda kind: -weights[kind])
    return tuple(Difference(kind, _weightiest(sorted_out[kind]), weights[kind]) for kind in kinds)


def _weightiest(regions: list[Region]) -> tuple[Region, ...]:
    return tuple(sorted(regions, key=lambda region: -region.weight))


def _whole_parts(residuals: Residuals) -> set[int]:
    """Surplus regions (ids) that hold most of a connected part of the replica."""
    parts = pieces(residuals.replica, residuals.mesh)
    rows_of = [np.flatnonzero(parts == part) for part in range(parts.max(initial=-1) + 1)]
    surplus = residuals.of("surplus")
    return {id(region) for region in surplus if any(np.isin(rows, region.rows).mean() > _WHOLE for rows in rows_of)}


def moved_pairs(residuals: Residuals | Areas) -> list[tuple[Region, Region]]:
    """Missing and surplus regions that are the same part in two places: like boxes, not far from each other."""
    pairs = []
    free = list(residuals.of("surplus"))
    for missing in residuals.of("unexplained"):
        for surplus in free:
            gap = float(np.linalg.norm(missing.box.centre - surplus.box.centre))
            near = gap < max(missing.box.size.max(), _NEARBY) and _alike(missing.box.size, surplus.box.size)
            if near or _same(missing, surplus):
                pairs.append((missing, surplus))
                free.remove(surplus)
                break
    return pairs


def _same(missing: Region, surplus: Region) -> bool:
    """Whether two regions are so alike that they are one part, however far apart."""
    sides = (missing.box.size + _SLACK) / (surplus.box.size + _SLACK), missing.share / surplus.share
    ratios = [*sides[0], sides[1]]
    return surplus.label is not None and max(*ratios, *(1.0 / ratio for ratio in ratios)) < _EQUAL


def _alike(a: Floats, b: Floats) -> bool:
    ratio = (np.sort(a) + _SLACK) / (np.sort(b) + _SLACK)
    return bool(np.maximum(ratio, 1.0 / ratio).max() < _ALIKE)
