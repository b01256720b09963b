"""Buildings, version 1: four walls under a gable roof, the ridge from side to side. The width of the walls is 1."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box, extrude


@procedure
def building(
    depth: Annotated[float, Range(0.4, 1.6)] = 0.8,
    height: Annotated[float, Range(0.3, 2.0)] = 0.7,  # of the walls
    roof_height: Annotated[float, Range(0.1, 0.8)] = 0.4,
    overhang: Annotated[float, Range(0.01, 0.15)] = 0.06,
    roof_thickness: Annotated[float, Range(0.02, 0.1)] = 0.04,
):
    walls = box((1, height, depth), at=(0, height / 2, 0)).label("walls")
    half = depth / 2 + overhang
    eaves = height - roof_height * overhang / (depth / 2)
    upper, ridge = eaves + roof_thickness, height + roof_height + roof_thickness
    gable = [(eaves, -half), (eaves, half), (upper, half), (ridge, 0), (upper, -half)]  # (y, z)
    roof = extrude(gable, 1 + 2 * overhang).rotate(90, "z").label("roof")
    return walls | roof
