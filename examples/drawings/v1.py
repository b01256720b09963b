"""Front views of tables, version 1: a top on two legs."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.drawing import box


@procedure
def table(
    height: Annotated[float, Range(0.2, 2.2)] = 0.6,  # of the width, as all lengths
    top: Annotated[float, Range(0.008, 0.3)] = 0.05,
    leg: Annotated[float, Range(0.01, 0.3)] = 0.06,
    inset: Annotated[float, Range(0.0, 0.35)] = 0.0,
):
    top = min(top, 0.9 * height)
    x = max(0.5 - inset - leg / 2, leg / 2)
    legs = box((leg, height - top), at=(x, (height - top) / 2)).mirror("x", keep=True)
    return box((1, top), at=(0, height - top / 2)) | legs
