"""Chairs, version 1: a seat on four legs, and a back. All lengths are parts of the height, which is 1."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.grammar import Grammar

grammar = Grammar()


@grammar.rule("chair")
def parts(box, seat_height, seat_thickness):
    below, seat, above = box.split("y", seat_height - seat_thickness, seat_thickness, ...)
    yield below.tag("base")
    yield seat.tag("seat")
    yield above.tag("above")


@grammar.rule("base")
def four_legs(box, leg):
    for corner in box.corners(leg):
        yield corner.tag("leg")


@grammar.rule("above")
def back(box, back_thickness):
    yield box.sub((None, None, back_thickness), anchor=(0.5, 0, 0)).tag("back")


@procedure
def chair(
    width: Annotated[float, Range(0.3, 1.0)] = 0.5,
    depth: Annotated[float, Range(0.35, 1.0)] = 0.55,
    seat_height: Annotated[float, Range(0.25, 0.7)] = 0.48,
    seat_thickness: Annotated[float, Range(0.02, 0.22)] = 0.06,
    back_thickness: Annotated[float, Range(0.02, 0.25)] = 0.05,
    leg: Annotated[float, Range(0.02, 0.14)] = 0.06,
):
    return grammar.derive(
        (width, 1, depth),
        seat_height=seat_height,
        seat_thickness=seat_thickness,
        back_thickness=back_thickness,
        leg=leg,
    )
