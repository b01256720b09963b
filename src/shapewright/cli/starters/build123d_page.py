"""A first procedure in build123d: every parameter of the function is a parameter of the model."""

from typing import Annotated, Literal

from build123d import Align, Box, Cylinder, Pos, RegularPolygon, extrude

from shapewright import Range, procedure

LOW = (Align.CENTER, Align.CENTER, Align.MIN)


@procedure(up="z", unit="mm")  # with size="given" lengths are found as the references have them, not proportions alone
def knob(
    diameter: Annotated[float, Range(15, 50)] = 30,
    height: Annotated[float, Range(8, 40)] = 18,
    skirt: Annotated[float, Range(1, 6)] = 2,
    grip: Literal["round", "faceted"] = "faceted",
    sides: Annotated[int, Range(3, 8, when=lambda p: p.grip == "faceted")] = 6,
    pointer: bool = True,
):
    body = Cylinder(0.7 * diameter, skirt, align=LOW)
    round_grip = grip == "round"
    handle = (
        Cylinder(diameter / 2, height, align=LOW)
        if round_grip
        else extrude(RegularPolygon(diameter / 2, sides), height)
    )
    body += Pos(0, 0, skirt) * handle
    if pointer:
        body += Pos(0.4 * diameter, 0, 0) * Box(0.8 * diameter, 0.15 * diameter, 1.5 * skirt, align=LOW)
    return body
