"""Sofas, version 2: cushions on the seat and before the back. The width is 1."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box, slats

GAP = 0.01  # between cushions


def has_cushions(p):
    return p.cushions > 0


@procedure
def sofa(
    depth: Annotated[float, Range(0.3, 1.0)] = 0.45,
    seat_height: Annotated[float, Range(0.1, 0.4)] = 0.22,
    back_height: Annotated[float, Range(0.2, 0.8)] = 0.45,
    back_thickness: Annotated[float, Range(0.03, 0.2)] = 0.1,
    arm_height: Annotated[float, Range(0.15, 0.5)] = 0.3,
    arm_thickness: Annotated[float, Range(0.02, 0.2)] = 0.1,
    feet: Annotated[float, Range(0.01, 0.09)] = 0.04,  # their height
    cushion: Annotated[float, Range(0.03, 0.15, when=has_cushions)] = 0.08,  # the thickness of all cushions
    cushion_height: Annotated[float, Range(0.1, 0.4, when=has_cushions)] = 0.2,  # of those before the back
    cushions: Annotated[int, Range(0, 4)] = 0,
):
    inner = 1 - 2 * arm_thickness
    seat = box((inner, seat_height - feet, depth), at=(0, (seat_height + feet) / 2, 0)).label("seat")
    behind = (back_thickness - depth) / 2
    back = box((inner, back_height - feet, back_thickness), at=(0, (back_height + feet) / 2, behind)).label("back")
    beside = (1 - arm_thickness) / 2
    arm = box((arm_thickness, arm_height - feet, depth), at=(beside, (arm_height + feet) / 2, 0)).label("arms")
    side = 0.04
    foot = box((side, feet, side), at=((1 - side) / 2, feet / 2, (depth - side) / 2)).label("feet")
    whole = seat | back | arm.mirror("x", keep=True) | foot.mirror("x", keep=True).mirror("z", keep=True)
    if not cushions:
        return whole
    top, room = seat_height + cushion, depth - back_thickness
    lying = slats((inner, cushion, room), cushions, GAP, at=(0, seat_height + cushion / 2, back_thickness / 2))
    at = 0, top + cushion_height / 2, back_thickness + (cushion - depth) / 2
    return whole | (lying | slats((inner, cushion_height, cushion), cushions, GAP, at=at)).label("cushions")
