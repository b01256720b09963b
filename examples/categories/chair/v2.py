"""Chairs, version 2: arms, open backs, stretchers. All lengths are parts of the height, which is 1."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.grammar import Grammar

grammar = Grammar()


@grammar.rule("chair")
def parts(box, seat_height, seat_thickness):
    below, seat, above = box.split("y", seat_height - seat_thickness, seat_thickness, ...)
    yield below.tag("base")
    yield seat.tag("seat")
    yield above.tag("above")


# What the seat stands on


@grammar.rule("base")
def four_legs(box, leg):
    for corner in box.corners(leg):
        yield corner.tag("leg")
    yield box.inset(x=leg / 4, z=leg / 4).sub((None, min(leg, box.height) / 2, None)).tag("stretchers")


@grammar.rule("stretchers", when=lambda p: p.stretchers == 0)
def no_stretchers(box):
    return []


@grammar.rule("stretchers", when=lambda p: p.stretchers == 3)
def all_round(box, leg):
    yield from (rail.tag("stretcher") for rail in box.rails(leg / 2))


@grammar.rule("stretchers")
def at_the_sides(box, leg, stretchers):
    for side in box.ends("x", leg / 2):
        yield side.tag("stretcher")
    if stretchers == 2:
        yield box.inset(x=leg / 4).sub((None, None, leg / 2)).tag("stretcher")


# The back


@grammar.rule("above")
def back_and_arms(box, back_thickness):
    yield box.sub((None, None, back_thickness), anchor=(0.5, 0, 0)).tag("back")
    yield box.tag("arms")


@grammar.rule("back", when=lambda p: p.rails == 0)
def panel(box):
    yield box.label("back")


@grammar.rule("back")
def frame(box, leg, rails, slats, gap):
    left, middle, right = box.split("x", leg, ..., leg)
    yield from (left.tag("post"), right.tag("post"))
    for bay in middle.repeat("y", count=rails):
        yield bay.split("y", gap * bay.height, ...)[1].tag("rail")
    for bay in middle.repeat("x", count=slats) if slats else ():
        yield bay.sub(((1 - gap) * bay.width, None, 0.6 * box.depth)).tag("slat")


# The arms


@grammar.rule("arms", when=lambda p: p.arms == "none")
def no_arms(box):
    return []


@grammar.rule("arms", when=lambda p: p.arms == "open")
def open_arms(box, leg, arm_height):
    for side in box.ends("x", leg):
        below, arm, _ = side.split("y", arm_height * box.height, min(0.6 * leg, 0.15 * box.height), ...)
        yield arm.tag("arm")
        yield below.sub((None, None, leg), anchor=(0.5, 0.5, 1)).tag("arm post")


@grammar.rule("arms")
def solid_arms(box, arm_height, back_thickness):
    for side in box.ends("x", min(back_thickness, box.width / 3)):
        yield side.split("y", arm_height * box.height, ...)[0].tag("arm")


@procedure
def chair(
    width: Annotated[float, Range(0.3, 1.4)] = 0.5,
    depth: Annotated[float, Range(0.3, 1.2)] = 0.5,
    seat_height: Annotated[float, Range(0.25, 0.7)] = 0.48,
    seat_thickness: Annotated[float, Range(0.02, 0.22)] = 0.06,
    back_thickness: Annotated[float, Range(0.02, 0.25)] = 0.05,
    leg: Annotated[float, Range(0.02, 0.14)] = 0.06,
    gap: Annotated[float, Range(0.3, 0.8, when=lambda p: p.rails > 0)] = 0.5,
    arm_height: Annotated[float, Range(0.15, 0.8, when=lambda p: p.arms != "none")] = 0.4,
    rails: Annotated[int, Range(0, 4)] = 2,
    slats: Annotated[int, Range(0, 4, when=lambda p: p.rails == 1)] = 0,
    stretchers: Annotated[int, Range(0, 3)] = 0,
    arms: Literal["none", "open", "solid"] = "none",
):
    return grammar.derive(
        (width, 1, depth),
        seat_height=seat_height,
        seat_thickness=seat_thickness,
        back_thickness=back_thickness,
        leg=leg,
        gap=gap,
        arm_height=arm_height,
        rails=rails,
        slats=slats,
        stretchers=stretchers,
        arms=arms,
    )
