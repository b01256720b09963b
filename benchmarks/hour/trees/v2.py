"""Trees, version 2: firs, whose crown is a stack of cones. The height is 1."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.solids import cone, sphere, union


def is_fir(p):
    return p.crown == "cones"


def cones(width, depth, height, tiers, top_tier, point):
    """From y = 0 upwards, the topmost cone narrower by a factor; the lower ones end as wide as ``point`` of theirs."""
    step = height / (tiers + 0.5)
    made = []
    for i in range(tiers):
        part = 1 - (1 - top_tier) * i / max(tiers - 1, 1)
        end = 0 if i == tiers - 1 else point
        at = 0, (i + 0.75) * step, 0
        made.append(cone((part * width, 1.5 * step, part * depth), at=at, top=end, segments=8))
    return union(*made)


@procedure
def tree(
    trunk: Annotated[float, Range(0.03, 0.2)] = 0.08,
    trunk_top: Annotated[float, Range(0.3, 1.0)] = 0.7,  # of its width at the bottom
    crown_width: Annotated[float, Range(0.2, 1.3)] = 0.6,
    crown_depth: Annotated[float, Range(0.2, 1.3)] = 0.6,
    crown_height: Annotated[float, Range(0.2, 0.95)] = 0.5,
    tiers: Annotated[int, Range(1, 6, when=is_fir)] = 3,
    top_tier: Annotated[float, Range(0.3, 0.9, when=is_fir)] = 0.5,
    point: Annotated[float, Range(0.1, 0.7, when=is_fir)] = 0.3,
    crown: Literal["round", "cones"] = "round",
):
    middle = 1 - crown_height / 2
    stem = cone((trunk, middle, trunk), at=(0, middle / 2, 0), top=trunk_top, segments=8).label("trunk")
    if crown == "round":
        leaves = sphere((crown_width, crown_height, crown_depth), at=(0, middle, 0), segments=12)
    else:
        leaves = cones(crown_width, crown_depth, crown_height, tiers, top_tier, point)
        leaves = leaves.translate((0, 1 - crown_height, 0))
    return stem | leaves.label("crown")
