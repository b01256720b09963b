"""Parts of trees and plants."""

from math import cos, radians, sin
from typing import Annotated

from shapewright.modelling.solids import (
    Solid,
    Vector,
    bezier,
    box,
    cone,
    cylinder,
    ellipse,
    hull,
    prism,
    sphere,
    sweep,
    union,
)
from shapewright.parameters import Range
from shapewright.rules.rule import rule


@rule("on")
def fir_tiers(
    size: Vector,
    count: Annotated[int, Range(2, 6)] = 3,
    narrowing: Annotated[float, Range(0.1, 0.8)] = 0.5,
    overlap: Annotated[float, Range(0.0, 0.6)] = 0.3,
) -> Solid:
    """Cones one above the other; narrowing: of the topmost against the lowest; overlap: of each with the next."""
    width, height, depth = size
    tall = height / (count - overlap * (count - 1))
    tiers = []
    for i in range(count):
        share = 1 - narrowing * i / (count - 1)
        low = -height / 2 + i * tall * (1 - overlap)
        tiers.append(cone((share * width, tall, share * depth), (0, low + tall / 2, 0), segments=12))
    return union(*tiers)


@rule("on")
def round_crown(
    size: Vector, count: Annotated[int, Range(3, 7)] = 4, ball: Annotated[float, Range(0.45, 0.8)] = 0.6
) -> Solid:
    """A ball on top of others in a ring."""
    places = [radians(360 * i / count) for i in range(count)]
    reach = (1 - ball) / 2
    ring = [sphere(ball, (reach * cos(a), ball / 2 - 0.5, reach * sin(a)), segments=12) for a in places]
    crown = union(sphere(ball, (0, 0.5 - ball / 2, 0), segments=12), *ring)
    return crown.fit(size)


@rule("under")
def forked_trunk(
    size: Vector, count: Annotated[int, Range(2, 5)] = 3, thickness: Annotated[float, Range(0.05, 0.3)] = 0.15
) -> Solid:
    """A trunk that divides into branches half way up."""
    trunk = cylinder((thickness, 0.55, thickness), (0, -0.225, 0), segments=8)
    path = bezier((0, 0, 0), (0.1, 0.2, 0), (0.5 - thickness / 2, 0.3, 0), (0.5 - thickness / 2, 0.5, 0))
    branch = sweep(ellipse(0.7 * thickness, 0.7 * thickness, segments=8), path, scale=(1, 0.5))
    tree = trunk | branch.polar_array(count)
    return tree.fit(size)


@rule("on")
def palm_leaves(
    size: Vector, count: Annotated[int, Range(4, 9)] = 6, breadth: Annotated[float, Range(0.06, 0.25)] = 0.14
) -> Solid:
    """Leaves all round that rise and hang down."""
    path = bezier((0, 0, 0), (0.15, 0.5, 0), (0.4, 0.5, 0), (0.5, -0.4, 0))
    leaf = sweep([(-breadth / 2, -0.02), (breadth / 2, -0.02), (0, 0.04)], path, scale=(0.5, 1.4, 0.3))
    leaves = leaf.polar_array(count) | sphere((0.14, 0.2, 0.14), segments=8)
    return leaves.fit(size)


@rule("on")
def bush(size: Vector, sides: Annotated[int, Range(5, 9)] = 6) -> Solid:
    """A crown of few flat sides, widest a third of the way up."""
    middle = prism((1, 0.1, 1), (0, -0.15, 0), sides=sides)
    crown = hull(middle, prism((0.5, 0.02, 0.5), (0, 0.49, 0), sides=sides), box((0.5, 0.02, 0.5), (0, -0.49, 0)))
    return crown.fit(size)
