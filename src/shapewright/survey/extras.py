"""What stands around a shape and is no part of it: grounds, backdrops, cameras' frustums, small things on top."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

import numpy as np

from shapewright.shapes import Floats, Ints
from shapewright.survey.pieces import Pieces

ExtraKind: TypeAlias = Literal["ground", "backdrop", "frustum", "loose"]
KINDS: tuple[ExtraKind, ...] = get_args(ExtraKind)

_FLAT = 0.01
"""Of its longest side: a sheet is thinner than this."""
_SLAB = 0.04
"""The same of a sheet that may be a ground."""
_WIDER = 1.3
"""How much wider than all else a sheet is, along both of its sides, to be a ground without doubt. See ``found``."""
_NAMED_WIDER = 1.1
"""The same of a sheet whose name says that it is one."""
_FILLED = 0.5
"""Share of its rectangle that a sheet covers. A disc covers .79 of it; four feet cover little."""
_INTO = 0.02
"""How far things stand in a ground, in units of their extent."""
_PLANE = 2e-4
"""Units of the whole's extent: pieces that lie nearer to a sheet's plane are of it, as tiles are."""
_APART = 0.05
"""How far a frustum stands from all else, in units of the whole's extent."""
_PYRAMID = 12
"""Most triangles of a pyramid on a rectangle: six, either side."""
_SMALL = 0.35
"""Of the extent of what it stands on: a loose thing is smaller."""

_WORDS: dict[ExtraKind, str] = {
    "ground": r"ground|floor|terrain|boden|grass|lawn|pavement|ground_?plane|floor_?plane|shadow_?(plane|catcher)",
    "backdrop": r"backdrop|background|back_?ground|cyclorama|cyc|studio|hintergrund|sky(box|dome|sphere)?",
    "frustum": r"camera|cam|frustum|kamera|spotlight|sunlight|lightprobe",
    "loose": r"books?|vases?|plants?|flowers?|cups?|mugs?|bottles?|laptop|monitor|keyboard|tv|candles?|clock|toys?|"
    r"decor(ation)?s?|magazines?|fruits?|plates?|dishes|glasses|shoes?|props?",
}
_CALLED = {"ground": "a ground", "backdrop": "a backdrop", "frustum": "a camera's frustum", "loose": "a loose thing"}
_NAMED = {kind: re.compile(rf"(^|[^a-z])({words})($|[^a-z])") for kind, words in _WORDS.items()}


@dataclass(frozen=True, eq=False)
class Extra:
    """Pieces of a mesh that are no part of its shape, or may be none.

    Attributes:
        kind: what they seem to be.
        pieces: which.
        names: what the file calls them.
        sure: whether there is no doubt.
    """

    kind: ExtraKind
    pieces: Ints
    names: tuple[str, ...]
    sure: bool

    @property
    def words(self) -> str:
        """Such as: a ground 'Plane'."""
        name = "".join(f" {name!r}" for name in self.names[:2])
        count = f" of {len(self.pieces)} pieces" if len(self.pieces) > 1 else ""
        return f"{_CALLED[self.kind]}{name}{count}"


def found(pieces: Pieces) -> list[Extra]:
    """The extras of a mesh, Y up, each piece in one of them at most; what is left is the shape, and never nothing.

    A ground is a sheet below all else, a backdrop one behind or beside all else, either wider than all else.
    """
    extras: list[Extra] = []
    rest = np.arange(len(pieces))
    while True:
        before = len(rest)
        for look in (_frustums, _sheets, _loose):
            for extra in look(pieces, rest):
                if len(left := np.setdiff1d(rest, extra.pieces)):
                    extras.append(extra)
                    rest = left
        if len(rest) == before:
            return extras


def _says(kind: ExtraKind, names: tuple[str, ...]) -> bool:
    spaced = (re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).lower() for name in names)
    return bool(names) and all(_NAMED[kind].search(name) for name in spaced)


def _sheets(pieces: Pieces, rest: Ints) -> Iterator[Extra]:
    """A ground, then backdrops: along each axis from the lower side, the up axis first, then from the upper one."""
    for axis, upper in ((1, False), (2, False), (2, True), (0, False), (0, True)):
        kind: ExtraKind = "ground" if axis == 1 else "backdrop"
        sheet = _sheet(pieces, rest, axis, upper, kind)
        if sheet and len(rest := np.setdiff1d(rest, sheet.pieces)):
            yield sheet


