"""Tables, version 3: legs splay and are joined in tiers, columns stand on arched feet, desks have drawers and backs."""

import math
from typing import Annotated, Literal

from shapewright import Range, When, procedure
from shapewright.modelling.grammar import Grammar
from shapewright.modelling.solids import extrude, turned_leg

# Sizes are sampled where most tables are. The least are such that a change of them is seen in 64 pixels.
HEIGHTS = (0.24, 0.28, 0.32, 0.36, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.9, 1.0, 1.15, 1.3, 1.5)
OVERHANGS = (0.015, 0.02, 0.025, 0.035, 0.05, 0.07, 0.09, 0.12, 0.15, 0.18)
SECTIONS = (0.025, 0.035, 0.045, 0.055, 0.065, 0.08, 0.095, 0.11, 0.135, 0.16)
APRONS = (0.05, 0.08, 0.12, 0.16, 0.2, 0.25, 0.3, 0.35)
BAR = 0.035  # how high shelves and bars are, and how thick bars

rules = Grammar()


# A top, and what it stands on


@rules.rule("table")
def top_and_base(box, thickness, overhang, oval, base):
    below, top = box.split("y", ..., thickness)
    yield (top.round() if oval else top).label("top")
    if base in ("column", "star"):
        margin = 1.5 * overhang
    else:  # corners under an oval top are those of the largest rectangle inside it, or a little closer
        inside = 0.15 if oval else 0.0
        margin = inside + overhang * (1 - 2 * inside)
    yield below.inset(x=margin * box.width, z=margin * box.depth).tag("base")


# Bases


@rules.rule("base", when=lambda p: p.base == "column")
def column_on_plate(box, leg, oval):
    plate, column = box.split("y", 0.05 * box.height, ...)
    column = column.sub((1.5 * leg, None, 1.5 * leg))
    yield (plate.round() if oval else plate).label("foot")
    yield (column.round() if oval else column).label("column")


@rules.rule("base", when=lambda p: p.base == "star")
def column_on_feet(box, leg):
    yield box.sub((1.5 * leg, None, 1.5 * leg)).inset(y=(0.12 * box.height, 0)).fill(turned_leg).label("column")
    yield box.sub((None, 0.4 * box.height, None), anchor=(0.5, 0, 0.5)).fill(arched_feet).label("foot")


def arched_feet(size):
    """Four feet around a middle, arched bars that reach the ellipse of width and depth."""
    width, height, depth = size
    outline = [(0, 1), (0, 0.6), (0.25, 0.5), (0.55, 0.2), (0.88, 0), (1, 0), (1, 0.12), (0.6, 0.5), (0.25, 0.9)]
    foot = extrude([(x / 2, height * (y - 0.5)) for x, y in outline], 0.07).rotate(-90, "x")
    return foot.polar_array(4).rotate(45).scale((width, 1, depth))


@rules.rule("base", when=lambda p: p.base == "trestle")
def trestles(box, leg):
    yield from (end.tag("trestle") for end in box.ends("x", section(box, leg)[0]))
    yield box.inset(x=0.3 * leg).tag("behind")


@rules.rule("trestle")
def post_on_foot(box, leg):
    foot, post, head = box.split("y", min(leg, 0.15 * box.height), ..., min(leg, 0.1 * box.height))
    yield foot.label("foot")
    yield post.sub((None, None, min(1.5 * leg, 0.4 * box.depth))).label("legs")
    yield head.inset(z=0.1 * box.depth).label("legs")


@rules.rule("base", when=lambda p: p.base == "panels")
def panels(box, leg):
    thickness = 0.6 * leg
    yield from (end.label("panels") for end in box.ends("x", thickness))
    yield box.inset(x=0.5 * thickness).tag("behind")
    yield box.inset(x=0.5 * thickness, z=0.04 * box.depth).tag("between")


@rules.rule("base", when=lambda p: p.base == "splayed")
def splayed(box, splay):
    spread = 1 + 2 * splay / box.width, 1 + 2 * splay / box.depth
    yield box.taper(spread, "-y").tag("splayed legs")


@rules.rule("splayed legs")
def four_slender_legs(box, leg, splay):
    width, depth = section(box, leg)
    slender = 0.8 / (1 + 2 * splay / box.width), 0.8 / (1 + 2 * splay / box.depth)
    yield from (corner.taper(slender, "-y").label("legs") for corner in box.corners((width, depth)))
    yield box.inset(x=0.5 * width, z=0.5 * depth).tag("between")


