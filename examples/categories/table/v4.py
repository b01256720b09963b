"""Tables, version 4: for the eye. Thin tops, flush legs, sleds and boxes; panels as thick as pedestals; no drawers."""

import math
from typing import Annotated, Literal

from shapewright import Range, When, procedure
from shapewright.modelling.grammar import Grammar
from shapewright.modelling.solids import extrude, turned_leg

# Sizes are sampled where most tables are.
HEIGHTS = (0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.76, 0.84, 0.94, 1.05, 1.2, 1.5, 2.0)
THICKNESSES = (0.012, 0.018, 0.025, 0.033, 0.045, 0.06, 0.08, 0.1, 0.12)
OVERHANGS = (0.0, 0.01, 0.02, 0.035, 0.05, 0.08, 0.12, 0.16, 0.2, 0.25)
SECTIONS = (0.015, 0.022, 0.03, 0.04, 0.05, 0.06, 0.075, 0.09, 0.11, 0.14, 0.18, 0.24, 0.32)
APRONS = (0.02, 0.04, 0.07, 0.11, 0.16, 0.22, 0.3, 0.4, 0.55, 0.75)
SPLAYS = (0.0, 0.01, 0.02, 0.1, 0.2, 0.35)
BAR = 0.035  # how high shelves and bars are, and how thick bars

rules = Grammar()


# A top, and what it stands on


@rules.rule("table")
def top_and_base(box, thickness, overhang, oval, base):
    below, top = box.split("y", ..., min(thickness, 0.6 * box.height))
    yield (top.round() if oval else top).label("top")
    if base in ("panels", "sled", "trestle"):  # which reach to the front and to the back
        along, across = overhang, 0.25 * overhang
    elif base in ("column", "star"):
        along = across = 1.5 * overhang
    else:  # corners under an oval top are those of the largest rectangle inside it, or a little closer
        inside = 0.15 if oval else 0.0
        along = across = inside + overhang * (1 - 2 * inside)
    yield below.inset(x=along * box.width, z=across * box.depth).tag("base")


# Bases


@rules.rule("base", when=lambda p: p.base == "box")
def closed_box(box):
    yield box.label("box")


@rules.rule("base", when=lambda p: p.base == "column")
def column_on_plate(box, leg, oval):
    plate, column = box.split("y", min(0.6 * leg, 0.4 * box.height), ...)
    column = column.sub((min(1.5 * leg, 0.6 * box.width), None, min(1.5 * leg, 0.6 * box.depth)))
    yield (plate.round() if oval else plate).label("foot")
    yield (column.round() if oval else column).label("column")


@rules.rule("base", when=lambda p: p.base == "star")
def column_on_feet(box, leg, feet):
    thick = min(1.5 * leg, 0.25 * box.width, 0.25 * box.depth)
    yield box.sub((thick, None, thick)).inset(y=(0.12 * box.height, 0)).fill(turned_leg).label("column")
    yield box.sub((None, 0.4 * box.height, None), anchor=(0.5, 0, 0.5)).fill(arched_feet, count=feet).label("foot")


def arched_feet(size, count):
    """Feet around a middle, arched bars that reach the ellipse of width and depth."""
    width, height, depth = size
    outline = [(0, 1), (0, 0.6), (0.25, 0.5), (0.55, 0.2), (0.88, 0), (1, 0), (1, 0.12), (0.6, 0.5), (0.25, 0.9)]
    foot = extrude([(x / 2, height * (y - 0.5)) for x, y in outline], 0.07).rotate(-90, "x")
    return foot.polar_array(count).rotate(45 if count == 4 else 90).scale((width, 1, depth))


@rules.rule("base", when=lambda p: p.base == "trestle")
def trestles(box, leg):
    yield from (end.tag("trestle") for end in box.ends("x", section(box, leg)[0]))
    yield box.inset(x=0.3 * section(box, leg)[0]).tag("behind")


@rules.rule("trestle")
def post_on_foot(box, leg):
    foot, post, head = box.split("y", min(leg, 0.25 * box.height), ..., min(leg, 0.1 * box.height))
    yield foot.label("foot")
    yield post.sub((None, None, min(1.5 * leg, 0.4 * box.depth))).label("legs")
    yield head.inset(z=0.1 * box.depth).label("legs")


@rules.rule("base", when=lambda p: p.base == "panels")
def panels(box, leg):
    thickness = section(box, leg)[0]
    yield from (end.label("panels") for end in box.ends("x", thickness))
    yield box.inset(x=0.5 * thickness).tag("behind")
    yield box.inset(x=0.5 * thickness, z=0.04 * box.depth).tag("below")


