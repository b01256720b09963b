"""Buildings, version 2: flat roofs inside a parapet. The width of the walls is 1."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.solids import box, extrude

PARAPET = 0.05  # its thickness, inwards of the walls


def gable_roof(depth, height, roof_height, overhang, thickness):
    """Over walls 1 wide, the ridge from side to side."""
    half = depth / 2 + overhang
    eaves = height - roof_height * overhang / (depth / 2)
    upper, ridge = eaves + thickness, height + roof_height + thickness
    gable = [(eaves, -half), (eaves, half), (upper, half), (ridge, 0), (upper, -half)]  # (y, z)
    return extrude(gable, 1 + 2 * overhang).rotate(90, "z").label("roof")


def flat_roof(depth, height, overhang, thickness):
    """A parapet as high as the thickness, out over the walls, and the roof inside it at the walls' height."""
    outer = box((1 + 2 * overhang, thickness, depth + 2 * overhang), at=(0, height + thickness / 2, 0))
    return (outer - box((1 - 2 * PARAPET, thickness, depth - 2 * PARAPET), at=(0, height + thickness, 0))).label("roof")


@procedure
def building(
    depth: Annotated[float, Range(0.4, 1.6)] = 0.8,
    height: Annotated[float, Range(0.3, 2.5)] = 0.7,  # of the walls
    roof_height: Annotated[float, Range(0.1, 0.8, when=lambda p: p.roof == "gable")] = 0.4,
    overhang: Annotated[float, Range(0.01, 0.15)] = 0.06,
    thickness: Annotated[float, Range(0.02, 0.15)] = 0.04,  # of the roof's edge
    roof: Literal["gable", "flat"] = "gable",
):
    walls = box((1, height, depth), at=(0, height / 2, 0)).label("walls")
    if roof == "flat":
        return walls | flat_roof(depth, height, overhang, thickness)
    return walls | gable_roof(depth, height, roof_height, overhang, thickness)
