"""Buildings, version 4: round towers under a spire or a dome, or with battlements. The width of the walls is 1."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.solids import box, cone, cylinder, extrude, sphere

PARAPET = 0.05  # its thickness, inwards of the walls


ROUND = "spire", "dome", "battlements"


def pitched(p):
    return p.roof in ("gable", "front gable")


def is_round(p):
    return p.roof in ROUND


def gable_roof(length, across, height, roof_height, kink, overhang, thickness):
    """Over walls that long from side to side, the ridge along them. kink: how far the slopes rise above straight."""
    half = across / 2 + overhang
    eaves = height - roof_height * overhang / (across / 2)
    ridge = height + roof_height
    bent = eaves + (0.5 + kink) * (ridge - eaves)  # halfway between eaves and ridge
    slope = [(eaves, half), (bent, half / 2), (ridge, 0), (bent, -half / 2), (eaves, -half)]  # (y, z)
    gable = [(eaves, -half), (eaves, half), *((y + thickness, z) for y, z in slope)]
    return extrude(gable, length + 2 * overhang).rotate(90, "z").label("roof")


def flat_roof(depth, height, overhang, thickness):
    """A parapet as high as the thickness, out over the walls, and the roof inside it at the walls' height."""
    outer = box((1 + 2 * overhang, thickness, depth + 2 * overhang), at=(0, height + thickness / 2, 0))
    return (outer - box((1 - 2 * PARAPET, thickness, depth - 2 * PARAPET), at=(0, height + thickness, 0))).label("roof")


def tower(height, roof, roof_height, overhang, thickness, narrow):
    """Round walls, narrower at the top by that factor, and what is above them."""
    walls = cone((1, height, 1), at=(0, height / 2, 0), top=narrow, segments=12).label("walls")
    wide = narrow + 2 * overhang
    rim = cylinder((wide, thickness, wide), at=(0, height + thickness / 2, 0), segments=12)
    top = height + thickness
    if roof == "spire":
        above = cone((wide, roof_height, wide), at=(0, top + roof_height / 2, 0), segments=12)
    elif roof == "dome":
        dome = sphere((narrow, 2 * roof_height, narrow), at=(0, top, 0), segments=16)
        above = dome - box((2, 2 * roof_height, 2), at=(0, top - thickness / 2 - roof_height, 0))
    else:
        teeth = cylinder((wide, 2 * thickness, wide), at=(0, top, 0), segments=12)
        gap = box((2, 2 * thickness, 0.12 * wide), at=(0, top + thickness, 0))
        above = teeth - cylinder((0.8 * wide, 3 * thickness, 0.8 * wide), at=(0, top + thickness, 0), segments=12)
        above -= gap.rotate(15) | gap.rotate(75) | gap.rotate(135)
    return walls | (rim | above).label("roof")


@procedure
def building(
    depth: Annotated[float, Range(0.4, 1.6, when=lambda p: not is_round(p))] = 0.8,
    height: Annotated[float, Range(0.3, 2.5)] = 0.7,  # of the walls
    roof_height: Annotated[float, Range(0.1, 0.8, when=lambda p: p.roof not in ("flat", "battlements"))] = 0.4,
    kink: Annotated[float, Range(0, 0.3, when=pitched)] = 0,  # of the roof's height
    overhang: Annotated[float, Range(0.01, 0.15)] = 0.06,
    thickness: Annotated[float, Range(0.02, 0.15)] = 0.04,  # of the roof's edge
    narrow: Annotated[float, Range(0.6, 1.0, when=is_round)] = 0.9,
    roof: Literal["gable", "front gable", "flat", "spire", "dome", "battlements"] = "gable",
):
    if roof in ROUND:
        return tower(height, roof, roof_height, overhang, thickness, narrow)
    walls = box((1, height, depth), at=(0, height / 2, 0)).label("walls")
    if roof == "flat":
        return walls | flat_roof(depth, height, overhang, thickness)
    if roof == "gable":
        return walls | gable_roof(1, depth, height, roof_height, kink, overhang, thickness)
    return walls | gable_roof(depth, 1, height, roof_height, kink, overhang, thickness).rotate(90)
