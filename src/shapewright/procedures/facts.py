"""What an author says of all shapes of a procedure: the axis that points up, the unit, and whether sizes count."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Literal, TypeAlias, get_args

import numpy as np

from shapewright.shapes import Drawing, Floats, Shape

Axis: TypeAlias = Literal["x", "y", "z", "-x", "-y", "-z"]
Unit: TypeAlias = Literal["mm", "cm", "m", "in", "ft"]
Size: TypeAlias = Literal["relative", "given"]
METRES: dict[Unit, float] = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
"""Length of each unit in metres."""


@dataclass(frozen=True)
class Facts:
    """What is true of all shapes of a procedure.

    Attributes:
        up: the axis that points up in what the function builds. Where it is z or -z, the front looks towards -y, as in
            CAD and Blender; else towards z.
        unit: of its lengths; None where they have none.
        size: "given" where its lengths mean what they say, so that a replica has to have its reference's size;
            "relative" where only proportions count.

    Raises ValueError for a word that is none of these.
    """

    up: Axis = "y"
    unit: Unit | None = None
    size: Size = "relative"

    def __post_init__(self) -> None:
        for name, value, allowed in (
            ("up", self.up, get_args(Axis)),
            ("unit", self.unit, (*get_args(Unit), None)),
            ("size", self.size, get_args(Size)),
        ):
            if value not in allowed:
                words = ", ".join(str(word) for word in allowed if word)
                raise ValueError(f"{name}={value!r}: use one of {words}")

    @property
    def metres(self) -> float | None:
        """Length of its unit."""
        return METRES[self.unit] if self.unit else None

    @property
    def stated(self) -> dict[str, Any]:
        """Those that differ from the usual ones, by name, for a record."""
        return {name: value for name, value in vars(self).items() if value != getattr(Facts, name)}

    @classmethod
    def of(cls, record: Mapping[str, Any]) -> Facts:
        """The inverse of ``stated``, from a record that may hold other things."""
        return cls(**{field.name: record[field.name] for field in fields(cls) if field.name in record})

    @classmethod
    def written(cls, text: str, usual: Mapping[str, Any]) -> Facts:
        """Those of a text such as ``up=z, unit=mm``; any other is as usual. Raises ValueError for what is no fact."""
        pairs = [part.partition("=") for part in text.replace(",", " ").split()]
        given = {name: value.strip("\"'") for name, _, value in pairs}
        if strange := given.keys() - {field.name for field in fields(cls)}:
            raise ValueError(f"{', '.join(sorted(strange))}: write up, unit or size, as in size=given")
        return cls(**{**usual, **given})

    def stood(self, shape: Shape) -> Shape:
        """What the function built, Y up, front towards +Z; a drawing stays as it is."""
        if self.up == "y" or isinstance(shape, Drawing):
            return shape
        return shape.transformed(self._matrix)

    def laid(self, shape: Shape) -> Shape:
        """The inverse of ``stood``: in the axes of the function."""
        if self.up == "y" or isinstance(shape, Drawing):
            return shape
        return shape.transformed(self._matrix.T)

    @property
    def _matrix(self) -> Floats:
        """(3, 3): the rotation to Y up, front +Z."""
        up, front = _unit(self.up), _unit("-y" if self.up[-1] == "z" else "z")
        return np.stack([np.cross(up, front), up, front])


def _unit(axis: str) -> Floats:
    unit = np.zeros(3)
    unit["xyz".index(axis[-1])] = -1.0 if axis.startswith("-") else 1.0
    return unit
