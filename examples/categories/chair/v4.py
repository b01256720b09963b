"""Chairs, version 4: for the eye. Solid backs stay solid, legs upright; arms have a thickness of their own.

All lengths are parts of the height, 1, unless they say of what they are a part.
"""

from typing import Annotated, Literal

from shapewright import Range, When, procedure
from shapewright.modelling.grammar import Grammar

# Sizes are sampled where most chairs are: a dining chair is half as wide as high, an armchair as wide.
SIDES = (0.33, 0.38, 0.42, 0.46, 0.5, 0.55, 0.6, 0.66, 0.75, 0.85, 1.0, 1.2, 1.4)
SEATS = (0.04, 0.07, 0.1, 0.14, 0.18, 0.24, 0.32, 0.42, 0.55, 0.7, 0.85)
BACKS = (0.02, 0.035, 0.05, 0.065, 0.08, 0.1, 0.13, 0.17, 0.22, 0.28)
SECTIONS = (0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.085, 0.1, 0.14)
OVERHANGS = (0, 0.01, 0.02, 0.04, 0.07, 0.11, 0.17)  # of the seat over legs
CREST = 0.16  # of the back's height, above slats

grammar = Grammar()


@grammar.rule("chair", when=lambda p: p.base == "plinth")
def seat_on_the_floor(box, seat_height):
    seat, above = box.split("y", seat_height, ...)
    yield seat.label("seat")
    yield above.tag("above")


@grammar.rule("chair")
def seat_on_a_base(box, seat_height, seat_thickness, overhang):
    thickness = seat_thickness * seat_height
    below, seat, above = box.split("y", seat_height - thickness, thickness, ...)
    yield below.inset(x=overhang * box.width, z=overhang * box.depth).tag("base")
    yield seat.label("seat")
    yield above.tag("above")


# What the seat stands on


@grammar.rule("base", when=lambda p: p.base == "legs")
def four_legs(box, leg):
    leg = section(box, leg)
    yield from (corner.label("leg") for corner in box.corners(leg))
    room = box.inset(x=0.15 * leg, z=0.15 * leg)  # legs stand out from what joins them a little
    yield room.sub((None, min(0.6 * leg, box.height / 2), None), anchor=(0.5, 0.4, 0.5)).tag("stretchers")


def section(box, leg):
    """Of legs that leave room between them."""
    return min(leg, 0.35 * box.width, 0.35 * box.depth)


@grammar.rule("base", when=lambda p: p.base == "sled")
def sled(box, leg):
    for corner in box.corners(leg):
        yield corner.label("leg")
    for side in box.ends("x", leg):
        yield side.sub((None, min(leg, box.height / 2), None), anchor=(0.5, 0, 0.5)).label("runner")


@grammar.rule("base")
def pedestal(box, leg):
    foot, column = box.split("y", min(1.5 * leg, 0.5 * box.height), ...)
    yield column.sub((leg, None, leg)).label("column")
    yield foot.sub((0.7 * box.width, None, 0.7 * box.depth)).label("foot")


@grammar.rule("stretchers", when=lambda p: p.stretchers == 0)
def no_stretchers(box):
    return []


@grammar.rule("stretchers", when=lambda p: p.stretchers == 1)
def stretchers_at_the_sides(box):
    yield from (side.label("stretcher") for side in box.ends("x", box.height))


@grammar.rule("stretchers")
def stretchers_all_round(box):
    yield from (rail.label("stretcher") for rail in box.rails(box.height))


# Back and arms


@grammar.rule("above")
def back_and_arms(box, back_thickness, lean):
    leaning = (0, 0, 0), (0, 0, -lean * box.height)
    yield box.sub((None, None, back_thickness), anchor=(0.5, 0, 0)).path(*leaning).tag("back")
    yield box.path(*leaning).tag("arms")


@grammar.rule("back", when=lambda p: p.back == "solid")
def panel(box):
    yield box.label("back")


