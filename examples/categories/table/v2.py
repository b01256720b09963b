"""Tables, version 2: besides legs, panels, trestles, a pedestal or a chest under the top; an apron and a shelf."""

from typing import Annotated, Literal

from shapewright import Range, When, procedure
from shapewright.modelling.grammar import Grammar

rules = Grammar()


# A top, and what it stands on


@rules.rule("table")
def top_and_base(box, thickness, overhang, oval, base):
    below, top = box.split("y", ..., thickness)
    yield (top.round() if oval else top).label("top")
    # Corners under an oval top are those of the largest rectangle inside it, or a little closer.
    inside = 0.16 if oval and base in ("legs", "panels", "trestle") else 0.0
    margin = inside + overhang * (1 - 2 * inside)
    yield below.inset(x=margin * box.width, z=margin * box.depth).tag("base")


# Bases


@rules.rule("base", when=lambda p: p.base == "chest")
def chest(box, oval):
    yield (box.round() if oval else box).label("chest")


@rules.rule("base", when=lambda p: p.base == "pedestal")
def column_on_plate(box, leg, oval):
    plate, column = box.split("y", 0.05 * box.height, ...)
    column = column.sub((leg, None, leg))
    yield (plate.round() if oval else plate).label("foot")
    yield (column.round() if oval else column).label("column")


@rules.rule("base", when=lambda p: p.base == "trestle")
def trestles(box, leg):
    yield from (end.tag("trestle") for end in box.ends("x", section(box, leg)[0]))


@rules.rule("trestle")
def post_on_foot(box, leg):
    foot, post, head = box.split("y", min(leg, 0.15 * box.height), ..., min(leg, 0.1 * box.height))
    yield foot.label("foot")
    yield post.sub((None, None, min(1.5 * leg, 0.4 * box.depth))).label("legs")
    yield head.inset(z=0.1 * box.depth).label("legs")


@rules.rule("base", when=lambda p: p.base == "panels")
def panels(box, leg):
    yield from (end.label("panels") for end in box.ends("x", 0.5 * leg))
    yield box.inset(x=0.1 * leg, z=0.02 * box.depth).tag("between")


@rules.rule("base")
def four_legs(box, leg):
    width, depth = section(box, leg)
    yield from (corner.label("legs") for corner in box.corners((width, depth)))
    yield box.inset(x=0.3 * width, z=0.3 * depth).tag("between")


def section(box, leg):
    """Width and depth of legs that leave room between them."""
    return min(leg, 0.45 * box.width), min(leg, 0.45 * box.depth)


# What is between legs, or panels


@rules.rule("between")
def apron(box, apron):
    below, board = box.split("y", ..., apron * box.height)
    if apron > 0:
        yield board.label("apron")
    yield below.tag("below")


@rules.rule("below", when=lambda p: p.shelf)
def shelf(box, level):
    yield box.inset(y=(level * box.height, 0)).split("y", min(0.03, 0.2 * box.height))[0].label("shelf")


@rules.rule("below")
def nothing(box):
    return []


def frames(p):
    return p.base in ("legs", "panels")


@procedure
def table(
    height: Annotated[float, Range(0.15, 1.8)] = 0.7,  # width is 1
    depth: Annotated[float, Range(0.28, 1.0)] = 0.6,
    thickness: Annotated[float, Range(0.012, 0.12)] = 0.03,
    overhang: Annotated[float, Range(0.0, 0.35)] = 0.03,  # of width and depth
    leg: Annotated[float, Range(0.015, 0.24, when=lambda p: p.base != "chest")] = 0.05,
    apron: Annotated[float, Range(0.0, 0.5, when=frames)] = 0.1,  # of the height below the top
    level: Annotated[float, Range(0.0, 0.6, when=lambda p: frames(p) and p.shelf)] = 0.3,
    oval: bool = False,
    shelf: Annotated[bool, When(frames)] = False,
    base: Literal["legs", "panels", "trestle", "pedestal", "chest"] = "legs",
):
    """A table one unit wide; other lengths are in that unit unless they say of what they are a part."""
    return rules.derive((1, height, depth), **locals())
