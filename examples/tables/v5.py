"""Tables, version 5: the top may stand on a trestle, a post and a foot bar at each end."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.solids import box, cylinder


@procedure
def table(
    height: Annotated[float, Range(0.5, 1.0, steps=8)] = 0.7,
    breadth: Annotated[float, Range(0.3, 1.0, steps=8)] = 0.6,
    top_thickness: Annotated[float, Range(0.05, 0.25, steps=5)] = 0.1,  # of the height
    leg_thickness: Annotated[float, Range(0.05, 0.25, steps=5)] = 0.1,  # of the breadth
    round_top: bool = False,
    legs: Literal["basic", "support", "pedestal", "split"] = "basic",
):
    thick = height * top_thickness
    side = breadth * leg_thickness
    top = (cylinder if round_top else box)((1, thick, breadth), at=(0, (height - thick) / 2, 0)).label("top")
    if legs == "pedestal":
        return top | pedestal(height, side)
    if legs == "split":
        return top | trestle(height, breadth, side)
    return top | four_legs(height, breadth, side, 1.41 if round_top else 1, stretchers=legs == "support")


def four_legs(height, breadth, side, inset, stretchers):
    x, z = (1 / inset - side) / 2, (breadth / inset - side) / 2
    leg = box((side, height, side), at=(x, 0, z)).label("legs")
    legs = leg.mirror("x", keep=True).mirror("z", keep=True)
    if not stretchers:
        return legs
    across = box((side, side, breadth / inset), at=(x, -height / 3, 0)).mirror("x", keep=True)
    along = box((2 * x, side, side), at=(0, -height / 3, 0))
    return legs | (across | along).label("stretchers")


def pedestal(height, side):
    column = cylinder((side, height, side)).label("legs")
    foot = cylinder((0.5, height / 20, 0.5), at=(0, -19 / 40 * height, 0)).label("foot")
    return column | foot


def trestle(height, breadth, side):
    x = (1 - side) / 2
    post = box((side, height, side), at=(x, 0, 0)).label("legs")
    foot = box((side, side, breadth), at=(x, (side - height) / 2, 0)).label("foot")
    return (post | foot).mirror("x", keep=True)
