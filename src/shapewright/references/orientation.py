"""Which axes of a file point up and to the front, and the rotation that brings them to +Y and +Z."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from shapewright.references.errors import CollectionError
from shapewright.shapes import Floats

QUARTER_TURNS = tuple(
    np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]], dtype=np.float64) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))
)
"""Rotations about the up axis by 0, 90, 180 and 270 degrees, from the front (+Z) towards the right (+X)."""
AXES = ("x", "y", "z", "-x", "-y", "-z")


AxesBy: TypeAlias = Literal["author", "format", "floor", "default", "found"]
"""Who says which axes of a file point up and to the front: its author, its format, a floor in a scan, nobody; or they
were found."""


@dataclass(frozen=True)
class Orientation:
    """The axes of a file that point up and to the front of its shape; they stand at right angles."""

    up: str = "y"
    front: str = "z"

    def __post_init__(self) -> None:
        for word, axis in (("up", self.up), ("front", self.front)):
            if axis not in AXES:
                raise CollectionError(f"{word}={axis!r} is no axis; use one of {', '.join(AXES)}")
        if self.up[-1] == self.front[-1]:
            raise CollectionError(f"up={self.up!r} and front={self.front!r} are parallel; use two different axes")

    @classmethod
    def of(cls, up: str = "y", front: str | None = None) -> Orientation:
        """The orientation in words: ``up`` and ``front`` among x, y, z, -x, -y, -z, in either case.

        Without ``front`` it is +Z, as in glTF; where up is Z or -Z it is -Y, which the front view of Blender and of CAD
        programs looks at. Raises CollectionError for a word that is no axis, and for two words on one axis.
        """
        up = up.strip().lower().removeprefix("+")
        if front is None:
            front = "-y" if up in ("z", "-z") else "z"
        return cls(up, front.strip().lower().removeprefix("+"))

    @property
    def matrix(self) -> Floats:
        """(3, 3): the rotation from the file's axes to Y up, front +Z; its determinant is +1."""
        up, front = _unit(self.up), _unit(self.front)
        return np.stack([np.cross(up, front), up, front])

    def turned(self, quarters: int) -> Orientation:
        """This orientation and then a number of quarter turns about the up axis, from the front towards the right."""
        return self.then(QUARTER_TURNS[quarters % 4])

    def then(self, turn: Floats) -> Orientation:
        """This orientation and then a turn (3, 3), a rotation by quarter turns about any axes."""
        _, up, front = np.asarray(turn) @ self.matrix
        return Orientation(_axis(up), _axis(front))

    def invert(self, points: ArrayLike) -> Floats:
        """Points (..., 3) back in the axes of the file."""
        return np.asarray(np.asarray(points, dtype=np.float64) @ self.matrix)


def _axis(unit: Floats) -> str:
    return ("-" if unit.min() < 0.0 else "") + "xyz"[int(np.abs(unit).argmax())]


def _unit(axis: str) -> Floats:
    unit = np.zeros(3)
    unit["xyz".index(axis[-1])] = -1.0 if axis.startswith("-") else 1.0
    return unit
