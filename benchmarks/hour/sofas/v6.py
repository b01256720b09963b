"""Sofas, version 6: backs that lean, and the cushions before them. The width is 1."""

from typing import Annotated, Literal

from shapewright import Range, When, procedure
from shapewright.modelling.solids import box, cylinder, slats

GAP = 0.01  # between cushions
BAR = 0.04


def has_cushions(p):
    return p.cushions > 0 and is_sofa(p)


def has_arms(p):
    return p.arms != "none" and is_sofa(p)


def is_sofa(p):
    return p.form == "sofa"


def is_lounger(p):
    return p.form == "lounger"


def has_chaise(p):
    return is_sofa(p) and p.chaise != "none"


def arm_of(form, thickness, height, depth, feet):
    """One arm, its middle at x = 0 and z = 0, from the feet or, of bars, from the ground up to that height."""
    if form == "bars":
        frame = box((BAR, height, depth), at=(0, height / 2, 0))
        return frame - box((2 * BAR, height - BAR, depth - 2 * BAR), at=(0, (height - BAR) / 2, 0))
    side = box((thickness, height - feet, depth), at=(0, (height + feet) / 2, 0))
    if form == "solid":
        return side
    roll = cylinder((1.4 * thickness, depth, 1.4 * thickness), segments=16).rotate(90, "x")
    return side | roll.translate((0, height - 0.3 * thickness, 0))


def lounger(length, height, thickness, head, angle, leg):
    """A bed on four legs. head: which part of the length is raised, by that angle about its front end."""
    head_length = head * length
    flat = box((1, thickness, length - head_length), at=(0, height, (length - head_length) / 2))
    raised = box((1, thickness, head_length + thickness / 2), at=(0, height, (thickness / 2 - head_length) / 2))
    bed = flat.label("bed") | raised.rotate(angle, "x", about=(0, height, 0)).label("head")
    at = (1 - leg) / 2, height / 2, 0.9 * (length - head_length)
    front = box((leg, height, leg), at=at)
    legs = front | box((leg, height, leg), at=(at[0], height / 2, leg / 2))
    return bed | legs.mirror("x", keep=True).label("legs")


@procedure
def sofa(
    depth: Annotated[float, Range(0.3, 1.0, when=is_sofa)] = 0.45,
    seat_height: Annotated[float, Range(0.1, 0.4, when=is_sofa)] = 0.22,
    back_height: Annotated[float, Range(0.2, 0.8, when=is_sofa)] = 0.45,
    back_thickness: Annotated[float, Range(0.03, 0.2, when=is_sofa)] = 0.1,
    arm_height: Annotated[float, Range(0.19, 0.5, when=has_arms)] = 0.3,
    arm_thickness: Annotated[float, Range(0.02, 0.2, when=lambda p: p.arms in ("solid", "rolled"))] = 0.1,
    feet: Annotated[float, Range(0.03, 0.45, when=is_sofa)] = 0.2,  # their height, of the seat's
    cushion: Annotated[float, Range(0.03, 0.15, when=has_cushions)] = 0.08,  # the thickness of all cushions
    cushion_height: Annotated[float, Range(0.1, 0.4, when=has_cushions)] = 0.2,  # of those before the back
    lean: Annotated[float, Range(0, 0.6, when=is_sofa)] = 0.1,  # backwards, of what is above the feet
    cushions: Annotated[int, Range(0, 4, when=is_sofa)] = 0,
    arms: Annotated[Literal["solid", "rolled", "bars", "none"], When(is_sofa)] = "solid",
    length: Annotated[float, Range(1.5, 5.0, when=is_lounger)] = 2.8,
    height: Annotated[float, Range(0.2, 0.9, when=is_lounger)] = 0.5,
    thickness: Annotated[float, Range(0.03, 0.15, when=is_lounger)] = 0.08,
    head: Annotated[float, Range(0.25, 0.5, when=is_lounger)] = 0.4,
    angle: Annotated[float, Range(5, 70, when=is_lounger)] = 40,
    leg: Annotated[float, Range(0.04, 0.15, when=is_lounger)] = 0.08,
    chaise_width: Annotated[float, Range(0.2, 0.5, when=has_chaise)] = 0.3,
    chaise_depth: Annotated[float, Range(0.1, 0.6, when=has_chaise)] = 0.3,  # before the seat
    chaise: Annotated[Literal["none", "left", "right"], When(is_sofa)] = "none",
    form: Literal["sofa", "lounger"] = "sofa",
):
    if form == "lounger":
        return lounger(length, height, thickness, head, angle, leg)
    feet *= seat_height
    thick = {"none": 0, "bars": BAR}.get(arms, arm_thickness)
    inner = 1 - 2 * thick
    seat = box((inner, seat_height - feet, depth), at=(0, (seat_height + feet) / 2, 0)).label("seat")
    behind = (back_thickness - depth) / 2
    back = box((inner, back_height - feet, back_thickness), at=(0, (back_height + feet) / 2, behind))
    back = back.path((0, 0, 0), (0, 0, -lean * (back_height - feet))).label("back")
    foot = box((BAR, feet, BAR), at=((1 - BAR) / 2, feet / 2, (depth - BAR) / 2)).label("feet")
    whole = seat | back | foot.mirror("x", keep=True).mirror("z", keep=True)
    if arms != "none":
        arm = arm_of(arms, thick, arm_height, depth, feet).translate(((1 - thick) / 2, 0, 0)).label("arms")
        whole |= arm.mirror("x", keep=True)
    if chaise != "none":
        size = chaise_width, seat_height - feet, chaise_depth + 0.1
        at = (1 - chaise_width) / 2, (seat_height + feet) / 2, (depth + chaise_depth - 0.1) / 2
        added = box(size, at=at) | foot.translate((0, 0, chaise_depth))
        whole |= (added.mirror("x") if chaise == "left" else added).label("chaise")
    if not cushions:
        return whole
    top = seat_height + cushion
    back_at = lean * (top - feet) + 0.005  # how far it has moved there, and the cushions reach into it
    room = depth - back_thickness + back_at
    middle = 0, seat_height + cushion / 2, (back_thickness - back_at) / 2
    lying = slats((inner, cushion, room), cushions, GAP, at=middle)
    at = 0, top + cushion_height / 2, back_thickness + (cushion - depth) / 2 - back_at
    standing = slats((inner, cushion_height, cushion), cushions, GAP, at=at)
    return whole | (lying | standing.path((0, 0, 0), (0, 0, -lean * cushion_height))).label("cushions")
