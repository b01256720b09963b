"""Chairs, version 5: a column on a disc or a star, or a block instead of legs. The height is 1."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.solids import box, cylinder


def has_arms(p):
    return p.arms != "none"


def is_open(p):
    return p.back != "panel"


def base_of(form, width, depth, height, leg):
    """What the seat stands on, from the ground up to its height."""
    if form == "block":
        return box((width, height, depth), at=(0, height / 2, 0))
    if form == "legs":
        corner = box((leg, height, leg), at=((width - leg) / 2, height / 2, (depth - leg) / 2))
        return corner.mirror("x", keep=True).mirror("z", keep=True)
    column = cylinder((1.2 * leg, height, 1.2 * leg), at=(0, height / 2, 0), segments=12)
    if form == "disc":
        return column | cylinder((0.8 * width, 0.03, 0.8 * width), at=(0, 0.015, 0))
    spoke = box((0.06, 0.05, width / 2), at=(0, 0.025, width / 4))
    return column | spoke.polar_array(5)


def back_of(form, width, height, thickness, post, count, gap):
    """A back on y = 0, its middle at x = 0 and z = 0. gap: between its bars, a part of the distance between them."""
    if form == "panel":
        return box((width, height, thickness), at=(0, height / 2, 0))
    frame = box((post, height, thickness), at=((width - post) / 2, height / 2, 0)).mirror("x", keep=True)
    bar, inner = 0.7 * thickness, width - post
    if form == "rails":
        pitch = height / count
        rail = box((inner, (1 - gap) * pitch, bar), at=(0, height - (1 - gap) * pitch / 2, 0))
        return frame | rail.array(count, (0, -pitch, 0))
    top = min(0.2 * height, 1.5 * post)
    pitch = (width - 2 * post) / count
    slat = box(((1 - gap) * pitch, height - top / 2, bar), at=((pitch - width) / 2 + post, (height - top / 2) / 2, 0))
    return frame | slat.array(count, (pitch, 0, 0)) | box((inner, top, bar), at=(0, height - top / 2, 0))


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
    bars: Annotated[int, Range(1, 6, when=is_open)] = 3,
    gap: Annotated[float, Range(0.3, 0.8, when=is_open)] = 0.5,
    back: Literal["panel", "rails", "slats"] = "panel",
    base: Literal["legs", "disc", "star", "block"] = "legs",
    arms: Literal["none", "bars", "solid"] = "none",
):
    below, high = seat_height - seat_thickness, 1 - seat_height
    seat = box((width, seat_thickness, depth), at=(0, seat_height - seat_thickness / 2, 0)).label("seat")
    behind = back_of(back, width, high, back_thickness, leg, bars, gap)
    behind = behind.translate((0, seat_height, (back_thickness - depth) / 2))
    behind = behind.bend(curve, "x", towards="z", fixed=0.5).path((0, 0, 0), (0, 0, -lean * high)).label("back")
    stand = base_of(base, width, depth, below, leg).label("base")
    whole = seat | behind | stand
    if arms == "none":
        return whole
    arm = arm_of(arms, arm_height, depth, arm_thickness)
    arm = arm.translate(((width - arm_thickness) / 2, seat_height, 0)).label("arms")
    return whole | arm.mirror("x", keep=True)
