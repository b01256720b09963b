"""The verbs that deform: each is declared once, as a function of what it deforms, and is a method of solids and boxes.

Of a Domain a verb gives the deformation itself. What solids and boxes say in terms of their own (bulge, rotate, deform)
are methods of each.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Protocol, TypeVar

import numpy as np

from shapewright.modelling import arguments
from shapewright.modelling.arguments import Direction, Point, Vector
from shapewright.modelling.curves import TOLERANCE, bernstein
from shapewright.modelling.deformation import Bend, Bulge, Deformation, Domain, Scale, Shift, Twist

R_co = TypeVar("R_co", covariant=True)


class Deformable(Protocol[R_co]):
    """What the verbs deform: a solid, a box of a grammar, or a Domain."""

    @property
    def _domain(self) -> Domain: ...

    def _deformed(self, by: Deformation, tolerance: float) -> R_co: ...


def taper(
    self: Deformable[R_co], scale: float | Sequence[float], axis: Direction = "y", tolerance: float = TOLERANCE
) -> R_co:
    """Narrower or wider along an axis: full at its near (low) end, ``scale`` times as wide at the far end.

    scale: one factor, or one each across (for y: x and z).
    axis: "-y" runs from the top down.
    tolerance: here and below, how far facets of a solid may be from the smooth shape, as a part of the largest extent;
        boxes take that of their derivation.
    """
    return _scaled("taper", self, (1.0, scale), axis, tolerance)


def profile(
    self: Deformable[R_co], *scales: float | Sequence[float], axis: Direction = "y", tolerance: float = TOLERANCE
) -> R_co:
    """As ``taper``, with the factors along the axis on a Bezier curve of these values."""
    if len(scales) < 2:
        raise ValueError("profile: it takes at least two factors, one for each end")
    return _scaled("profile", self, scales, axis, tolerance)


def path(self: Deformable[R_co], *offsets: Vector, axis: Direction = "y", tolerance: float = TOLERANCE) -> R_co:
    """Sections across an axis, moved by offsets (x, y, z) on a Bezier curve of these points; of a box, as it faces."""
    if len(offsets) < 2:
        raise ValueError("path: it takes at least two offsets, one for each end")
    points = [arguments.vector("path", "offset", offset) for offset in offsets]
    fx, fy, fz = self._domain.facing
    along = self._domain.along("path", axis)
    shift = Shift(along, tuple((x * fx, y * fy, z * fz) for x, y, z in points))
    lengthwise = [offset[along.axis] for offset in shift.offsets]
    if any(lengthwise):
        t = np.linspace(0.0, 1.0, 65)
        advance = along.length * t + bernstein([[offset] for offset in lengthwise], t)[:, 0]
        if (np.diff(advance) * along.length <= 0.0).any():
            raise ValueError(f"path: the offsets {list(offsets)!r} fold the box back on itself along {axis}")
    return self._deformed(shift, tolerance)


def twist(self: Deformable[R_co], degrees: float, axis: Direction = "y", tolerance: float = TOLERANCE) -> R_co:
    """Turned about the middle of an axis: not at its near end, by ``degrees`` at the far end."""
    _, sign = self._domain.towards("twist", axis)
    turned = arguments.number("twist", "degrees", degrees) * sign * self._domain.handed
    return self._deformed(Twist(self._domain.along("twist", axis), turned), tolerance)


def bend(
    self: Deformable[R_co],
    degrees: float,
    axis: Direction = "y",
    towards: Direction = "z",
    fixed: float = 0.0,
    tolerance: float = TOLERANCE,
) -> R_co:
    """An axis bent to an arc of its own length, its far end turned by ``degrees`` towards another axis.

    fixed: the place along the axis that stays, 0 for its near end, 0.5 for the middle.
    Raises ValueError when the bend is too tight for the thickness.
    """
    domain = self._domain
    along = domain.along("bend", axis)
    index, sign = domain.towards("bend", towards, "towards")
    turn = arguments.number("bend", "degrees", degrees)
    if index == along.axis:
        raise ValueError(f"bend: axis={axis!r} cannot be bent towards={towards!r}; it must be across")
    if turn < 0.0:
        turn, sign = -turn, -sign
    half = (domain.high[index] - domain.low[index]) / 2.0
    radius = abs(along.length) / math.radians(turn) if turn else math.inf
    if radius <= half:
        raise ValueError(
            f"bend: {degrees:g} degrees over a length of {abs(along.length):.4g} is a radius of {radius:.4g}, "
            f"less than half the thickness ({half:.4g}): the inside would fold"
        )
    return self._deformed(Bend(along, turn, index, sign, arguments.number("bend", "fixed", fixed)), tolerance)


def _scaled(
    function: str, shape: Deformable[R_co], scales: Sequence[float | Sequence[float]], axis: str, tolerance: float
) -> R_co:
    factors = tuple(arguments.pair(function, "scale", scale) for scale in scales)
    if min(min(factor) for factor in factors) <= 0.0:
        raise ValueError(f"{function}: its factors {scales!r} must be positive")
    return shape._deformed(Scale(shape._domain.along(function, axis), factors), tolerance)


def bulge(
    domain: Domain, height: float, face: str, part: tuple[Point, Point] | None = None, round: bool = False
) -> Deformation:
    """See Box.bulge. face: the direction of the side that is pushed out."""
    along = domain.along("bulge", face)
    rise = arguments.number("bulge", "height", height)
    if rise <= -abs(along.length):
        raise ValueError(f"bulge: height={height!r} pushes the side through the other one")
    low, high = part or (domain.low, domain.high)
    u, v = along.across
    return Bulge(along, rise, (low[u], low[v]), (high[u], high[v]), round)
