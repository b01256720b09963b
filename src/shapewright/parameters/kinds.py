"""Four kinds of parameters: scalar, integer, choice and binary.

A value lives in two forms: in the procedure's own units, and *encoded*: a scalar normalised to [0, 1], any other kind
as the index of its class (METHOD: paper section 4). Every kind here is a small frozen value class with the same verbs;
the numbers, scalar and integer, also say which end of their Range a value rests on and what a longer Range is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Literal, TypeAlias

import numpy as np

Value: TypeAlias = float | int | bool | str
Parameters: TypeAlias = dict[str, Value]
Condition: TypeAlias = Callable[[Any], bool]
Side: TypeAlias = Literal["low", "high"]

_LISTED = 10_000  # whole numbers of a scalar that are listed one by one: a seed may have all that an integer holds
_BEYOND = 0.01  # Share of its Range by which a scalar has to pass an end before it counts as outside. Chosen by hand.


@dataclass(frozen=True)
class Range:
    """Limits of a number in a procedure's signature: ``Annotated[float, Range(0.5, 1.0, steps=8)]``.

    low: the lower end, inclusive, in the procedure's own units.
    high: the upper end, inclusive, in the procedure's own units.
    steps: how many evenly spaced values a scalar is sampled at, or the values themselves (``steps=(0.9, 1.4, 1.6)``);
        without it a scalar is sampled continuously. Integers take every value of their range.
    when: says whether the parameter matters, given all parameters as attributes: ``when=lambda p: p.shelves > 0``.
    log: whether what counts is how many times larger a value is: 0.01 to 0.1 is as far then as 0.1 to 1.
    """

    low: float
    high: float
    steps: int | Sequence[float] | None = None
    when: Condition | None = None
    log: bool = False


@dataclass(frozen=True)
class When:
    """Says when a parameter without a Range matters: ``Annotated[bool, When(lambda p: p.shelves > 0)]``."""

    condition: Condition


@dataclass(frozen=True)
class Seed:
    """Marks a parameter that is chance: ``Annotated[int, Seed()] = 0``. It stays at its default."""


@dataclass(frozen=True)
class Scalar:
    """A number in [low, high], continuous or sampled at ``steps`` values.

    whole: whether its values are whole numbers: integers with many values are predicted as numbers and rounded.
    log: see ``Range``.
    """

    name: str
    low: float
    high: float
    default: float
    steps: int | tuple[float, ...] | None = None
    when: Condition | None = field(default=None, compare=False, repr=False)
    log: bool = False
    whole: bool = False
    classes: ClassVar = 0  # it is predicted as a number, not as one of several classes

    def __post_init__(self) -> None:
        if not (math.isfinite(self.low) and math.isfinite(self.high) and self.low < self.high):
            raise ValueError(f"{self.name}: Range({self.low}, {self.high}) needs two finite ends, the lower one first")
        if isinstance(self.steps, int) and self.steps < 2:
            raise ValueError(f"{self.name}: steps={self.steps} gives no range; use at least 2, or leave steps out")
        if isinstance(self.steps, tuple):
            if len(self.steps) < 2 or len(set(self.steps)) < len(self.steps):
                raise ValueError(f"{self.name}: steps={self.steps} needs at least two values, each once")
            if not all(self.low <= step <= self.high for step in self.steps):
                raise ValueError(f"{self.name}: steps={self.steps} reach outside Range({self.low}, {self.high})")
        if self.log and self.low <= 0.0:
            raise ValueError(f"{self.name}: Range({self.low}, {self.high}, log=True) needs ends above 0")
        _check_default(self, self.low <= self.default <= self.high)

    @property
    def levels(self) -> Sequence[float] | None:
        """The values it is sampled at, or None when sampling is continuous."""
        if isinstance(self.steps, int):
            spread = np.geomspace if self.log else np.linspace
            return tuple(float(level) for level in spread(self.low, self.high, self.steps))
        if self.steps is None and self.whole and self.high - self.low < _LISTED:
            return range(int(self.low), int(self.high) + 1)
        return self.steps

    def sample(self, rng: np.random.Generator) -> float:
        levels = self.levels
        if levels is not None and not (self.log and self.steps is None):
            return levels[int(rng.integers(len(levels)))]
        if self.log or self.whole:
            return self.decode(float(rng.uniform()))
        return float(rng.uniform(self.low, self.high))

    def encode(self, value: Value) -> float:
        if self.log:
            above = max(float(value), self.low * 1e-6)  # a value of another version may be 0 or less
            return math.log(above / self.low) / math.log(self.high / self.low)
        return (float(value) - self.low) / (self.high - self.low)

    def decode(self, encoded: float) -> float:
        """The value nearest to an encoded one, inside the range."""
        share = min(max(float(encoded), 0.0), 1.0)
        if self.log:
            value = min(max(self.low * math.pow(self.high / self.low, share), self.low), self.high)
        else:
            value = self.low + share * (self.high - self.low)
        return round(value) if self.whole else value

    def end_at(self, value: Value, margin: float) -> Side | None:
        """The end of the Range that a value rests on or has passed. margin: a share of the Range, below 0.5."""
        at = self.encode(value)
        return "low" if at <= margin else "high" if at >= 1.0 - margin else None

    def end_passed(self, value: Value) -> Side | None:
        """The end of the Range that a value has passed, by more than rounding."""
        if self.log:
            at = self.encode(value)
            return "low" if at < -_BEYOND else "high" if at > 1.0 + _BEYOND else None
        margin = _BEYOND * (self.high - self.low)
        return "low" if float(value) < self.low - margin else "high" if float(value) > self.high + margin else None

    def widened(self) -> Scalar:
        """The same with a longer Range: by once its length below, twice above; from 0 on it does not come below 0.

        One that counts how many times larger a value is becomes longer by half its length at both ends.
        """
        if self.log:
            half = math.sqrt(self.high / self.low)
            return replace(self, low=self.low / half, high=self.high * half, steps=None)
        span = self.high - self.low
        low = self.low - span
        if self.low >= 0.0:
            low = max(low, self.low / 4.0)
        return replace(self, low=low, high=self.high + 2.0 * span, steps=None)


@dataclass(frozen=True)
class Integer:
    """A whole number in [low, high]; encoded as its offset from low.

    It has no margins: a value rests on an end that it equals, and lies outside from the next whole number on.
    """

    name: str
    low: int
    high: int
    default: int
    when: Condition | None = field(default=None, compare=False, repr=False)
    whole: ClassVar = True

    def __post_init__(self) -> None:
        if self.low != int(self.low) or self.high != int(self.high) or self.low >= self.high:
            raise ValueError(f"{self.name}: Range({self.low}, {self.high}) needs two whole ends, the lower one first")
        _check_default(self, isinstance(self.default, int) and self.low <= self.default <= self.high)

    @property
    def levels(self) -> tuple[int, ...]:
        return tuple(range(self.low, self.high + 1))

    @property
    def classes(self) -> int:
        return self.high - self.low + 1

    def sample(self, rng: np.random.Generator) -> int:
        return int(rng.integers(self.low, self.high + 1))

    def encode(self, value: Value) -> float:
        return float(value) - self.low

    def decode(self, encoded: float) -> int:
        return self.low + min(max(round(float(encoded)), 0), self.classes - 1)

    def end_at(self, value: Value, margin: float = 0.0) -> Side | None:
        """The end of the Range that a value equals or has passed. margin: of scalars; it changes nothing here."""
        return "low" if float(value) <= self.low else "high" if float(value) >= self.high else None

    def end_passed(self, value: Value) -> Side | None:
        """The end of the Range that a value has passed."""
        return "low" if float(value) < self.low else "high" if float(value) > self.high else None

    def widened(self, least: int = 1) -> Integer:
        """The same with a Range longer by its length to either side; from 0 on it does not come below 0, nor 1 to 0.

        least: how many whole numbers are added to a side, at least.
        """
        span = max(self.high - self.low, least)
        low = self.low - span if self.low < 0 else max(self.low - span, min(self.low, 1))
        return replace(self, low=low, high=self.high + span)


MOST_CLASSES = 16
"""Values of an integer up to which each is a class of its own. A hole of 26 widths in millimetres was found to 38 % of
its Range as classes, to 15 % as a number; counts of parts, which have few values, change what the picture shows: 3 to
14 candles round a ring were found to 25 % of that Range as a number."""


def whole_number(
    name: str, low: int, high: int, default: int, when: Condition | None = None, log: bool = False
) -> Parameter:
    """An integer, or where it has many values a scalar of whole numbers."""
    if high - low + 1 <= MOST_CLASSES and not log:
        return Integer(name, low, high, default, when)
    return Scalar(name, low, high, default, None, when, log, whole=True)


@dataclass(frozen=True)
class Choice:
    """One of several options; encoded as the option's index."""

    name: str
    options: tuple[Value, ...]
    default: Value
    when: Condition | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        if len(self.options) < 2 or len(set(self.options)) < len(self.options):
            raise ValueError(f"{self.name}: Literal{list(self.options)} needs at least two options, each once")
        _check_default(self, self.default in self.options)

    @property
    def levels(self) -> tuple[Value, ...]:
        return self.options

    @property
    def classes(self) -> int:
        return len(self.options)

    def sample(self, rng: np.random.Generator) -> Value:
        return self.options[int(rng.integers(len(self.options)))]

    def encode(self, value: Value) -> float:
        return float(self.options.index(value))

    def decode(self, encoded: float) -> Value:
        return self.options[min(max(round(float(encoded)), 0), len(self.options) - 1)]


@dataclass(frozen=True)
class Binary:
    """On or off; encoded as 1 or 0."""

    name: str
    default: bool
    when: Condition | None = field(default=None, compare=False, repr=False)
    levels: ClassVar = (False, True)
    classes: ClassVar = 2

    def __post_init__(self) -> None:
        _check_default(self, isinstance(self.default, bool))

    def sample(self, rng: np.random.Generator) -> bool:
        return bool(rng.integers(2))

    def encode(self, value: Value) -> float:
        return float(bool(value))

    def decode(self, encoded: float) -> bool:
        return float(encoded) >= 0.5


Parameter: TypeAlias = Scalar | Integer | Choice | Binary


def _check_default(parameter: Parameter, inside: bool) -> None:
    if not inside and isinstance(parameter, Scalar | Integer) and isinstance(parameter.default, int | float):
        beyond = max(parameter.low - parameter.default, parameter.default - parameter.high)
        limits = f"Range({parameter.low:g}, {parameter.high:g})"
        raise ValueError(f"{parameter.name}: the default {parameter.default!r} lies outside {limits}, by {beyond:g}")
    if not inside:
        raise ValueError(f"{parameter.name}: the default {parameter.default!r} lies outside what the parameter allows")
