"""Chairs, version 2: backs that lean and bend around the sitter. The height is 1."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box


@procedure
def chair(
    width: Annotated[float, Range(0.3, 1.1)] = 0.5,
    depth: Annotated[float, Range(0.35, 1.1)] = 0.55,
    seat_height: Annotated[float, Range(0.25, 0.8)] = 0.48,
    seat_thickness: Annotated[float, Range(0.02, 0.22)] = 0.06,
    back_thickness: Annotated[float, Range(0.02, 0.25)] = 0.05,
    lean: Annotated[float, Range(0, 0.5)] = 0.1,  # of the back's height
    curve: Annotated[float, Range(0, 80)] = 10,  # degrees between the ends of the back
    leg: Annotated[float, Range(0.02, 0.14)] = 0.06,
):
    below, high = seat_height - seat_thickness, 1 - seat_height
    seat = box((width, seat_thickness, depth), at=(0, seat_height - seat_thickness / 2, 0)).label("seat")
    back = box((width, high, back_thickness), at=(0, seat_height + high / 2, (back_thickness - depth) / 2))
    back = back.bend(curve, "x", towards="z", fixed=0.5).path((0, 0, 0), (0, 0, -lean * high)).label("back")
    corner = box((leg, below, leg), at=((width - leg) / 2, below / 2, (depth - leg) / 2)).label("legs")
    return seat | back | corner.mirror("x", keep=True).mirror("z", keep=True)
