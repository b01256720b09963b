"""Trees, version 6: groves of firs, smaller ones around one. The height of a tree is 1."""

import math
from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.solids import box, cone, ellipse, sphere, sweep, union


def is_fir(p):
    return p.crown == "cones"


def has_branches(p):
    return p.branches > 0 and p.crown == "round"


def branch(start, end, width, size):
    """A bar from the trunk to a crown. size: of the crown."""
    wood = sweep(ellipse(width, width, segments=6), [start, end]).label("branch")
    return wood | sphere(size, at=end, segments=12).label("crown")


def is_palm(p):
    return p.crown == "leaves"


def leaves_of(count, length, width, droop):
    """Leaves that hang down by an angle, all round a hub; each is narrow there. width: of a leaf, of its length."""
    hub = 0.3 * width * length / math.tan(math.pi / count) / 2  # where neighbours meet
    leaf = box((length - 0.8 * hub, 0.04, width * length), at=((length + 0.8 * hub) / 2, 0, 0))
    leaf = leaf.profile(0.3, 1.4, 0.5, axis="x").bend(droop, "x", towards="-y")
    return leaf.polar_array(count) | sphere((2.4 * hub + 0.02, 0.1, 2.4 * hub + 0.02), segments=12)


def in_a_grove(p):
    return is_fir(p) and p.others > 0


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
    crown_depth: Annotated[float, Range(0.2, 1.3, when=lambda p: not is_palm(p))] = 0.6,
    crown_height: Annotated[float, Range(0.2, 0.95)] = 0.5,
    tiers: Annotated[int, Range(1, 6, when=is_fir)] = 3,
    top_tier: Annotated[float, Range(0.3, 0.9, when=is_fir)] = 0.5,
    point: Annotated[float, Range(0.1, 0.7, when=is_fir)] = 0.3,
    lean_x: Annotated[float, Range(-0.4, 0.4)] = 0,  # where the crown is
    lean_z: Annotated[float, Range(-0.4, 0.4)] = 0,
    bow: Annotated[float, Range(-0.5, 1.5)] = 0.5,  # how much of that it has halfway up; .5 is straight
    fork: Annotated[float, Range(0.2, 0.8, when=has_branches)] = 0.4,  # where branches begin, of the way to the crown
    reach: Annotated[float, Range(0.15, 0.6, when=has_branches)] = 0.35,
    ends: Annotated[float, Range(0.4, 0.95, when=has_branches)] = 0.7,  # how high the crowns of branches are
    smaller: Annotated[float, Range(0.4, 1.1, when=has_branches)] = 0.7,  # their size, of the large crown's
    turn: Annotated[float, Range(0, 360, when=has_branches)] = 0,  # of the first branch, from the right
    branches: Annotated[int, Range(0, 2, when=lambda p: p.crown == "round")] = 0,
    leaf_width: Annotated[float, Range(0.15, 0.8, when=is_palm)] = 0.35,  # of its length
    droop: Annotated[float, Range(20, 120, when=is_palm)] = 60,
    leaf_count: Annotated[int, Range(4, 9, when=is_palm)] = 6,
    spread: Annotated[float, Range(0.3, 1.2, when=in_a_grove)] = 0.7,  # from the middle to the others
    other_size: Annotated[float, Range(0.4, 1.1, when=in_a_grove)] = 0.7,
    others: Annotated[int, Range(0, 7, when=is_fir)] = 0,
    crown: Literal["round", "cones", "leaves"] = "round",
):
    middle = 1 - crown_height / 2
    stem = cone((trunk, middle, trunk), at=(0, middle / 2, 0), top=trunk_top, segments=8)
    stem = stem.path((0, 0, 0), (bow * lean_x, 0, bow * lean_z), (lean_x, 0, lean_z)).label("trunk")
    if crown == "round":
        leaves = sphere((crown_width, crown_height, crown_depth), at=(0, middle, 0), segments=12)
    elif crown == "leaves":
        leaves = leaves_of(leaf_count, crown_width / 2, leaf_width, droop).translate((0, middle, 0))
    else:
        leaves = cones(crown_width, crown_depth, crown_height, tiers, top_tier, point)
        leaves = leaves.translate((0, 1 - crown_height, 0))
    for i in range(branches if crown == "round" else 0):
        angle = math.radians(turn + 180 * i)
        along = 2 * (1 - fork) * fork * bow + fork**2  # as the trunk bends
        start = along * lean_x, fork * middle, along * lean_z
        end = start[0] + reach * math.cos(angle), ends * middle, start[2] - reach * math.sin(angle)
        size = smaller * crown_width, smaller * crown_height, smaller * crown_depth
        stem |= branch(start, (end[0], max(end[1], start[1] + 0.05), end[2]), 0.6 * trunk, size)
    one = stem | leaves.translate((lean_x, 0, lean_z)).label("crown")
    if not others or crown != "cones":
        return one
    return one | one.scale(other_size).translate((spread, 0, 0)).polar_array(others)
