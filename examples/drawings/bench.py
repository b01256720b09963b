"""Front views of benches: the worked example."""

from typing import Annotated

from shapewright import Range, When, procedure
from shapewright.modelling.drawing import box


@procedure
def bench(
    height: Annotated[float, Range(0.2, 0.6)] = 0.3,  # of the width, as all lengths
    seat: Annotated[float, Range(0.02, 0.12)] = 0.06,
    legs: Annotated[int, Range(2, 4)] = 2,
    leg: Annotated[float, Range(0.03, 0.12)] = 0.06,
    inset: Annotated[float, Range(0.0, 0.1)] = 0.02,
    back: bool = False,
    back_top: Annotated[float, Range(1.3, 2.5, when=lambda p: p.back)] = 1.7,  # of the height
    back_board: Annotated[float, Range(0.04, 0.2, when=lambda p: p.back)] = 0.1,
    posts: Annotated[bool, When(lambda p: p.back)] = True,
):
    x = inset + leg / 2 - 0.5
    shape = box((1, seat), at=(0, height - seat / 2))
    shape |= box((leg, height), at=(x, height / 2)).array(legs, step=(-2 * x / (legs - 1), 0))
    if back:
        top = back_top * height
        shape |= box((1, back_board), at=(0, top - back_board / 2))
        if posts:
            shape |= box((leg, top - height), at=(x, (top + height) / 2)).mirror("x", keep=True)
    return shape
