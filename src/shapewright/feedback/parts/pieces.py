"""Pieces to add to a shape: primitives that fill a box, perhaps mirrored, in a row or around an axis; their names."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import product
from typing import Any, Literal

import numpy as np

from shapewright.modelling.arguments import point
from shapewright.modelling.solids import Axis, Solid, Space, box, cone, cylinder, slats, sphere
from shapewright.rules.rule import Rule
from shapewright.shapes import Floats, Mesh

PlainKind = Literal["box", "cylinder", "rod x", "rod z", "frustum", "foot", "sphere"]
Kind = PlainKind | Literal["slats x", "slats y", "slats z", "spokes", "sloping spokes", "rule"]
WIDER_TOP, WIDER_FOOT = 0.55, 0.55
"""Part of the width that the narrow end of a frustum or foot has."""
_PLAIN: dict[Kind, Callable[[], Solid]] = {
    "box": lambda: box(1.0),
    "cylinder": lambda: cylinder(1.0),
    "rod x": lambda: cylinder(1.0).rotate(90.0, "z"),
    "rod z": lambda: cylinder(1.0).rotate(90.0, "x"),
    "frustum": lambda: cone(1.0, top=1.0, bottom=WIDER_TOP),
    "foot": lambda: cone(1.0, top=WIDER_FOOT, bottom=1.0),
    "sphere": lambda: sphere(1.0),
}
SLATS: dict[Kind, Axis] = {"slats x": "x", "slats y": "y", "slats z": "z"}
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
    turn: float = 0.0  # degrees from x to a spoke; by which a rule is turned about y
    rule: Rule | None = None  # of the library, that makes the piece; its kind is "rule"
    arguments: Mapping[str, Any] = field(default_factory=dict)  # of the rule

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
        if self.rule:
            return (self.rule.name, self.turn, self.mirrored)
        return (self.kind, self.mirrored, self.thin)

    @property
    def noun(self) -> str:
        """What an author might call it."""
        if self.rule:
            return self.rule.noun
        if self.kind in SLATS:
            return "rails" if self.kind == "slats y" else "spindles"
        return "spokes" if self.kind in SPOKES else _noun(self) + "s" * any(self.mirrored)

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

    @property
    def outer(self) -> Floats:
        """The box (2, 3) around all its copies."""
        copies = self.copies
        return np.stack([np.min([copy.low for copy in copies], axis=0), np.max([copy.high for copy in copies], axis=0)])

    def mesh(self) -> Mesh:
        """Its surface, all copies of it."""
        if self.rule:
            space = Space(point(self.size), point(self.centre))
            return self._with_copies(space.fill(self.rule, turn=self.turn, **self.arguments)).mesh()
        unit = _unit(self.kind, self.count, round(self.gap, 3), round(self.breadth, 2), self.turn)
        return self._with_copies(unit.scale(tuple(self.size)).translate(tuple(self.centre))).mesh()

    def _with_copies(self, solid: Solid) -> Solid:
        x, z = self.middle
        if self.mirrored[0]:
            solid = solid.mirror("x", keep=True, about=(x, 0.0, 0.0))
        if self.mirrored[1]:
            solid = solid.mirror("z", keep=True, about=(0.0, 0.0, z))
        return solid


@lru_cache(maxsize=256)
def _unit(kind: Kind, count: int, gap: float, breadth: float, turn: float) -> Solid:
    if kind in SLATS:
        return slats(1.0, count, gap, SLATS[kind])
    if kind not in SPOKES:
        return _PLAIN[kind]()
    inner, outer = SLOPE
    spoke = _spoke(1.0 if kind == "spokes" else inner, breadth)
    if kind == "sloping spokes":
        slope = (0.0, (1.0 - inner) / 2.0, 0.0), (0.0, (inner * outer - 1.0) / 2.0, 0.0)
        spoke = spoke.taper((outer, 1.0), "x").path(*slope, axis="x")
    return spoke.rotate(turn).polar_array(count)


def _spoke(height: float, breadth: float) -> Solid:
    """From a little behind the axis outwards: opposite ones that only met there would leave slivers."""
    return box(((1.0 + breadth) / 2.0, height, breadth), ((1.0 - breadth) / 4.0, 0.0, 0.0))


def _noun(piece: Piece) -> str:
    width, height, depth = piece.size
    thin, slenderness = piece.thin, height / max(width, depth)
    if piece.kind != "box":
        names = {"rod x": "rod", "rod z": "rod", "sphere": "ball"}
        return names.get(piece.kind, "disc" if slenderness < 0.5 else "column")
    if thin == (True, False, True):
        return "post"
    if sum(thin) == 2:
        return "bar"
    if thin[1]:
        return "plate"
    if sum(thin) == 1:
        return "panel"
    return "block" if slenderness < _LONG else "post"
