"""Buildings, version 5: a lower wing beside, under a roof of its own. The width of the walls is 1 without it."""

from typing import Annotated, Literal

from shapewright import Range, When, procedure
from shapewright.modelling.solids import box, cone, cylinder, extrude, sphere

PARAPET = 0.05  # its thickness, inwards of the walls
ROUND = "spire", "dome", "battlements"


def pitched(p):
    return p.roof in ("gable", "front gable")


def is_round(p):
    return p.roof in ROUND


def has_wing(p):
    return p.wing != "none"


def gable_roof(length, across, height, rise, kink, overhang, thickness):
    """Over walls that long from side to side, the ridge along them. kink: how far the slopes rise above straight."""
    half = across / 2 + overhang
    eaves = height - rise * overhang / (across / 2)
    ridge = height + rise
    bent = eaves + (0.5 + kink) * (ridge - eaves)  # halfway between eaves and ridge
    slope = [(eaves, half), (bent, half / 2), (ridge, 0), (bent, -half / 2), (eaves, -half)]  # (y, z)
    gable = [(eaves, -half), (eaves, half), *((y + thickness, z) for y, z in slope)]
    return extrude(gable, length + 2 * overhang).rotate(90, "z").label("roof")


def flat_roof(width, depth, height, overhang, thickness):
    """A parapet as high as the thickness, out over the walls, and the roof inside it at the walls' height."""
    outer = box((width + 2 * overhang, thickness, depth + 2 * overhang), at=(0, height + thickness / 2, 0))
    inner = box((width - 2 * PARAPET, thickness, depth - 2 * PARAPET), at=(0, height + thickness, 0))
    return (outer - inner).label("roof")


def house(width, depth, height, roof, rise, kink, overhang, thickness):
    """Four walls and a roof. rise: of the roof, above the walls."""
    walls = box((width, height, depth), at=(0, height / 2, 0)).label("walls")
    if roof == "flat":
        return walls | flat_roof(width, depth, height, overhang, thickness)
    if roof == "gable":
        return walls | gable_roof(width, depth, height, rise, kink, overhang, thickness)
    return walls | gable_roof(depth, width, height, rise, kink, overhang, thickness).rotate(90)


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
    wing_width: Annotated[float, Range(0.3, 1.2, when=has_wing)] = 0.7,
    wing_depth: Annotated[float, Range(0.4, 1.2, when=has_wing)] = 0.8,  # of the depth
    wing_height: Annotated[float, Range(0.4, 0.95, when=has_wing)] = 0.6,  # of the walls' height
    wing_rise: Annotated[float, Range(0.1, 0.6, when=lambda p: has_wing(p) and p.wing_roof != "flat")] = 0.3,
    wing_place: Annotated[float, Range(-0.5, 0.5, when=has_wing)] = 0,  # from the back to the front
    roof: Literal["gable", "front gable", "flat", "spire", "dome", "battlements"] = "gable",
    wing: Literal["none", "left", "right"] = "none",
    wing_roof: Annotated[Literal["gable", "front gable", "flat"], When(has_wing)] = "gable",
):
    if roof in ROUND:
        depth, start = 1, 0.25
        whole = tower(height, roof, roof_height, overhang, thickness, narrow)
    else:
        start = 0.45
        whole = house(1, depth, height, roof, roof_height, kink, overhang, thickness)
    if wing == "none":
        return whole
    wide, deep, high = 0.5 + wing_width - start, wing_depth * depth, wing_height * height
    across = deep if wing_roof == "gable" else wide
    added = house(wide, deep, high, wing_roof, wing_rise * across, 0, overhang, thickness)
    added = added.translate((start + wide / 2, 0, wing_place * depth / 2))
    return whole | (added.mirror("x") if wing == "left" else added)
