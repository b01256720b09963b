"""Parts of lamps."""

from math import cos, radians, sin
from typing import Annotated

from shapewright.modelling.solids import Solid, Vector, bezier, cone, ellipse, revolve, sphere, sweep, union
from shapewright.parameters import Range
from shapewright.rules.rule import rule


@rule("on")
def lampshade(
    size: Vector, top: Annotated[float, Range(0.2, 1.0)] = 0.6, wall: Annotated[float, Range(0.02, 0.15)] = 0.06
) -> Solid:
    """A round shade that is open above and below; top: of the width below."""
    width, height, depth = size
    low, high = 0.5, 0.5 * top
    ring = [(low - wall, -0.5), (low, -0.5), (high, 0.5), (max(high - wall, 0.01), 0.5)]
    return revolve(ring).scale((width, height, depth))


@rule("around")
def branched_arms(
    size: Vector, count: Annotated[int, Range(3, 8)] = 5, thickness: Annotated[float, Range(0.02, 0.07)] = 0.04
) -> Solid:
    """Arms all round that hang down and rise to a cup, as of a chandelier."""
    bar, reach = thickness, 0.42
    path = bezier((0, 0.4, 0), (0.2, -0.7, 0), (reach, -0.6, 0), (reach, 0.2, 0))
    arm = sweep(ellipse(bar, bar, segments=6), path)
    arm = arm | cone((0.16, 0.3, 0.16), (reach, 0.3, 0), bottom=0.4, top=1, segments=12)
    arms = arm.polar_array(count)
    return arms.fit(size)


@rule("around")
def globes(
    size: Vector, count: Annotated[int, Range(2, 8)] = 3, ball: Annotated[float, Range(0.15, 0.5)] = 0.3
) -> Solid:
    """Balls in a ring."""
    places = [radians(90 + 360 * i / count) for i in range(count)]
    reach = (1 - ball) / 2
    ring = union(*(sphere((ball, 1, ball), (reach * cos(a), 0, reach * sin(a)), segments=16) for a in places))
    return ring.fit(size)
