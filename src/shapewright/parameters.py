"""The parameter space of a procedure: four kinds of parameters and the ordered set of them.

A value lives in two forms: in the procedure's own units, and *encoded*: a scalar normalised to [0, 1], any other kind
as the index of its class (METHOD: paper section 4). Every kind here is a small frozen value class with the same verbs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Value: TypeAlias = float | int | bool | str
Parameters: TypeAlias = dict[str, Value]
Condition: TypeAlias = Callable[[Any], bool]

_ENUMERABLE = 20_000
_DRAWS_PER_VECTOR = 200


@dataclass(frozen=True)
class Range:
    """Limits of a number in a procedure's signature: ``Annotated[float, Range(0.5, 1.0, steps=8)]``.

    low, high: inclusive ends, in the procedure's own units.
    steps: how many evenly spaced values a scalar is sampled at, or the values themselves (``steps=(0.9, 1.4, 1.6)``);
        without it a scalar is sampled continuously. Integers take every value of their range.
    when: says whether the parameter matters, given all parameters as attributes: ``when=lambda p: p.shelves > 0``.
    """

    low: float
    high: float
    steps: int | Sequence[float] | None = None
    when: Condition | None = None


@dataclass(frozen=True)
class When:
    """Says when a parameter without a Range matters: ``Annotated[bool, When(lambda p: p.shelves > 0)]``."""

    condition: Condition


@dataclass(frozen=True)
class Scalar:
    """A continuous parameter in [low, high], sampled at ``steps`` values if given."""

    name: str
    low: float
    high: float
    default: float
    steps: int | tuple[float, ...] | None = None
    when: Condition | None = field(default=None, compare=False, repr=False)

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
        _check_default(self, self.low <= self.default <= self.high)

    @property
    def levels(self) -> tuple[float, ...] | None:
        """The values it is sampled at, or None when sampling is continuous."""
        if isinstance(self.steps, int):
            return tuple(float(level) for level in np.linspace(self.low, self.high, self.steps))
        return self.steps

    @property
    def classes(self) -> int:
        """0: a scalar is predicted as a number, not as one of several classes."""
        return 0

    def sample(self, rng: np.random.Generator) -> float:
        levels = self.levels
        return float(rng.uniform(self.low, self.high)) if levels is None else levels[int(rng.integers(len(levels)))]

    def encode(self, value: Value) -> float:
        return (float(value) - self.low) / (self.high - self.low)

    def decode(self, encoded: float) -> float:
        """The value nearest to an encoded one, inside the range."""
        return self.low + min(max(float(encoded), 0.0), 1.0) * (self.high - self.low)


@dataclass(frozen=True)
class Integer:
    """A whole number in [low, high]; encoded as its offset from low."""

    name: str
    low: int
    high: int
    default: int
    when: Condition | None = field(default=None, compare=False, repr=False)

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

    def __post_init__(self) -> None:
        _check_default(self, isinstance(self.default, bool))

    @property
    def levels(self) -> tuple[bool, ...]:
        return (False, True)

    @property
    def classes(self) -> int:
        return 2

    def sample(self, rng: np.random.Generator) -> bool:
        return bool(rng.integers(2))

    def encode(self, value: Value) -> float:
        return float(bool(value))

    def decode(self, encoded: float) -> bool:
        return float(encoded) >= 0.5


Parameter: TypeAlias = Scalar | Integer | Choice | Binary


def _check_default(parameter: Parameter, inside: bool) -> None:
    if not inside:
        raise ValueError(f"{parameter.name}: the default {parameter.default!r} lies outside what the parameter allows")


@dataclass(frozen=True)
class ParameterSpace:
    """The ordered parameters of a procedure: iterate, index by name, sample, encode, decode."""

    parameters: tuple[Parameter, ...]

    def __len__(self) -> int:
        return len(self.parameters)

    def __iter__(self) -> Iterator[Parameter]:
        return iter(self.parameters)

    def __getitem__(self, name: str) -> Parameter:
        for parameter in self.parameters:
            if parameter.name == name:
                return parameter
        raise KeyError(f"no parameter {name!r}; there are {', '.join(self.names)}")

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(parameter.name for parameter in self.parameters)

    @property
    def defaults(self) -> Parameters:
        return {parameter.name: parameter.default for parameter in self.parameters}

    @property
    def scalars(self) -> NDArray[np.bool_]:
        """(P,): which parameters are scalars."""
        return np.array([isinstance(parameter, Scalar) for parameter in self.parameters], dtype=bool)

    @property
    def combinations(self) -> float:
        """Number of vectors that can be sampled: a whole number, or infinity when a scalar is continuous."""
        counts = [len(parameter.levels) if parameter.levels is not None else math.inf for parameter in self.parameters]
        return math.prod(counts)

    def active(self, values: Mapping[str, Value]) -> tuple[str, ...]:
        """Names of the parameters that matter for these values, by their ``when``."""
        namespace = SimpleNamespace(**values)
        return tuple(p.name for p in self.parameters if p.when is None or _holds(p, namespace))

    def canonical(self, values: Mapping[str, Value]) -> Parameters:
        """The values with every inactive parameter at its default, so that equal shapes have equal parameters."""
        active = set(self.active(values))
        return {p.name: values[p.name] if p.name in active else p.default for p in self.parameters}

    def carry(self, values: Mapping[str, Value], otherwise: Mapping[str, Value] | None = None) -> Parameters:
        """Values of another version of the procedure, for this one: what still exists stays, at the nearest value.

        A parameter that is new, or whose value is no longer an option, is as in ``otherwise``, by default its default.
        """
        fallback = {**self.defaults, **(otherwise or {})}
        return self.canonical({p.name: _nearest(p, values.get(p.name), fallback[p.name]) for p in self.parameters})

    def sample(self, count: int, seed: int = 0) -> list[Parameters]:
        """Draw ``count`` different vectors at random; all of them, shuffled, when the space holds no more.

        Inactive parameters are at their default, so no two vectors mean the same shape. The product of the steps is
        never materialised, unless it is small.
        """
        if count < 0:
            raise ValueError(f"cannot sample {count} vectors")
        rng = np.random.default_rng(seed)
        if self.combinations <= max(_ENUMERABLE, 4 * count):
            every = self._enumerate()
            return [every[i] for i in rng.permutation(len(every))[:count]]
        drawn: dict[tuple[Value, ...], Parameters] = {}
        for _ in range(_DRAWS_PER_VECTOR * count):
            if len(drawn) == count:
                break
            vector = self.canonical({parameter.name: parameter.sample(rng) for parameter in self.parameters})
            drawn.setdefault(tuple(vector.values()), vector)
        return list(drawn.values())

    def encode(self, values: Mapping[str, Value]) -> NDArray[np.float64]:
        """Parameters in their own units to a vector (P,): scalars in [0, 1], other kinds as class indices."""
        return np.array([parameter.encode(values[parameter.name]) for parameter in self.parameters], dtype=np.float64)

    def decode(self, encoded: Sequence[float] | NDArray[np.floating[Any]]) -> Parameters:
        """The inverse of ``encode``; values outside the space are moved to its nearest end."""
        return {p.name: p.decode(float(e)) for p, e in zip(self.parameters, encoded, strict=True)}

    def _enumerate(self) -> list[Parameters]:
        vectors: list[Parameters] = [{}]
        for parameter in self.parameters:
            vectors = [{**vector, parameter.name: level} for vector in vectors for level in parameter.levels or ()]
        canonical = (self.canonical(vector) for vector in vectors)
        return list({tuple(vector.values()): vector for vector in canonical}.values())


def _nearest(parameter: Parameter, value: Value | None, otherwise: Value) -> Value:
    if isinstance(parameter, Scalar | Integer):
        if isinstance(value, int | float) and not isinstance(value, bool):
            return parameter.decode(parameter.encode(value))
        return otherwise
    return value if value in (parameter.levels or ()) and value is not None else otherwise


def _holds(parameter: Parameter, namespace: SimpleNamespace) -> bool:
    assert parameter.when is not None
    try:
        return bool(parameter.when(namespace))
    except Exception as error:
        raise ValueError(f"{parameter.name}: its when= failed: {type(error).__name__}: {error}") from error
