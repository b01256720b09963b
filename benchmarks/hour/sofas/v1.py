"""Sofas, version 1: a seat between two arms, a back behind it, four feet. The width is 1."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box


@procedure
def sofa(
    depth: Annotated[float, Range(0.3, 1.0)] = 0.45,
    seat_height: Annotated[float, Range(0.1, 0.4)] = 0.22,
    back_height: Annotated[float, Range(0.2, 0.8)] = 0.45,
    back_thickness: Annotated[float, Range(0.03, 0.2)] = 0.1,
    arm_height: Annotated[float, Range(0.15, 0.5)] = 0.3,
    arm_thickness: Annotated[float, Range(0.02, 0.2)] = 0.1,
    feet: Annotated[float, Range(0.01, 0.09)] = 0.04,  # their height
):
    inner = 1 - 2 * arm_thickness
    seat = box((inner, seat_height - feet, depth), at=(0, (seat_height + feet) / 2, 0)).label("seat")
    behind = (back_thickness - depth) / 2
    back = box((inner, back_height - feet, back_thickness), at=(0, (back_height + feet) / 2, behind)).label("back")
    beside = (1 - arm_thickness) / 2
    arm = box((arm_thickness, arm_height - feet, depth), at=(beside, (arm_height + feet) / 2, 0)).label("arms")
    side = 0.04
    foot = box((side, feet, side), at=((1 - side) / 2, feet / 2, (depth - side) / 2)).label("feet")
    return seat | back | arm.mirror("x", keep=True) | foot.mirror("x", keep=True).mirror("z", keep=True)