@grammar.rule("back")
def frame(box, leg):
    post = min(max(leg, 0.03), 0.2 * box.width)
    left, middle, right = box.split("x", post, ..., post)
    yield from (left.label("post"), right.label("post"))
    yield middle.tag("filling")


@grammar.rule("filling", when=lambda p: p.back == "rails")
def rails(box, opening, gap, rails):
    bay = (1 - opening) * box.height / (rails - gap)  # a rail and a gap; no gap above the last
    for place in range(rails):
        low = opening * box.height + place * bay
        yield box.split("y", low, (1 - gap) * bay, ...)[1].label("rail")


@grammar.rule("filling")
def slats(box, gap, slats):
    below, crest = box.split("y", ..., CREST * box.height)
    yield crest.label("rail")
    for bay in below.repeat("x", count=slats):
        yield bay.sub(((1 - gap) * bay.width, None, 0.6 * box.depth)).label("slat")


@grammar.rule("arms", when=lambda p: p.arms == "none")
def no_arms(box):
    return []


@grammar.rule("arms", when=lambda p: p.arms == "open")
def open_arms(box, leg, arm_height):
    for side in box.ends("x", leg):
        below, rest, _ = side.split("y", (arm_height - 0.05) * box.height, 0.05 * box.height, ...)
        yield rest.label("arm")
        yield below.sub((None, None, leg), anchor=(0.5, 0.5, 1)).label("arm post")


@grammar.rule("arms")
def solid_arms(box, arm, arm_height):
    for side in box.ends("x", arm * box.width):
        yield side.split("y", arm_height * box.height, ...)[0].label("arm")


def below(p):
    """The height of what the seat stands on."""
    return 0 if p.base == "plinth" else p.seat_height * (1 - p.seat_thickness)


def on_a_base(p):
    return p.base != "plinth"


def has_legs(p):
    """Posts of backs and of arms are as thick as legs."""
    return on_a_base(p) or p.back != "solid" or p.arms == "open"


@procedure
def chair(
    width: Annotated[float, Range(0.3, 1.5, steps=SIDES)] = 0.5,
    depth: Annotated[float, Range(0.3, 1.4, steps=SIDES)] = 0.5,
    seat_height: Annotated[float, Range(0.25, 0.7)] = 0.48,
    seat_thickness: Annotated[float, Range(0.04, 0.85, steps=SEATS, when=on_a_base)] = 0.12,  # of its height
    back_thickness: Annotated[float, Range(0.02, 0.28, steps=BACKS)] = 0.05,
    lean: Annotated[float, Range(0, 0.35)] = 0.1,
    leg: Annotated[float, Range(0.018, 0.14, steps=SECTIONS, when=has_legs)] = 0.05,
    overhang: Annotated[float, Range(0, 0.2, steps=OVERHANGS, when=lambda p: p.base == "legs")] = 0,  # of the sides
    opening: Annotated[float, Range(0, 0.85, when=lambda p: p.back == "rails")] = 0.4,  # of the back, below rails
    gap: Annotated[
        float, Range(0.2, 0.75, when=lambda p: p.back == "slats" or (p.back == "rails" and p.rails > 1))
    ] = 0.5,
    arm: Annotated[float, Range(0.05, 0.28, when=lambda p: p.arms == "solid")] = 0.15,  # of the width
    arm_height: Annotated[float, Range(0.2, 1, when=lambda p: p.arms != "none")] = 0.4,  # of what is above the seat
    rails: Annotated[int, Range(1, 5, when=lambda p: p.back == "rails")] = 2,
    slats: Annotated[int, Range(2, 6, when=lambda p: p.back == "slats")] = 4,
    stretchers: Annotated[int, Range(0, 2, when=lambda p: p.base == "legs" and below(p) > 0.2)] = 0,
    base: Literal["legs", "sled", "pedestal", "plinth"] = "legs",
    back: Annotated[Literal["solid", "rails", "slats"], When(lambda p: p.arms != "solid")] = "solid",
    arms: Literal["none", "open", "solid"] = "none",
):
    """A chair one unit high; a back that leans comes on top of its depth."""
    return grammar.derive((width, 1, depth), **locals())
