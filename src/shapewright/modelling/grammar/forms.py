"""What a box of a grammar consists of: its place, how it is rounded or filled, and what it is part of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar

from shapewright.modelling.arguments import Point, Side
from shapewright.modelling.deformation import Deformation
from shapewright.modelling.solid.solid import Solid

T = TypeVar("T")


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


class Fields(NamedTuple):
    """What a box holds. A named tuple, because most of the time of a derivation goes into making boxes."""

    low: Point  # its corner with the least coordinates
    high: Point  # its corner with the greatest
    facing: tuple[int, int, int] = (1, 1, 1)  # 1, or -1 for each axis against which it faces
    symbol: str = ""  # the tag that decides which rules apply to it
    names: tuple[tuple[Side | None, str], ...] = ()  # its label (under None) and those of single sides
    form: Round | Fill | None = None  # how it is rounded or filled
    deformations: tuple[Deformation, ...] = ()  # its own, the first first
    groups: tuple[Group, ...] = ()  # those that it is part of, the outermost first
    is_void: bool = False  # whether it is cut out of what the same rule makes besides


def replaced(values: tuple[T, T, T], index: int, value: T) -> tuple[T, T, T]:
    """Three values, of which one is another."""
    a, b, c = values
    return (value, b, c) if index == 0 else (a, value, c) if index == 1 else (a, b, value)
