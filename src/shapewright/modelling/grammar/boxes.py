"""Boxes to write rules with: they are divided into boxes, become patches, and are deformed.

A box faces along each axis with one of its sides: its left and right, bottom and top, back and front are named, and
its pieces counted, as it faces. A new box faces as space does: right is +x, top is +y, front is +z. A patch is a box
without thickness along one axis, and faces away from the box whose side it is. A box never changes: each verb returns
new ones, and raises ValueError when a size would be negative.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from shapewright.modelling import arguments, deformation, verbs
from shapewright.modelling.arguments import Axis, Direction, Point, Side, Vector, point
from shapewright.modelling.curves import TOLERANCE
from shapewright.modelling.deformation import Deformation, Domain
from shapewright.modelling.grammar import divisions
from shapewright.modelling.grammar.divisions import ROUNDING, Size
from shapewright.modelling.grammar.forms import Fields, Fill, Group, Round, replaced
from shapewright.modelling.solid.solid import Solid
from shapewright.shapes import Floats


class Box(Fields):
    """A box in space, or in the space of the deformed box that it is part of."""

    __slots__ = ()

    @property
    def size(self) -> Point:
        (ax, ay, az), (bx, by, bz) = self.low, self.high
        return bx - ax, by - ay, bz - az

    @property
    def width(self) -> float:
        return self.high[0] - self.low[0]

    @property
    def height(self) -> float:
        return self.high[1] - self.low[1]

    @property
    def depth(self) -> float:
        return self.high[2] - self.low[2]

    def tag(self, symbol: str) -> Box:
        """The box with a tag: the rules for it apply next; without any, the box is done and the tag is its label."""
        return self._replace(symbol=symbol)

    def label(self, name: str, *sides: Side) -> Box:
        """A label for all that the box becomes, instead of tags; or for some sides of a box that no rule divides."""
        for side in sides:
            arguments.side("label", side)
        mine = {key: value for key, value in self.names if key not in (sides or (None,))}
        return self._replace(names=(*mine.items(), *((side, name) for side in sides or (None,))))

    def void(self) -> Box:
        """A hole: all that the box becomes is cut out of what the same rule makes besides."""
        return self._replace(is_void=True)

    def round(self, radius: float | None = None, axis: Axis = "y") -> Box:
        """The edges along an axis rounded by a radius; without one as far as it goes, to an ellipse.

        For a box that no rule divides; facets are as many as the curve needs.
        """
        index = arguments.axis("round", axis)
        most = min(extent for d, extent in enumerate(self.size) if d != index) / 2.0
        if radius is not None and not 0.0 <= arguments.number("round", "radius", radius) <= most + ROUNDING:
            raise ValueError(f"round: radius={radius!r} must lie in 0..{most:.4g}, half the lesser extent")
        return self._replace(form=Round(index, radius) if radius != 0.0 else None)

    def fill(self, make: Callable[..., Solid], **arguments: Any) -> Box:
        """A solid instead of a plain box: of any function ``make(size, at=..., **arguments)``, such as ``cylinder``.

        The solid faces as the box does. Its own labels are kept where the box has none.
        """
        return self._replace(form=Fill(make, tuple(arguments.items())))

    # Where it is

    def move(self, by: Vector) -> Box:
        """The box moved by (x, y, z), as it faces."""
        if self.deformations:
            raise ValueError("move: a box that is deformed cannot be moved; move it first")
        step = np.multiply(arguments.vector("move", "by", by), self.facing)
        return self._replace(low=point(step + self.low), high=point(step + self.high))

    def flip(self, axis: Axis) -> Box:
        """The box facing the other way along an axis: what is made in it is mirrored."""
        index = arguments.axis("flip", axis)
        return self._replace(facing=replaced(self.facing, index, -self.facing[index]))

    # Dividing it

    def split(self, axis: Direction, *sizes: Size) -> list[Box]:
        """Pieces along an axis, one for each size: left to right, bottom to top, back to front ("-x": the other way).

        A number is a length; ``...`` and ``share(weight)`` divide what the lengths leave. Without any of these the
        lengths may leave some of the box unused.
        """
        return self._pieces("split", axis, lambda whole: divisions.split(whole, sizes))

    def repeat(
        self, axis: Direction, count: int | None = None, size: float | None = None, gap: float | None = None
    ) -> list[Box]:
        """Equal pieces along an axis with equal gaps between them, which fill it.

        Two of the three are given, or the count or the size alone (then without gaps): ``count`` and ``gap`` leave the
        size to be found, ``count`` and ``size`` the gap; ``size`` and ``gap`` the number that fits best, and then the
        pieces are stretched to fill the axis.
        """
        return self._pieces("repeat", axis, lambda whole: divisions.repeat(whole, count, size, gap))

    def inset(
        self,
        *,
        x: float | tuple[float, float] = 0.0,
        y: float | tuple[float, float] = 0.0,
        z: float | tuple[float, float] = 0.0,
    ) -> Box:
        """The box smaller by so much at either end of an axis, or by (near, far): left, bottom and back are near.

        Negative: larger.
        """
        low, high = list(self.low), list(self.high)
        for index, margin in enumerate((x, y, z)):
            if margin != 0.0:
                near, far = arguments.pair("inset", "xyz"[index], margin)[:: self.facing[index]]
                low[index], high[index] = low[index] + near, high[index] - far
        return self._part("inset", point(low), point(high))

    def sub(self, size: Sequence[float | None], anchor: Vector = (0.5, 0.5, 0.5)) -> Box:
        """A box of its own size at a place in this one.

        size: (width, height, depth), None for that of this box. anchor: where, along each axis: 0 at the near end
        (left, bottom, back), 1 at the far end, 0.5 in the middle.
        """
        low, high = list(self.low), list(self.high)
        for index, (extent, place) in enumerate(zip(size, arguments.vector("sub", "anchor", anchor), strict=True)):
            if extent is not None:
                room = self.high[index] - self.low[index] - extent
                start = room * (place if self.facing[index] > 0 else 1.0 - place)
                low[index] = self.low[index] + start
                high[index] = self.high[index] if start == room else low[index] + extent
        return self._part("sub", point(low), point(high))

    def ends(self, axis: Axis, size: float) -> tuple[Box, Box]:
        """The near and the far end of an axis, ``size`` long; each faces outwards, so they are mirror images."""
        index, sign = self._domain.towards("ends", axis)
        if not 0.0 <= arguments.number("ends", "size", size) <= self.size[index]:
            raise ValueError(f"ends: size={size:.4g} along {axis} must lie in 0..{self.size[index]:.4g}")
        near = self._between("ends", index, sign, 0.0, size)
        far = self._between("ends", index, -sign, 0.0, size)
        inwards, outwards = replaced(self.facing, index, -sign), replaced(self.facing, index, sign)
        return near._replace(facing=inwards), far._replace(facing=outwards)

    def corners(self, size: float | tuple[float, float], axis: Axis = "y") -> list[Box]:
        """The four corners along an axis, such as legs; ``size``: of the section, one number or two.

        Each faces outwards, so they are mirror images. For y: back left, back right, front left, front right.
        """
        first, second = _across(axis)
        u, v = arguments.pair("corners", "size", size)
        return [corner for row in self.ends(second, v) for corner in row.ends(first, u)]

    def rails(self, corner: float | tuple[float, float], thickness: float | None = None, axis: Axis = "y") -> list[Box]:
        """The four boxes that run from corner to corner around an axis, such as the rails of a table.

        corner: the section of the corners, as in ``corners``. thickness: across, that of the corners by default. Each
        faces outwards. For y: back, front, left, right.
        """
        first, second = _across(axis)
        u, v = arguments.pair("rails", "corner", corner)
        along = self.inset(**{first: u}).ends(second, v if thickness is None else thickness)
        across = self.inset(**{second: v}).ends(first, u if thickness is None else thickness)
        return [*along, *across]

    # Patches

    def face(self, side: Side) -> Box:
        """The patch on a side: a box without thickness that faces outwards."""
        index, sign = self._side_direction(side)
        at = self.high[index] if sign > 0 else self.low[index]
        patch = self._part("face", replaced(self.low, index, at), replaced(self.high, index, at))
        return patch._replace(facing=replaced(self.facing, index, sign))

    def extrude(self, height: float) -> Box:
        """A patch given thickness, outwards; a negative height goes inwards, into the box whose side it is."""
        index = self._thin("extrude: only a patch, a box without thickness along one axis, can be extruded")
        step = arguments.number("extrude", "height", height) * self.facing[index]
        a, b = sorted((self.low[index], self.low[index] + step))
        return self._part("extrude", replaced(self.low, index, a), replaced(self.high, index, b))

    # Deforming it, and with it all that it is divided into

    taper = verbs.taper
    profile = verbs.profile
    path = verbs.path
    twist = verbs.twist
    bend = verbs.bend

    def bulge(self, height: float, on: Side | Box = "top") -> Box:
        """A side, or a patch of one, pushed out in the middle by ``height`` (negative: in) and not at its edges."""
        if isinstance(on, Box):
            index = on._thin("bulge: give a side, or a patch of one")
            sign, part, round_ = on.facing[index], (on.low, on.high), False
        else:
            (index, sign), part = self._side_direction(on), None
            round_ = isinstance(self.form, Round) and self.form.radius is None and self.form.axis == index
        face = "xyz"[index] if sign == self.facing[index] else f"-{'xyz'[index]}"
        return self._deformed(verbs.bulge(self._domain, height, face, part, round_))

    def rotate(self, degrees: float, axis: Direction = "y", about: Vector = (0.5, 0.5, 0.5)) -> Box:
        """Turned about an axis through a place in the box: 0 to 1 along each axis, from left, bottom and back."""
        shares = arguments.vector("rotate", "about", about)
        index, sign = self._domain.towards("rotate", axis)
        turned = arguments.number("rotate", "degrees", degrees) * sign * self._domain.handed
        place = [
            low + (high - low) * (share if facing > 0 else 1.0 - share)
            for low, high, facing, share in zip(self.low, self.high, self.facing, shares, strict=True)
        ]
        return self._deformed(deformation.Turn(index, turned, point(place)))

    def deform(self, function: Callable[[Floats], Floats]) -> Box:
        """Every point moved by a function of points (N, 3), relative to the middle of the box, as the box faces."""
        return self._deformed(deformation.Free(function, self._domain.centre, self.facing))

    def within(self) -> Box:
        """The space inside the box, before its deformations: what its rule is given to divide."""
        return Box(self.low, self.high, self.facing, "", self.names, self.form, (), self._inner_groups, self.is_void)

    @property
    def _inner_groups(self) -> tuple[Group, ...]:
        return (*self.groups, Group(self.deformations)) if self.deformations else self.groups

    @property
    def _domain(self) -> Domain:
        return Domain(self.low, self.high, self.facing)

    def _deformed(self, by: Deformation, tolerance: float = TOLERANCE) -> Box:
        if tolerance != TOLERANCE:
            raise ValueError(f"deform: tolerance={tolerance!r} is for solids; boxes take that of derive(tolerance=...)")
        if isinstance(by, deformation.Bend) and by.degrees == 0.0:
            return self
        return self._replace(deformations=(*self.deformations, by))

    def _thin(self, refusal: str) -> int:
        """The axis along which a patch has no thickness."""
        flat = [axis for axis, extent in enumerate(self.size) if extent == 0.0]
        if len(flat) != 1:
            raise ValueError(refusal)
        return flat[0]

    def _side_direction(self, side: Side) -> tuple[int, int]:
        index, sign = arguments.side("face", side)
        return index, self.facing[index] * (1 if sign else -1)

    def _pieces(self, verb: str, axis: str, divide: Callable[[float], list[tuple[float, float]]]) -> list[Box]:
        index, sign = self._domain.towards(verb, axis)
        whole = self.high[index] - self.low[index]
        try:
            ends = divide(whole)
        except ValueError as error:
            raise ValueError(f"{verb} along {axis}: {error}") from error
        return [self._between(verb, index, sign, start, end) for start, end in ends]

    def _between(self, verb: str, index: int, sign: int, start: float, end: float) -> Box:
        """The piece between two lengths from an end of an axis; neighbours meet in exactly the same coordinate."""
        near, far = (self.low[index], self.high[index])[::sign]
        whole = self.high[index] - self.low[index]
        first = far if start == whole else near + sign * start
        last = far if end == whole else near + sign * end
        if sign < 0:
            first, last = last, first
        return self._part(verb, replaced(self.low, index, first), replaced(self.high, index, last))

    def _part(self, verb: str, low: Point, high: Point) -> Box:
        """A box within the deformations of this one, which keeps its label."""
        if self.form:
            raise ValueError(f"{verb}: a box that is rounded or filled cannot be divided or moved; do that first")
        if high[0] < low[0] or high[1] < low[1] or high[2] < low[2]:
            size = " x ".join(f"{b - a:.4g}" for a, b in zip(low, high, strict=True))
            raise ValueError(f"{verb}: a box of {size} would have a negative size")
        whole = tuple(entry for entry in self.names if entry[0] is None) if self.names else ()
        return Box(low, high, self.facing, "", whole, None, (), self._inner_groups, self.is_void)

    def __str__(self) -> str:
        size = " x ".join(f"{extent:.4g}" for extent in self.size)
        least = ROUNDING * max(self.size)
        centre = ", ".join(f"{middle if abs(middle) > least else 0.0:.4g}" for middle in self._domain.centre)
        return f"{size} at ({centre})"


def _across(axis: Axis) -> tuple[Axis, Axis]:
    return ("y", "z") if axis == "x" else ("x", "z") if axis == "y" else ("x", "y")