@rules.rule("base", when=lambda p: p.base == "sled")
def sled(box, leg, splay):
    width, _ = section(box, leg)
    yield from (splayed(end, splay, 0.0).tag("runner and legs") for end in box.ends("x", width))
    yield inner(box, leg).tag("below")


@rules.rule("runner and legs")
def runner_and_legs(box, leg):
    runner, above = box.split("y", min(leg, 0.3 * box.height), ...)
    yield runner.label("runners")
    yield from (post.label("legs") for post in above.ends("z", min(leg, 0.45 * box.depth)))


@rules.rule("base")
def four_legs(box, leg, splay):
    yield from (splayed(corner, splay, splay).label("legs") for corner in box.corners(section(box, leg)))
    yield inner(box, leg).tag("between")


def splayed(part, across, along):
    """A part that faces outwards, its foot moved out by so much of its height."""
    foot = across * part.height, 0, along * part.height
    return part.path((0, 0, 0), foot, axis="-y") if across > 0 else part


def section(box, leg):
    """Width and depth of legs that leave room between them."""
    return min(leg, 0.45 * box.width), min(leg, 0.45 * box.depth)


def inner(box, leg):
    """The room of a frame between legs, which stand out from it a little."""
    width, depth = section(box, leg)
    return box.inset(x=0.2 * width, z=0.2 * depth)


# What is between legs, panels or runners


@rules.rule("behind", when=lambda p: p.back)
def back(box, level, base):
    hanging = 0.1 * box.height if base == "trestle" else 0.0
    board = box.inset(y=(level * box.height, hanging))
    yield board.sub((None, None, 0.04 * box.depth), anchor=(0.5, 1, 0.2)).label("back")


@rules.rule("behind")
def no_back(box):
    return []


@rules.rule("between")
def apron(box, apron):
    below, board = box.split("y", ..., apron * box.height)
    yield board.label("apron")
    yield below.tag("below")


@rules.rule("below", when=lambda p: p.tiered)
def one_tier(box, level):
    yield box.inset(y=(level * box.height, 0)).split("y", min(BAR, 0.2 * box.height), ...)[0].tag("tier")


@rules.rule("below")
def nothing(box):
    return []


@rules.rule("tier", when=lambda p: p.base != "legs" or p.tier == "shelf")
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


def on_legs(p):
    return p.base == "legs"


def room_for_tier(p):
    return p.height > 0.26 and p.base in ("legs", "panels", "sled")


def room_for_back(p):
    return p.base in ("trestle", "panels")


def may_splay(p):
    return p.base in ("legs", "sled") and not p.tiered


def has_level(p):
    return (room_for_tier(p) and p.tiered) or (room_for_back(p) and p.back)


@procedure
def table(
    height: Annotated[float, Range(0.15, 2.0, steps=HEIGHTS)] = 0.7,  # width is 1
    depth: Annotated[float, Range(0.28, 1.0)] = 0.6,
    thickness: Annotated[float, Range(0.012, 0.12, steps=THICKNESSES)] = 0.03,
    overhang: Annotated[float, Range(0.0, 0.25, steps=OVERHANGS)] = 0.02,  # of width and depth
    leg: Annotated[float, Range(0.015, 0.32, steps=SECTIONS, when=lambda p: p.base != "box")] = 0.05,
    splay: Annotated[float, Range(0.0, 0.4, steps=SPLAYS, when=may_splay)] = 0.0,  # of the height below the top
    apron: Annotated[float, Range(0.02, 0.75, steps=APRONS, when=on_legs)] = 0.11,  # of the height below the top
    level: Annotated[float, Range(0.0, 0.75, when=has_level)] = 0.2,
    feet: Annotated[int, Range(3, 4, when=lambda p: p.base == "star")] = 4,
    tiered: Annotated[bool, When(room_for_tier)] = False,
    oval: Annotated[bool, When(lambda p: p.base in ("legs", "column", "star"))] = False,
    back: Annotated[bool, When(room_for_back)] = False,
    base: Literal["legs", "panels", "sled", "trestle", "box", "column", "star"] = "legs",
    tier: Annotated[Literal["shelf", "rails", "cross"], When(lambda p: on_legs(p) and p.tiered)] = "shelf",
):
    """A table one unit wide; other lengths are in that unit unless they say of what they are a part."""
    return rules.derive((1, height, depth), **locals())
