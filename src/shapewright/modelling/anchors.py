"""Anchors: where a solid goes, said by the parts that are there already: within one, on it, under it, between two.

An anchor gives a Space, a box in which a solid is made:

    shelf = within(table.part("legs"), (None, 0.02, None), y=0.3).fill(box).label("shelf")
    back = on(seat, (None, 0.4, 0.03), z="back").fill(box)

A part is anything with bounds: a solid, a derivation, or a Space. ``size`` is (width, height, depth): None takes the
whole extent of the part, one number stands for three equal ones. ``x``, ``y`` and ``z`` say where the space lies along
each axis: a number for its centre, from 0 at the low side of the part to 1 at the high side; a side that it touches
from inside ("left" or "right", "bottom" or "top", "back" or "front"); or another part, whose extent along this axis it
takes instead.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np

from shapewright.modelling import arguments
from shapewright.modelling.arguments import SIDES, Axis, Point, Side, point
from shapewright.modelling.solid.solid import Solid
from shapewright.shapes import Floats


class Bounded(Protocol):
    """What has bounds (2, 3): the least and the greatest corner."""

    @property
    def bounds(self) -> Floats: ...


Place: TypeAlias = float | Side | Bounded
Size: TypeAlias = float | Sequence[float | None] | None


class Space(NamedTuple):
    """A box in space to make a solid in.

    Attributes:
        size: its width, height and depth.
        at: its centre.
    """

    size: Point
    at: Point

    @property
    def width(self) -> float:
        return self.size[0]

    @property
    def height(self) -> float:
        return self.size[1]

    @property
    def depth(self) -> float:
        return self.size[2]

    @property
    def bounds(self) -> Floats:
        """(2, 3): the least and the greatest corner."""
        half = np.array(self.size) / 2.0
        return np.stack([self.at - half, self.at + half])

    def fill(self, make: Callable[..., Solid], along: Axis = "y", turn: float = 0.0, **arguments_: Any) -> Solid:
        """The solid ``make(size, **arguments)`` that fills the space, such as ``fill(cylinder)``.

        make: builds about the origin, or about ``at`` where it has such a parameter.

        along: the axis on which what is made upright lies, such as ``fill(cylinder, along="x")`` for a rod.
        turn: degrees about y by which what is made is turned, a multiple of 90: what faces right faces back at 90.
        Raises ValueError that names the argument.
        """
        axis, quarters = arguments.axis("fill", along, "along"), arguments.number("fill", "turn", turn) / 90.0
        if quarters % 1.0:
            raise ValueError(f"fill: turn={turn!r} must be a multiple of 90")
        width, height, depth = self.size
        upright = ((height, width, depth), (width, height, depth), (width, depth, height))[axis]
        if axis == 1 and not quarters and "at" in inspect.signature(make).parameters:
            return make(self.size, at=self.at, **arguments_)
        if quarters % 2.0:
            upright = upright[::-1]
        made = make(upright, **arguments_)
        made = made.rotate(turn) if quarters else made
        made = made if axis == 1 else made.rotate(90.0, "z" if axis == 0 else "x")
        return made.translate(self.at)


def within(part: Bounded, size: Size = None, x: Place = 0.5, y: Place = 0.5, z: Place = 0.5) -> Space:
    """The space inside a part; without a size as large as the part. Raises ValueError that names the argument."""
    return _space("within", part, size, (x, y, z))


def on(part: Bounded, size: Size, x: Place = 0.5, y: Place = 0.5, z: Place = 0.5, side: Side = "top") -> Space:
    """The space that stands on a side of a part, outside; along the axis of the side it is as long as ``size`` says.

    Raises ValueError that names the argument.
    """
    return _space("on", part, size, (x, y, z), side)


def under(part: Bounded, size: Size, x: Place = 0.5, z: Place = 0.5) -> Space:
    """The space that hangs below a part. Raises ValueError that names the argument."""
    return _space("under", part, size, (x, 0.5, z), "bottom")


def between(first: Bounded, second: Bounded) -> Space:
    """The space between two parts: along each axis the gap where they are apart, and what they share where not."""
    (a, b), (c, d) = first.bounds, second.bounds
    low, high = np.maximum(a, c), np.minimum(b, d)
    return _spanning(np.minimum(low, high), np.maximum(low, high))


def face(part: Bounded, side: Side) -> Space:
    """The side of a part, as a space without thickness: ``between(face(table, "bottom"), top)`` starts at the floor."""
    axis, end = arguments.side("face: side", side)
    bounds = np.array(part.bounds)
    bounds[:, axis] = bounds[end, axis]
    return _spanning(*bounds)


def _spanning(low: Floats, high: Floats) -> Space:
    return Space(point(high - low), point((low + high) / 2.0))


def _space(function: str, part: Bounded, size: Size, places: Sequence[Place], outside: Side | None = None) -> Space:
    """outside: the side of the part that the space stands on, None where it is inside."""
    bounds = part.bounds
    lengths = size if isinstance(size, Sequence | np.ndarray) else (size, size, size)
    if len(lengths) != 3:
        raise ValueError(f"{function}: size={size!r} must be (width, height, depth), None for the whole extent")
    space = [_along(function, axis, bounds[:, axis], lengths[axis], places[axis]) for axis in range(3)]
    if outside:
        axis, end = arguments.side(f"{function}: side", outside)
        extent, _ = space[axis]
        if lengths[axis] is None:
            raise ValueError(f"{function}: size={size!r} must say how far the space reaches from the {outside}")
        space[axis] = extent, float(bounds[end, axis]) + (extent / 2.0 if end else -extent / 2.0)
    extents, centres = zip(*space, strict=True)
    return Space(point(extents), point(centres))


def _along(function: str, axis: int, ends: Floats, length: float | None, place: Place) -> tuple[float, float]:
    """The extent and the centre of a space along an axis of the part that it is in."""
    name = "xyz"[axis]
    if not isinstance(place, str | int | float | np.number):
        ends, place = place.bounds[:, axis], 0.5
    low, high = map(float, ends)
    extent = high - low if length is None else arguments.positive(function, "size", length)
    if not isinstance(place, str):
        return extent, low + arguments.number(function, name, place) * (high - low)
    near, far = SIDES[2 * axis : 2 * axis + 2]
    if place not in (near, far):
        raise ValueError(f"{function}: {name}={place!r} must be a number, {near!r}, {far!r} or a part")
    return extent, high - extent / 2.0 if place == far else low + extent / 2.0
