"""Plans that are extruded, sheets, and leaves that lean or stand open."""

from math import cos, radians, sin
from typing import Annotated

from shapewright.modelling.solids import Solid, Vector, box, extrude, hull
from shapewright.parameters import Range
from shapewright.rules.rule import rule


@rule("body", turns=4)
def angled_plan(
    size: Vector,
    wing: Annotated[float, Range(0.15, 0.85)] = 0.4,
    back: Annotated[float, Range(0.15, 0.85)] = 0.4,
) -> Solid:
    """A block with an L as its plan; wing: the part of the width, back: the part of the depth that its arms have."""
    width, height, depth = size
    x, z = (wing - 0.5) * width, (back - 0.5) * depth
    left, right, far, near = -width / 2, width / 2, -depth / 2, depth / 2
    return extrude([(left, far), (right, far), (right, z), (x, z), (x, near), (left, near)], height)


@rule("body", turns=4)
def court_plan(
    size: Vector,
    wings: Annotated[float, Range(0.1, 0.45)] = 0.25,
    back: Annotated[float, Range(0.15, 0.85)] = 0.3,
) -> Solid:
    """A block with a U as its plan, open to the front; wings: the width of each, of all; back: its depth."""
    width, height, depth = size
    court = ((1 - 2 * wings) * width, 2 * height, (1 - back) * depth)
    return box(size) - box((court[0], court[1], 2 * court[2]), (0, 0, depth / 2))


@rule("body", turns=4)
def stem_plan(
    size: Vector,
    stem: Annotated[float, Range(0.15, 0.85)] = 0.35,
    back: Annotated[float, Range(0.15, 0.85)] = 0.35,
) -> Solid:
    """A block with a T as its plan; stem: its part of the width; back: the part of the depth that the bar has."""
    width, height, depth = size
    x, z = stem * width / 2, (back - 0.5) * depth
    left, right, far, near = -width / 2, width / 2, -depth / 2, depth / 2
    return extrude([(left, far), (right, far), (right, z), (x, z), (x, near), (-x, near), (-x, z), (left, z)], height)


@rule("body", turns=2)
def polygon_plan(
    size: Vector, sides: Annotated[int, Range(3, 12)] = 6, top: Annotated[float, Range(0.3, 1.0)] = 1.0
) -> Solid:
    """A block with a regular polygon as its plan; top: how wide it is above, of its width below."""
    turns = [radians(360 * (i + 0.5) / sides) for i in range(sides)]
    return extrude([(sin(turn), cos(turn)) for turn in turns], 1, taper=top).fit(size)


@rule("body", turns=4)
def narrowing_plan(size: Vector, front: Annotated[float, Range(0.2, 0.95)] = 0.6) -> Solid:
    """A block that is narrower in front; front: its width there, of that at the back."""
    width, height, depth = size
    x, far, near = width / 2, -depth / 2, depth / 2
    return extrude([(-x, far), (x, far), (front * x, near), (-front * x, near)], height)


@rule("back", turns=2)
def leaning_panel(size: Vector, thickness: Annotated[float, Range(0.02, 0.6)] = 0.15) -> Solid:
    """A panel that leans back; thickness: of the depth."""
    width, height, depth = size
    thick = thickness * depth
    lower = box((width, 0.01 * height, thick), (0, -0.495 * height, (depth - thick) / 2))
    return hull(lower, box((width, 0.01 * height, thick), (0, 0.495 * height, (thick - depth) / 2)))


@rule("back", turns=2)
def bowed_panel(
    size: Vector,
    thickness: Annotated[float, Range(0.05, 0.6)] = 0.2,
    bow: Annotated[float, Range(0.0, 0.6)] = 0.3,
) -> Solid:
    """A panel that leans back and is bowed to the back in the middle; thickness and bow: of the depth."""
    width, height, depth = size
    thick, rise = thickness * depth, bow * depth
    behind = [(x / 8 * width, rise * ((x / 4) ** 2 - 1)) for x in range(-4, 5)]
    plan = [*behind, *((x, z + thick) for x, z in reversed(behind))]
    return extrude(plan, height).path((0, 0, 0), (0, 0, min(thick + rise - depth, 0))).fit(size)


@rule("on", turns=4)
def raised_lid(size: Vector, thickness: Annotated[float, Range(0.02, 0.6)] = 0.15) -> Solid:
    """A flat lid that is hinged at the back and stands open; thickness: of the height."""
    width, height, depth = size
    thick = thickness * height
    hinge = box((width, thick, 0.01 * depth), (0, (thick - height) / 2, -0.495 * depth))
    return hull(hinge, box((width, thick, 0.01 * depth), (0, (height - thick) / 2, 0.495 * depth)))


@rule("front", turns=4)
def open_leaf(size: Vector, thickness: Annotated[float, Range(0.02, 0.6)] = 0.12) -> Solid:
    """A door's leaf that is hinged at its left and stands open to the front; thickness: of the depth."""
    width, height, depth = size
    thick = thickness * depth
    hinge = box((0.01 * width, height, thick), (-0.495 * width, 0, (thick - depth) / 2))
    return hull(hinge, box((0.01 * width, height, thick), (0.495 * width, 0, (depth - thick) / 2)))


@rule("on", turns=2)
def curved_sheet(
    size: Vector,
    thickness: Annotated[float, Range(0.05, 0.5)] = 0.15,
    bend: Annotated[float, Range(30.0, 180.0)] = 120.0,
) -> Solid:
    """A sheet that is bent over to both sides; thickness: of the height; bend: degrees of the arc."""
    turns = [radians(bend * (i / 12 - 0.5)) for i in range(13)]
    rise = 1 - cos(radians(bend / 2))
    outer = [(sin(turn) / sin(radians(min(bend, 180) / 2)), (cos(turn) - 1) / rise) for turn in turns]
    sheet = [*outer, *((x * (1 - thickness), y * (1 - thickness) - thickness) for x, y in reversed(outer))]
    return extrude(sheet, 1).rotate(-90, "x").mirror("z").fit(size)
