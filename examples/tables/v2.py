"""Tables, version 2: the top may be round; then the legs move in."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box, cylinder


@procedure
def table(
    height: Annotated[float, Range(0.5, 1.0, steps=8)] = 0.7,
    breadth: Annotated[float, Range(0.3, 1.0, steps=8)] = 0.6,
    top_thickness: Annotated[float, Range(0.05, 0.25, steps=5)] = 0.1,  # of the height
    leg_thickness: Annotated[float, Range(0.05, 0.25, steps=5)] = 0.1,  # of the breadth
    round_top: bool = False,
):
    thick = height * top_thickness
    side = breadth * leg_thickness
    inset = 1.41 if round_top else 1
    x, z = (1 / inset - side) / 2, (breadth / inset - side) / 2

    top = (cylinder if round_top else box)((1, thick, breadth), at=(0, (height - thick) / 2, 0)).label("top")
    leg = box((side, height, side), at=(x, 0, z)).label("legs")
    return top | leg.mirror("x", keep=True).mirror("z", keep=True)
