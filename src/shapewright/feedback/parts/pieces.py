"""Pieces to add to a shape: primitives that fill a box, perhaps mirrored, in a row or around an axis; their names."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product
from typing import Literal

import numpy as np

from shapewright.modelling.solids import Solid, box, cone, cylinder, slats, sphere
from shapewright.shapes import Floats, Mesh

Kind = Literal[
    "box",
    "cylinder",
    "rod x",
    "rod z",
    "frustum",
    "foot",
    "sphere",
    "slats x",
    "slats y",
    "slats z",
    "spokes",
    "sloping spokes",
]
WIDER_TOP, WIDER_FOOT = 0.55, 0.55
"""Part of the width that the narrow end of a frustum or foot has."""
SPOKES: tuple[Kind, ...] = ("spokes", "sloping spokes")
SLOPE = (0.4, 0.5)
"""Of sloping spokes: the height of their inner ends, of the whole; that of the outer ends, of the inner ones'."""
_THIN, _LONG = 0.3, 2.5  # of the longest side, that a thin one has at most; height over width of a post


@dataclass(frozen=True, eq=False)
class Piece:
    """A primitive that fills a box.

    Spokes are bars from the vertical axis of the box outwards to the ellipse that touches its sides.
    """

    kind: Kind
    low: Floats  # (3,), the corner of the box with the least coordinates
    high: Floats  # (3,), the one with the greatest
    mirrored: tuple[bool, bool] = (False, False)  # whether it also stands beyond the middle, along x and along z
    middle: tuple[float, float] = (0.0, 0.0)  # x and z of the planes about which it is mirrored
    count: int = 1  # of the slats or spokes
    gap: float = 0.0  # between slats, as a part of the whole
    breadth: float = 0.0  # of spokes, as a part of the whole
    turn: float = 0.0  # degrees from x to a spoke

    @property
    def size(self) -> Floats:
        return np.maximum(self.high - self.low, 1e-6)

    @property
    def centre(self) -> Floats:
        return np.asarray((self.low + self.high) / 2.0)

    @property
    def thin(self) -> tuple[bool, ...]:
        """Per axis, whether it is thin for its length."""
        return tuple(bool(extent < _THIN * self.size.max()) for extent in self.size)

    @property
    def key(self) -> tuple[object, ...]:
        """Equal for pieces that are made alike: for the same purpose, very likely."""
        return (self.kind, self.mirrored, self.thin)

    @property
    def noun(self) -> str:
        """What an author might call it."""
        width, height, depth = self.size
        if self.kind.startswith("slats"):
            return "rails" if self.kind == "slats y" else "spindles"
        if self.kind in SPOKES:
            return "spokes"
        several = "s" if any(self.mirrored) else ""
        return _noun(self.kind, self.thin, height / max(width, depth), width >= depth) + several

    @property
    def copies(self) -> list[Piece]:
        """A mirrored piece as pieces of their own."""
        copies = []
        for x, z in product(*((False, True) if mirrored else (False,) for mirrored in self.mirrored)):
            low, high = self.low.copy(), self.high.copy()
            for axis, turned, middle in ((0, x, self.middle[0]), (2, z, self.middle[1])):
                if turned:
                    low[axis], high[axis] = 2 * middle - high[axis], 2 * middle - low[axis]
            copies.append(replace(self, low=low, high=high, mirrored=(False, False)))
        return copies

    def mesh(self) -> Mesh:
        """Its surface, all copies of it."""
        unit = _unit(self.kind, self.count, round(self.gap, 3), round(self.breadth, 2), self.turn)
        solid = unit.scale(tuple(self.size)).translate(tuple(self.centre))
        x, z = self.middle
        if self.mirrored[0]:
            solid = solid.mirror("x", keep=True, about=(x, 0.0, 0.0))
        if self.mirrored[1]:
            solid = solid.mirror("z", keep=True, about=(0.0, 0.0, z))
        return solid.mesh()


@lru_cache(maxsize=256)
def _unit(kind: Kind, count: int, gap: float, breadth: float, turn: float) -> Solid:
    if kind == "cylinder":
        return cylinder(1.0)
    if kind == "rod x":
        return cylinder(1.0).rotate(90.0, "z")
    if kind == "rod z":
        return cylinder(1.0).rotate(90.0, "x")
    if kind == "frustum":
        return cone(1.0, top=1.0, bottom=WIDER_TOP)
    if kind == "foot":
        return cone(1.0, top=WIDER_FOOT, bottom=1.0)
    if kind == "sphere":
        return sphere(1.0)
    if kind == "slats x":
        return slats(1.0, count, gap, "x")
    if kind == "slats y":
        return slats(1.0, count, gap, "y")
    if kind == "slats z":
        return slats(1.0, count, gap, "z")
    if kind == "spokes":
        return _spoke(1.0, breadth).rotate(turn).polar_array(count)
    if kind == "sloping spokes":
        inner, outer = SLOPE
        slope = (0.0, (1.0 - inner) / 2.0, 0.0), (0.0, (inner * outer - 1.0) / 2.0, 0.0)
        return _spoke(inner, breadth).taper((outer, 1.0), "x").path(*slope, axis="x").rotate(turn).polar_array(count)
    return box(1.0)


def _spoke(height: float, breadth: float) -> Solid:
    """From a little behind the axis outwards: opposite ones that only met there would leave slivers."""
    return box(((1.0 + breadth) / 2.0, height, breadth), ((1.0 - breadth) / 4.0, 0.0, 0.0))


def _noun(kind: Kind, thin: tuple[bool, ...], slenderness: float, wide: bool) -> str:
    if kind in ("rod x", "rod z"):
        return "rod"
    if kind == "sphere":
        return "ball"
    if kind != "box":
        return "disc" if slenderness < 0.5 else "column"
    if thin == (True, False, True):
        return "post"
    if sum(thin) == 2:
        return "bar"
    if thin[1]:
        return "plate"
    if sum(thin) == 1:
        return "panel"
    return "block" if slenderness < _LONG else "post"
