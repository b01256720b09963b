"""Parts of cups, jugs, bottles and bowls."""

from typing import Annotated

from shapewright.modelling.solids import Solid, Vector, cone, cylinder, ellipse, sphere, sweep
from shapewright.parameters import Range
from shapewright.rules.rule import rule


@rule("beside", turns=4)
def spout(
    size: Vector, mouth: Annotated[float, Range(0.2, 1.0)] = 0.6, thickness: Annotated[float, Range(0.1, 0.5)] = 0.3
) -> Solid:
    """A tube that rises away from the body and grows narrower; mouth: of its width at the body."""
    width, height, depth = size
    path = [(-width / 2, -height / 2, 0), (width / 2, height / 2, 0)]
    return sweep(ellipse(thickness * height, depth, segments=8), path, scale=(1, mouth)).fit(size)


@rule("on")
def lid(
    size: Vector, knob: Annotated[float, Range(0.1, 0.5)] = 0.2, dome: Annotated[float, Range(0.2, 0.8)] = 0.5
) -> Solid:
    """A domed lid with a knob; dome: the part of the height below the knob."""
    width, height, depth = size
    low, ball = dome * height, (1 - dome) * height * 1.2
    cap = sphere((width, 2 * low, depth), (0, -height / 2, 0)) & cylinder(
        (width, low, depth), (0, (low - height) / 2, 0)
    )
    return cap | sphere((knob * width, ball, knob * depth), (0, (height - ball) / 2, 0), segments=12)


@rule("on")
def bottle_neck(
    size: Vector, neck: Annotated[float, Range(0.15, 0.8)] = 0.4, shoulder: Annotated[float, Range(0.1, 0.7)] = 0.4
) -> Solid:
    """A shoulder that grows narrower, and a neck; shoulder: its part of the height."""
    width, height, depth = size
    low = shoulder * height
    shape = cone((width, low, depth), (0, (low - height) / 2, 0), top=neck)
    return shape | cylinder((neck * width, height, neck * depth))


@rule("on")
def flared_rim(size: Vector, neck: Annotated[float, Range(0.3, 0.95)] = 0.7) -> Solid:
    """A neck that grows wider upwards."""
    return cone(size, bottom=neck, top=1)
