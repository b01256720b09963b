"""Chairs, version 3: arms, of bars or solid. The height is 1."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.solids import box


def has_arms(p):
    return p.arms != "none"


def arm_of(form, height, depth, thickness):
    """One arm on y = 0, its middle at x = 0 and z = 0."""
    panel = box((thickness, height, depth), at=(0, height / 2, 0))
    bar = min(thickness, height / 2)
    if form == "solid":
        return panel
    return panel - box((2 * thickness, height - bar, depth - 2 * thickness), at=(0, (height - bar) / 2, 0))


@procedure
def chair(
    width: Annotated[float, Range(0.3, 1.1)] = 0.5,
    depth: Annotated[float, Range(0.35, 1.1)] = 0.55,
    seat_height: Annotated[float, Range(0.25, 0.8)] = 0.48,
    seat_thickness: Annotated[float, Range(0.02, 0.22)] = 0.06,
    back_thickness: Annotated[float, Range(0.02, 0.25)] = 0.05,
    lean: Annotated[float, Range(0, 0.5)] = 0.1,  # of the back's height
    curve: Annotated[float, Range(0, 80)] = 10,  # degrees between the ends of the back
    arm_height: Annotated[float, Range(0.1, 0.4, when=has_arms)] = 0.2,  # above the seat
    arm_thickness: Annotated[float, Range(0.03, 0.16, when=has_arms)] = 0.05,
    leg: Annotated[float, Range(0.02, 0.14)] = 0.06,
    arms: Literal["none", "bars", "solid"] = "none",
):
    below, high = seat_height - seat_thickness, 1 - seat_height
    seat = box((width, seat_thickness, depth), at=(0, seat_height - seat_thickness / 2, 0)).label("seat")
    back = box((width, high, back_thickness), at=(0, seat_height + high / 2, (back_thickness - depth) / 2))
    back = back.bend(curve, "x", towards="z", fixed=0.5).path((0, 0, 0), (0, 0, -lean * high)).label("back")
    corner = box((leg, below, leg), at=((width - leg) / 2, below / 2, (depth - leg) / 2)).label("legs")
    whole = seat | back | corner.mirror("x", keep=True).mirror("z", keep=True)
    if arms == "none":
        return whole
    arm = arm_of(arms, arm_height, depth, arm_thickness)
    arm = arm.translate(((width - arm_thickness) / 2, seat_height, 0)).label("arms")
    return whole | arm.mirror("x", keep=True)
