"""Checking of the arguments that modelling functions take; the message of an error names the function and argument."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Literal, TypeAlias

import numpy as np

from shapewright.shapes import Floats

Axis: TypeAlias = Literal["x", "y", "z"]
Direction: TypeAlias = Literal["x", "y", "z", "-x", "-y", "-z"]
Side: TypeAlias = Literal["left", "right", "bottom", "top", "back", "front"]
Vector: TypeAlias = Sequence[float] | Floats
Point: TypeAlias = tuple[float, float, float]

ORIGIN = (0.0, 0.0, 0.0)
SIDES: tuple[Side, ...] = ("left", "right", "bottom", "top", "back", "front")
_AXES = ("x", "y", "z")


def number(function: str, name: str, value: float) -> float:
    result = float(value)
    if not math.isfinite(result):
        raise ValueError(f"{function}: {name}={value!r} must be finite")
    return result


def positive(function: str, name: str, value: float) -> float:
    result = number(function, name, value)
    if result <= 0.0:
        raise ValueError(f"{function}: {name}={value!r} must be positive")
    return result


def count(function: str, value: int, least: int, name: str = "count") -> int:
    if value != int(value) or value < least:
        raise ValueError(f"{function}: {name}={value!r} must be a whole number of at least {least}")
    return int(value)


def point(values: Iterable[float]) -> Point:
    x, y, z = map(float, values)
    return x, y, z


def vector(function: str, name: str, value: Vector) -> Point:
    try:
        x, y, z = point(value)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{function}: {name}={value!r} must be three numbers (x, y, z)") from error
    if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(z)):
        raise ValueError(f"{function}: {name}={value!r} must be finite")
    return x, y, z


def size(function: str, value: float | Vector, name: str = "size") -> Point:
    """Three positive extents; one number stands for three equal ones."""
    extents = value if isinstance(value, Sequence | np.ndarray) else (value, value, value)
    x, y, z = vector(function, name, extents)
    if min(x, y, z) <= 0.0:
        raise ValueError(f"{function}: {name}={value!r} must be positive")
    return x, y, z


def pair(function: str, name: str, value: float | Sequence[float]) -> tuple[float, float]:
    """Two numbers; one stands for two equal ones."""
    both = tuple(value) if isinstance(value, Sequence | np.ndarray) else (value, value)
    if len(both) != 2:
        raise ValueError(f"{function}: {name}={value!r} must be one number or two")
    return number(function, name, both[0]), number(function, name, both[1])


def axis(function: str, value: str, name: str = "axis") -> int:
    """The index of an axis."""
    if value not in _AXES:
        raise ValueError(f"{function}: {name}={value!r} must be 'x', 'y' or 'z'")
    return _AXES.index(value)


def direction(function: str, value: str, name: str = "axis") -> tuple[int, int]:
    """The index of an axis, and 1 along it or -1 against it."""
    if value.removeprefix("-") not in _AXES:
        raise ValueError(f"{function}: {name}={value!r} must be 'x', 'y', 'z', '-x', '-y' or '-z'")
    return _AXES.index(value[-1]), -1 if value.startswith("-") else 1


def side(function: str, value: str) -> tuple[int, int]:
    """The index of a side's axis, and 0 for its low or 1 for its high end."""
    if value not in SIDES:
        raise ValueError(f"{function}: {value!r} must be one of {', '.join(SIDES)}")
    return divmod(SIDES.index(value), 2)
