"""A first procedure that draws: every parameter of the function is a parameter of the model."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.drawing import box


@procedure
def table(
    height: Annotated[float, Range(0.2, 1.5)] = 0.6,
    top: Annotated[float, Range(0.02, 0.2)] = 0.05,
    leg: Annotated[float, Range(0.02, 0.2)] = 0.06,
    inset: Annotated[float, Range(0.0, 0.3)] = 0.05,
    legs: Literal["two", "pedestal"] = "two",
    shelf: bool = False,
):
    # Any unit will do, because drawings are compared at the same size. Here the top is 1 wide.
    x = 0.5 - inset - leg / 2
    post = box((leg, height - top), at=(x if legs == "two" else 0, (height - top) / 2))
    drawn = box((1, top), at=(0, height - top / 2)) | (post.mirror("x", keep=True) if legs == "two" else post)
    return drawn | box((2 * x, top), at=(0, 0.3 * height)) if shelf else drawn
