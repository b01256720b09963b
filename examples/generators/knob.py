"""A control knob, as build123d users write it: algebra mode."""

from typing import Annotated

from build123d import Align, Box, Cylinder, Pos, RegularPolygon, extrude

from shapewright import Range, procedure

LOW = (Align.CENTER, Align.CENTER, Align.MIN)


@procedure(up="z", unit="mm", size="given")
def knob(
    diameter: Annotated[float, Range(15, 50)] = 30.0,
    height: Annotated[float, Range(8, 40)] = 18.0,
    skirt: Annotated[float, Range(1, 6)] = 2.0,
    sides: Annotated[int, Range(3, 8)] = 6,
    pointer: bool = True,
):
    body = Cylinder(0.7 * diameter, skirt, align=LOW)
    body += Pos(0, 0, skirt) * extrude(RegularPolygon(diameter / 2, sides), amount=height)
    if pointer:
        body += Pos(0.4 * diameter, 0, 0) * Box(0.8 * diameter, 0.15 * diameter, 1.5 * skirt, align=LOW)
    return body
