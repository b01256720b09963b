"""What a finished box is besides a plain one, and what boxes are part of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from shapewright.modelling.deformation import Deformation
from shapewright.modelling.solid.solid import Solid


@dataclass(frozen=True, slots=True)
class Round:
    """The section across an axis has round corners of this radius, or is an ellipse (None)."""

    axis: int
    radius: float | None


@dataclass(frozen=True, slots=True)
class Fill:
    """A solid of the kit instead of a plain box: ``make(size, at=..., **arguments)``."""

    make: Callable[..., Solid]
    arguments: tuple[tuple[str, Any], ...]


@dataclass(frozen=True, slots=True)
class Group:
    """What is joined before anything else: all of a deformed box, or all that a rule with voids makes."""

    deformations: tuple[Deformation, ...] = ()
    scope: int = 0
