"""Chairs, version 3: five bases, splayed legs, leaning and curved backs. All lengths are parts of the height, 1."""

import math
from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.grammar import Grammar
from shapewright.modelling.solids import extrude

grammar = Grammar()


@grammar.rule("chair", when=lambda p: p.base == "plinth")
def seat_on_the_floor(box, seat_height):
    seat, above = box.split("y", seat_height, ...)
    yield seat.label("seat")
    yield above.tag("above")


@grammar.rule("chair")
def seat_on_a_base(box, seat_height, seat_thickness):
    thickness = seat_thickness * seat_height
    below, seat, above = box.split("y", seat_height - thickness, thickness, ...)
    yield below.tag("base")
    yield seat.label("seat")
    yield above.tag("above")


# What the seat stands on


@grammar.rule("base", when=lambda p: p.base == "legs")
def four_legs(box, leg, splay):
    out = splay * box.height
    for corner in box.corners(leg):
        yield corner.path((0, 0, 0), (out, 0, out), axis="-y").label("leg")
    margin = 0.15 * leg - out / 2
    yield box.inset(x=margin, z=margin).sub((None, min(0.7 * leg, box.height / 2), None)).tag("stretchers")


@grammar.rule("base", when=lambda p: p.base == "sled")
def sled(box, leg):
    for corner in box.corners(leg):
        yield corner.label("leg")
    for side in box.ends("x", leg):
        yield side.sub((None, min(leg, box.height / 2), None), anchor=(0.5, 0, 0.5)).label("runner")


@grammar.rule("base", when=lambda p: p.base == "pedestal")
def pedestal(box, leg):
    yield box.sub((1.5 * leg, None, 1.5 * leg)).round().label("column")
    yield box.sub((0.7 * box.width, 0.04, 0.7 * box.width), anchor=(0.5, 0, 0.5)).round().label("foot")


@grammar.rule("base")
def star(box, leg, feet):
    yield box.sub((1.5 * leg, None, 1.5 * leg)).round().label("column")
    yield box.sub((None, 0.05, box.width), anchor=(0.5, 0, 0.5)).fill(spokes, count=feet).label("foot")


def spokes(size, count):
    """Bars from the middle of the floor outwards, one to the front: an outline in the ground plan, extruded."""
    reach, height, _ = size
    half, corner = 0.025, 0.025 / math.sin(math.pi / count)  # of a bar's width; where neighbouring bars meet
    tip = math.hypot(reach / 2, half), math.atan2(half, reach / 2)
    outline = []
    for turn in (2 * math.pi * (i / count + 0.25) for i in range(count)):
        places = (tip[0], turn - tip[1]), (tip[0], turn + tip[1]), (corner, turn + math.pi / count)
        outline += [(radius * math.cos(angle), radius * math.sin(angle)) for radius, angle in places]
    return extrude(outline, height)


@grammar.rule("stretchers", when=lambda p: p.stretchers == 0)
def no_stretchers(box):
    return []


@grammar.rule("stretchers", when=lambda p: p.stretchers == 3)
def stretchers_all_round(box):
    yield from (rail.label("stretcher") for rail in box.rails(box.height))


@grammar.rule("stretchers")
def stretchers_at_the_sides(box, stretchers):
    yield from (side.label("stretcher") for side in box.ends("x", box.height))
    if stretchers == 2:
        yield box.inset(x=box.height / 2).sub((None, None, box.height)).label("stretcher")


# Back and arms


@grammar.rule("above")
def back_and_arms(box, back_thickness, lean, curve):
    sagitta = curve * min(box.width, box.depth)
    angle = math.degrees(4 * math.atan(2 * sagitta / box.width))
    leaning = (0, 0, 0), (0, 0, -lean * box.height)
    back = box.sub((None, None, back_thickness), anchor=(0.5, 0, 0))
    yield back.bend(angle, "x", towards="z", fixed=0.5).path(*leaning).tag("back")
    yield box.inset(z=(sagitta, 0)).path(*leaning).tag("arms")


@grammar.rule("back", when=lambda p: p.rails == 0)
def panel(box):
    yield box.label("back")


@grammar.rule("back")
def frame(box, leg, rails, slats, gap):
    left, middle, right = box.split("x", leg, ..., leg)
    yield from (left.label("post"), right.label("post"))
    for bay in middle.repeat("y", count=rails):
        yield bay.split("y", gap * bay.height, ...)[1].label("rail")
    for bay in middle.repeat("x", count=slats) if slats else ():
        yield bay.sub(((1 - gap) * bay.width, None, 0.6 * box.depth)).label("slat")


@grammar.rule("arms", when=lambda p: p.arms == "none")
def no_arms(box):
    return []


@grammar.rule("arms", when=lambda p: p.arms == "open")
def open_arms(box, leg, arm_height):
    for side in box.ends("x", leg):
        below, arm, _ = side.split("y", arm_height * box.height, min(0.6 * leg, 0.15 * box.height), ...)
        yield arm.label("arm")
        yield below.sub((None, None, leg), anchor=(0.5, 0.5, 1)).label("arm post")


@grammar.rule("arms")
def solid_arms(box, arm_height, back_thickness):
    for side in box.ends("x", min(back_thickness, box.width / 3)):
        yield side.split("y", arm_height * box.height, ...)[0].label("arm")


def below(p):
    """The height of what the seat stands on."""
    return 0 if p.base == "plinth" else p.seat_height * (1 - p.seat_thickness)


@procedure
def chair(
    width: Annotated[float, Range(0.3, 1.4)] = 0.5,
    depth: Annotated[float, Range(0.35, 1.2)] = 0.5,
    seat_height: Annotated[float, Range(0.25, 0.7)] = 0.48,
    seat_thickness: Annotated[float, Range(0.05, 0.65, when=lambda p: p.base != "plinth")] = 0.12,
    back_thickness: Annotated[float, Range(0.02, 0.2)] = 0.05,
    lean: Annotated[float, Range(0, 0.4)] = 0.15,
    curve: Annotated[float, Range(0, 0.2)] = 0.04,  # the rise of its arc, as a part of the width or the depth
    leg: Annotated[
        float, Range(0.03, 0.12, when=lambda p: p.base != "plinth" or p.rails > 0 or p.arms == "open")
    ] = 0.06,
    splay: Annotated[float, Range(0, 0.3, when=lambda p: p.base == "legs")] = 0.05,
    gap: Annotated[float, Range(0.3, 0.75, when=lambda p: p.rails > 0)] = 0.5,
    arm_height: Annotated[float, Range(0.15, 0.8, when=lambda p: p.arms != "none")] = 0.4,
    rails: Annotated[int, Range(0, 4)] = 2,
    slats: Annotated[int, Range(0, 4, when=lambda p: p.rails == 1)] = 0,
    stretchers: Annotated[int, Range(0, 3, when=lambda p: p.base == "legs" and below(p) > 0.15)] = 0,
    feet: Annotated[int, Range(3, 6, when=lambda p: p.base == "star")] = 5,
    base: Literal["legs", "sled", "pedestal", "star", "plinth"] = "legs",
    arms: Literal["none", "open", "solid"] = "none",
):
    return grammar.derive(
        (width, 1, depth),
        seat_height=seat_height,
        seat_thickness=seat_thickness,
        back_thickness=back_thickness,
        lean=lean,
        curve=curve,
        leg=leg,
        splay=splay,
        gap=gap,
        arm_height=arm_height,
        rails=rails,
        slats=slats,
        stretchers=stretchers,
        feet=feet,
        base=base,
        arms=arms,
    )
