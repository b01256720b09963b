"""What two surfaces' differences say about the parts of a shape: one is missing, one too many, or of another form."""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np

from shapewright.feedback.case import Cause
from shapewright.feedback.surfaces.areas import Areas
from shapewright.feedback.surfaces.residuals import Region, Residuals, pieces
from shapewright.shapes import Floats

PartCause: TypeAlias = Literal["missing part", "surplus part", "wrong form"]

# Where nothing else is said, chosen on seed 0 of benchmarks/causes.py.
_APART = 0.06  # mean distance from the replica at which a region is a part of its own, not the same part's other form
_WHOLE = 0.6  # share of a part that has to be too much for the part to be
_ALIKE = 1.6  # ratio of the sides of two boxes up to which they are the same part in two places
_SLACK = 0.03  # added to sides before they are compared
_NEARBY = 0.15  # how far apart the middles of such boxes may be, where both are smaller
_LESSER = 0.5  # of a surplus part where something is unexplained: it stands in for that
_MINOR = 0.3  # of the weightiest difference: below it is left out


def part_causes(residuals: Residuals | Areas) -> tuple[Cause, ...]:
    """What is different in the parts of a shape, the weightiest first; at least one, also where nothing stands out.

    A drawing has no parts: what of the replica lies as far apart as a missing part is too much.
    """
    if isinstance(residuals, Residuals):
        whole = _whole_parts(residuals)
    else:
        whole = {id(region) for region in residuals.of("surplus") if region.distance > _APART}
    moved = _moved(residuals)
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
        text = f"no part of the {residuals.measured} stands out; the difference is in small detail all over"
        return (Cause("wrong form", text, {"regions": 0, "share": 0.0}),)
    unexplained = sum(region.weight for region in residuals.of("unexplained"))
    weights["surplus part"] *= 1.0 if unexplained < _MINOR * most else _LESSER
    kinds = [kind for kind in sorted(weights, key=lambda kind: -weights[kind]) if weights[kind] >= _MINOR * most]
    return tuple(_cause(kind, sorted_out[kind], weights[kind], residuals) for kind in kinds)


def _whole_parts(residuals: Residuals) -> set[int]:
    """Surplus regions (ids) that hold most of a connected part of the replica."""
    parts = pieces(residuals.replica, residuals.mesh)
    rows_of = [np.flatnonzero(parts == part) for part in range(parts.max(initial=-1) + 1)]
    surplus = residuals.of("surplus")
    return {id(region) for region in surplus if any(np.isin(rows, region.rows).mean() > _WHOLE for rows in rows_of)}


def _moved(residuals: Residuals | Areas) -> set[int]:
    """Regions (ids) of both sides that are the same part in two places: like boxes, not far from each other."""
    ids: set[int] = set()
    free = list(residuals.of("surplus"))
    for missing in residuals.of("unexplained"):
        for surplus in free:
            gap = float(np.linalg.norm(missing.box.centre - surplus.box.centre))
            if gap < max(missing.box.size.max(), _NEARBY) and _alike(missing.box.size, surplus.box.size):
                ids |= {id(missing), id(surplus)}
                free.remove(surplus)
                break
    return ids


def _alike(a: Floats, b: Floats) -> bool:
    ratio = (np.sort(a) + _SLACK) / (np.sort(b) + _SLACK)
    return bool(np.maximum(ratio, 1.0 / ratio).max() < _ALIKE)


def _cause(kind: PartCause, regions: list[Region], weight: float, residuals: Residuals | Areas) -> Cause:
    share = {side: sum(r.share for r in regions if r.side == side) for side in ("unexplained", "surplus")}
    chief, of = max(regions, key=lambda region: region.weight), residuals.measured
    near = f" near {chief.label}" if chief.label else ""
    size = " x ".join(f"{side:.2f}" for side in chief.box.size[: residuals.dimensions])
    more = f" and {len(regions) - 1} more" if len(regions) > 1 else ""
    match kind:
        case "missing part":
            text = f"a part is missing{near}: {size}{more}, {share['unexplained']:.0%} of the reference's {of}"
        case "surplus part":
            what = chief.label or "a part"
            text = f"{what} is too much: {size}{more}, {share['surplus']:.0%} of the replica's {of}"
        case "wrong form":
            shares = " and ".join(f"{value:.0%} of the {of} {side}" for side, value in share.items() if value > 0.0)
            text = f"another form{' of ' + chief.label if chief.label else ''}: {size}{more}, {shares}"
    evidence = {
        "regions": len(regions),
        "label": chief.label,
        "rule": chief.rule,
        "centre": chief.box.centre.round(4).tolist(),
        "size": chief.box.size.round(4).tolist(),
        "unexplained": round(share["unexplained"], 4),
        "surplus": round(share["surplus"], 4),
        "weight": round(weight, 5),
    }
    return Cause(kind, text, evidence, chief.label, weight)