@rules.rule("base")
def four_legs(box, leg):
    width, depth = section(box, leg)
    yield from (corner.label("legs") for corner in box.corners((width, depth)))
    yield box.inset(x=0.5 * width, z=0.5 * depth).tag("between")


def section(box, leg):
    """Width and depth of legs that leave room between them."""
    return min(leg, 0.45 * box.width), min(leg, 0.45 * box.depth)


# What is between legs, or panels


@rules.rule("behind", when=lambda p: p.back)
def back(box):
    yield box.sub((None, 0.75 * box.height, 0.04 * box.depth), anchor=(0.5, 1, 0.3)).label("back")


@rules.rule("behind")
def no_back(box):
    return []


@rules.rule("between")
def apron(box, apron, cabinets):
    below, board = box.split("y", ..., apron * box.height)
    yield board.label("apron")
    yield below.tag("below")
    if cabinets == 3:
        yield below.tag("cabinet")
    else:
        yield from (end.tag("cabinet") for end in below.ends("x", 0.28 * box.width)[2 - cabinets :])


@rules.rule("cabinet")
def three_drawers(box):
    box = box.inset(y=(0.06 * box.height, 0))
    yield box.label("cabinet")
    for front in box.face("front").inset(x=0.1 * box.width, y=0.06 * box.height).repeat("y", 3, gap=0.04 * box.height):
        yield front.extrude(0.02).label("drawers")


@rules.rule("below", when=lambda p: p.tiers > 0)
def tiers(box, level, tiers):
    for space in box.inset(y=(level * box.height, 0)).repeat("y", tiers):
        yield space.split("y", BAR)[0].tag("tier")


@rules.rule("below")
def nothing(box):
    return []


@rules.rule("tier", when=lambda p: p.base == "panels" or p.tier == "shelf")
def shelf(box):
    yield box.label("shelf")


@rules.rule("tier", when=lambda p: p.tier == "cross")
def cross(box):
    across, along = box.width - 0.4 * BAR, box.depth - 0.4 * BAR
    for turn in 1, -1:
        bar = box.sub((math.hypot(across, along), None, BAR))
        yield bar.rotate(turn * math.degrees(math.atan2(along, across))).label("stretchers")


@rules.rule("tier")
def rails(box):
    yield from (rail.label("stretchers") for rail in box.rails(BAR))


def four_corners(p):
    return p.base in ("legs", "splayed", "panels")


def room_for_tiers(p):
    return p.height > 0.3 and (p.base == "legs" or (p.base == "panels" and p.cabinets == 0))


def room_for_back(p):
    return p.base == "trestle" or (p.base == "panels" and p.cabinets < 3 and p.tiers == 0)


@procedure
def table(
    height: Annotated[float, Range(0.24, 1.5, steps=HEIGHTS)] = 0.7,  # width is 1
    depth: Annotated[float, Range(0.28, 1.0)] = 0.6,
    thickness: Annotated[float, Range(0.015, 0.1)] = 0.03,
    overhang: Annotated[float, Range(0.015, 0.18, steps=OVERHANGS)] = 0.02,  # of width and depth
    leg: Annotated[float, Range(0.025, 0.16, steps=SECTIONS)] = 0.05,
    splay: Annotated[float, Range(0.04, 0.2, when=lambda p: p.base == "splayed")] = 0.1,
    apron: Annotated[float, Range(0.05, 0.35, steps=APRONS, when=four_corners)] = 0.12,  # of the height below the top
    level: Annotated[float, Range(0.0, 0.45, when=lambda p: room_for_tiers(p) and p.tiers > 0)] = 0.2,
    tiers: Annotated[int, Range(0, 2, when=room_for_tiers)] = 0,
    cabinets: Annotated[int, Range(0, 3, when=lambda p: p.base == "panels")] = 0,
    oval: bool = False,
    back: Annotated[bool, When(room_for_back)] = False,
    base: Literal["legs", "splayed", "panels", "trestle", "column", "star"] = "legs",
    tier: Annotated[Literal["shelf", "rails", "cross"], When(lambda p: p.base == "legs" and p.tiers > 0)] = "shelf",
):
    """A table one unit wide; other lengths are in that unit unless they say of what they are a part."""
    return rules.derive((1, height, depth), **locals())
