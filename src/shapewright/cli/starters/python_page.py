"""A first procedure: every parameter of the function is a parameter of the model."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.solids import box, cylinder


@procedure
def table(
    height: Annotated[float, Range(0.4, 1.1)] = 0.7,
    breadth: Annotated[float, Range(0.3, 1.0)] = 0.6,
    thickness: Annotated[float, Range(0.02, 0.15)] = 0.05,
    leg: Annotated[float, Range(0.03, 0.15)] = 0.06,
    top: Literal["square", "round"] = "square",
):
    # Y is up, the front faces +Z; any unit will do, because shapes are compared at the same size.
    make = cylinder if top == "round" else box
    plate = make((1.0, thickness, breadth), at=(0, height - thickness / 2, 0)).label("top")
    reach = 0.7 if top == "round" else 1.0
    x, z = (reach - leg) / 2, (breadth * reach - leg) / 2
    post = box((leg, height, leg), at=(x, height / 2, z)).label("legs")
    return plate | post.mirror("x", keep=True).mirror("z", keep=True)
