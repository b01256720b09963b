"""What furniture stands on: legs, bases, and what joins legs."""

from math import cos, radians, sin
from typing import Annotated

from shapewright.modelling.solids import Solid, Vector, box, cone, cylinder, hull, tapered_leg, turned_leg, union
from shapewright.parameters import Range
from shapewright.rules.rule import rule


@rule("under")
def straight_legs(size: Vector, thickness: Annotated[float, Range(0.04, 0.3)] = 0.1) -> Solid:
    """Four square legs in the corners."""
    width, height, depth = size
    side = thickness * min(width, depth)
    leg = box((side, height, side), ((width - side) / 2, 0, (depth - side) / 2))
    return leg.mirror("x", keep=True).mirror("z", keep=True)


@rule("under")
def tapered_legs(
    size: Vector, thickness: Annotated[float, Range(0.05, 0.3)] = 0.12, foot: Annotated[float, Range(0.3, 0.9)] = 0.5
) -> Solid:
    """Four legs in the corners that grow narrower downwards."""
    width, height, depth = size
    side = thickness * min(width, depth)
    leg = tapered_leg((side, height, side), ((width - side) / 2, 0, (depth - side) / 2), foot)
    return leg.mirror("x", keep=True).mirror("z", keep=True)


@rule("under")
def turned_legs(size: Vector, thickness: Annotated[float, Range(0.05, 0.3)] = 0.12) -> Solid:
    """Four legs in the corners, turned on a lathe."""
    width, height, depth = size
    side = thickness * min(width, depth)
    leg = turned_leg((side, height, side), ((width - side) / 2, 0, (depth - side) / 2))
    return leg.mirror("x", keep=True).mirror("z", keep=True)


@rule("under")
def splayed_legs(
    size: Vector,
    thickness: Annotated[float, Range(0.03, 0.25)] = 0.08,
    splay: Annotated[float, Range(0.05, 0.6)] = 0.25,
) -> Solid:
    """Four legs that stand wider apart at the floor; splay: how far their tops are moved in."""
    width, height, depth = size
    side = thickness * min(width, depth)
    low = (width - side) / 2, (depth - side) / 2
    top = box((side, 0.01 * height, side), (low[0] * (1 - splay), 0.495 * height, low[1] * (1 - splay)))
    foot = box((side, 0.01 * height, side), (low[0], -0.495 * height, low[1]))
    return hull(top, foot).mirror("x", keep=True).mirror("z", keep=True)


@rule("under")
def sled_base(size: Vector, thickness: Annotated[float, Range(0.03, 0.25)] = 0.08) -> Solid:
    """A closed frame at either side."""
    width, height, depth = size
    bar = thickness * min(width, height, depth)
    frame = box((bar, height, depth), ((width - bar) / 2, 0, 0))
    opening = box((2 * bar, height - 2 * bar, depth - 2 * bar), ((width - bar) / 2, 0, 0))
    return (frame - opening).mirror("x", keep=True)


@rule("under", turns=2)
def trestles(
    size: Vector, thickness: Annotated[float, Range(0.04, 0.25)] = 0.1, foot: Annotated[float, Range(0.04, 0.2)] = 0.1
) -> Solid:
    """A post on a long foot at either end, joined by a rail."""
    width, height, depth = size
    side, low = thickness * width, foot * height
    end = (width - side) / 2
    post = box((side, height - low, min(side, depth)), (end, low / 2, 0)) | box(
        (side, low, depth), (end, (low - height) / 2, 0)
    )
    rail = box((width - side, min(side, height / 4), min(side, depth) / 2), (0, -height / 6, 0))
    return post.mirror("x", keep=True) | rail


@rule("under")
def pedestal(
    size: Vector, column: Annotated[float, Range(0.05, 0.6)] = 0.2, foot: Annotated[float, Range(0.03, 0.3)] = 0.08
) -> Solid:
    """A column on a round foot."""
    width, height, depth = size
    low = foot * height
    post = cylinder((column * width, height - low / 2, column * depth), (0, low / 4, 0))
    return post | cylinder((width, low, depth), (0, (low - height) / 2, 0))


@rule("under")
def flared_foot(
    size: Vector, stem: Annotated[float, Range(0.05, 0.5)] = 0.15, foot: Annotated[float, Range(0.1, 0.7)] = 0.3
) -> Solid:
    """A thin stem on a foot that grows wider downwards, as of a wine glass."""
    width, height, depth = size
    low = foot * height
    post = cylinder((stem * width, height, stem * depth))
    return post | cone((width, low, depth), (0, (low - height) / 2, 0), top=stem)


@rule("under")
def star_base(
    size: Vector,
    arms: Annotated[int, Range(3, 6)] = 5,
    breadth: Annotated[float, Range(0.05, 0.25)] = 0.12,
    column: Annotated[float, Range(0.05, 0.4)] = 0.14,
) -> Solid:
    """A column on arms that lie on the floor."""
    width, height, depth = size
    low = min(breadth * width, height / 2)
    arm = box((width / 2, low, breadth * width), (width / 4, (low - height) / 2, 0))
    star = arm.polar_array(arms).fit((width, low, depth), (0, (low - height) / 2, 0))
    return star | cylinder((column * width, height, column * depth))


@rule("under")
def three_legs(size: Vector, thickness: Annotated[float, Range(0.02, 0.15)] = 0.05) -> Solid:
    """A tripod: three bars that meet at the top."""
    width, height, depth = size
    side = thickness * width
    legs = []
    for degrees in (90, 210, 330):
        x, z = cos(radians(degrees)) * (width - side) / 1.75, sin(radians(degrees)) * (depth - side) / 1.5
        foot = box((side, side, side), (x, (side - height) / 2, z - (depth - side) / 6))
        legs.append(hull(box((side, side, side), (0, (height - side) / 2, -(depth - side) / 6)), foot))
    return union(*legs).fit(size)


@rule("under")
def plinth(size: Vector, inset: Annotated[float, Range(0.02, 0.3)] = 0.1) -> Solid:
    """A low block that stands back, under a plate as wide as the space."""
    width, height, depth = size
    plate = box((width, height / 4, depth), (0, 3 * height / 8, 0))
    return plate | box((width * (1 - inset), height, depth * (1 - inset)))


@rule("within")
def crossed_stretchers(size: Vector, thickness: Annotated[float, Range(0.3, 1.0)] = 0.6) -> Solid:
    """Bars between legs like an H: one at either side, one between them."""
    width, height, depth = size
    bar = thickness * height
    side = box((min(bar, width / 4), height, depth), ((width - min(bar, width / 4)) / 2, 0, 0))
    return side.mirror("x", keep=True) | box((width, height, min(bar, depth / 4)))


@rule("within")
def rails_all_round(size: Vector, thickness: Annotated[float, Range(0.3, 1.0)] = 0.6) -> Solid:
    """Four bars between legs, or an apron under a top."""
    width, height, depth = size
    bar = min(thickness * height, min(width, depth) / 4)
    return box(size) - box((width - 2 * bar, 2 * height, depth - 2 * bar))
