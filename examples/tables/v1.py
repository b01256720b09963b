"""Tables, version 1: a rectangular top on four legs. The width is 1."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box


@procedure
def table(
    height: Annotated[float, Range(0.5, 1.0, steps=8)] = 0.7,
    breadth: Annotated[float, Range(0.3, 1.0, steps=8)] = 0.6,
    top_thickness: Annotated[float, Range(0.05, 0.25, steps=5)] = 0.1,  # of the height
    leg_thickness: Annotated[float, Range(0.05, 0.25, steps=5)] = 0.1,  # of the breadth
):
    thick = height * top_thickness
    side = breadth * leg_thickness

    top = box((1, thick, breadth), at=(0, (height - thick) / 2, 0)).label("top")
    leg = box((side, height, side), at=((1 - side) / 2, 0, (breadth - side) / 2)).label("legs")
    return top | leg.mirror("x", keep=True).mirror("z", keep=True)