def _sheet(pieces: Pieces, rest: Ints, axis: int, upper: bool, kind: ExtraKind) -> Extra | None:
    """The sheet that lies on one side of all else: the widest piece there, and all that lie in its plane."""
    low, high = pieces.bounds(rest)
    across = [i for i in range(3) if i != axis]
    extent = float((high - low).max())
    beyond = pieces.low[rest, axis] - high[axis] if upper else low[axis] - pieces.high[rest, axis]
    outer = rest[beyond >= -_SLAB * extent]
    if not len(outer):
        return None
    sides = (pieces.high[outer] - pieces.low[outer])[:, across]
    lead = outer[int(sides.prod(axis=1).argmax())]
    bottom, top = pieces.low[lead, axis] - _PLANE * extent, pieces.high[lead, axis] + _PLANE * extent
    inside = (pieces.low[rest, axis] >= bottom) & (pieces.high[rest, axis] <= top)
    some, others = rest[inside], rest[~inside]
    if not len(others):
        return None
    names, (near, far) = pieces.names(some), (pieces.bounds(some), pieces.bounds(others))
    side, around = (near[1] - near[0])[across], far[1] - far[0]
    into = near[0, axis] - far[1, axis] if upper else far[0, axis] - near[1, axis]
    wider = float((side / np.maximum(around[across], 1e-9)).min())
    thin = float(near[1, axis] - near[0, axis]) / float(side.max())
    if wider < _NAMED_WIDER or thin > _SLAB or into < -_INTO * around.max():
        return None
    if _covered(pieces, some, axis) < _FILLED * side.prod():
        return None
    is_called = _says(kind, names) or (kind == "backdrop" and _says("ground", names))
    is_wide = wider >= _WIDER and side.min() >= around.max()
    if not (is_called or is_wide):
        return None
    return Extra(kind, some, names, is_called or (kind == "ground" and thin <= _FLAT))


def _covered(pieces: Pieces, some: Ints, axis: int) -> float:
    """The area that pieces cover, seen along an axis; either side of a sheet counts half where it has two."""
    corners = pieces.mesh.triangles[pieces.faces(some)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, axis] / 2.0
    return float(max(normals[normals > 0].sum(), -normals[normals < 0].sum()))


def _frustums(pieces: Pieces, rest: Ints) -> Iterator[Extra]:
    """Pyramids on a rectangle that stand apart and look at something, and what is called a camera and stands apart."""
    for piece in rest:
        is_called = _says("frustum", pieces.names([piece]))
        if not is_called and pieces.counts[piece] > _PYRAMID:
            continue
        corners = np.unique(np.round(pieces.mesh.triangles[pieces.faces([piece])].reshape(-1, 3), 6), axis=0)
        axis = _pyramid(corners) if len(corners) == 5 else None
        if axis is None and not is_called:
            continue
        others = rest[rest != piece]
        if not len(others):
            return
        low, high = pieces.low[others], pieces.high[others]
        gaps = np.maximum(np.maximum(low - pieces.high[piece], pieces.low[piece] - high), 0.0)
        if np.linalg.norm(gaps, axis=1).min() < _APART:
            continue
        if is_called or (axis is not None and _looks(*axis, pieces.bounds(others))):
            yield Extra("frustum", np.array([piece]), pieces.names([piece]), True)


def _pyramid(corners: Floats) -> tuple[Floats, Floats] | None:
    """The tip of five corners that are a right pyramid on a rectangle, and the middle of its base."""
    for tip in range(5):
        base = np.delete(corners, tip, axis=0)
        middle = base.mean(axis=0)
        spokes, axis = base - middle, middle - corners[tip]
        size = np.linalg.norm(spokes, axis=1)
        length = float(np.linalg.norm(axis))
        is_even = np.ptp(size) < 0.01 * size.max() and length > 0.05 * size.max()
        if is_even and np.abs(spokes @ axis).max() < 0.01 * size.max() * length:
            return corners[tip], middle
    return None


def _looks(tip: Floats, middle: Floats, bounds: Floats) -> bool:
    """Whether the ray from the tip through the middle of the base meets a box."""
    along = np.where(np.abs(middle - tip) < 1e-9, 1e-9, middle - tip)
    first, second = (bounds - tip) / along
    return bool(np.minimum(first, second).max() <= np.maximum(first, second).min())


def _loose(pieces: Pieces, rest: Ints) -> Iterator[Extra]:
    """Small things that are called such, or that stand on the shape, touch nothing else, and have no twin."""
    for piece in rest:
        if _says("loose", names := pieces.names([piece])) and _is_small(pieces, rest, piece):
            yield Extra("loose", np.array([piece]), names, False)


def _is_small(pieces: Pieces, rest: Ints, piece: int) -> bool:
    others = rest[rest != piece]
    if not len(others):
        return False
    whole = np.ptp(pieces.bounds(others), axis=0).max()
    return bool((pieces.high[piece] - pieces.low[piece]).max() < _SMALL * whole)
