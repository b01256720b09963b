"""Tables, version 1: a rectangular or oval top on four legs."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.grammar import Grammar

rules = Grammar()


@rules.rule("table")
def parts(box, thickness, overhang, oval):
    below, top = box.split("y", ..., thickness)
    yield (top.round() if oval else top).tag("top")
    # Legs under an oval top stand on the largest rectangle inside it, or a little closer.
    inside = 0.16 if oval else 0.0
    yield below.inset(x=inside * box.width + overhang, z=inside * box.depth + overhang).tag("base")


@rules.rule("base")
def four_legs(box, leg):
    for corner in box.corners(leg):
        yield corner.tag("legs")


@procedure
def table(
    height: Annotated[float, Range(0.15, 1.3)] = 0.7,  # width is 1
    depth: Annotated[float, Range(0.3, 1.0)] = 0.6,
    thickness: Annotated[float, Range(0.02, 0.1)] = 0.04,
    leg: Annotated[float, Range(0.02, 0.09)] = 0.05,
    overhang: Annotated[float, Range(0.0, 0.05)] = 0.01,
    oval: bool = False,
):
    """A table one unit wide; other lengths are in that unit unless they say of what they are a part."""
    return rules.derive((1, height, depth), **locals())
