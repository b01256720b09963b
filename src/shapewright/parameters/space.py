"""The parameter space of a procedure: the ordered set of its parameters."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice, product
from types import SimpleNamespace
from typing import Any, TypeAlias, TypeGuard

import numpy as np
from numpy.typing import NDArray

from shapewright.parameters.kinds import Integer, Parameter, Parameters, Scalar, Side, Value
from shapewright.parameters.schema import schema_of

End: TypeAlias = tuple[str, Side]  # the name of a parameter and an end of its Range

_ENUMERABLE = 20_000  # vectors that are listed one by one to sample from; that takes well under a second
_DRAWS_PER_VECTOR = 200
"""Draws for each vector that is asked for before sampling stops: enough unless few different shapes are left."""
_SHOWN, _SEARCHED = 0.02, 0.03
"""Shares of its Range within which a scalar rests on an end. Chosen by hand. The first is for what the author is shown:
a false alarm costs attention. The second is for a search that may pass the end: a false one costs a few shapes only."""


@dataclass(frozen=True)
class Excess:
    """A value outside a parameter's Range."""

    parameter: str  # its name
    value: float  # in the procedure's own units
    end: float  # of the Range, that the value has passed
    side: Side  # which end that is


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

    @cached_property
    def _is_nested(self) -> bool:
        return any("." in name for name in self.names)

    @property
    def defaults(self) -> Parameters:
        return {parameter.name: parameter.default for parameter in self.parameters}

    @property
    def scalars(self) -> NDArray[np.bool_]:
        """(P,): which parameters are scalars."""
        return np.array([isinstance(parameter, Scalar) for parameter in self.parameters], dtype=bool)

    def to_schema(self) -> dict[str, Any]:
        """The space as a JSON Schema, see ``schema.schema_of``."""
        return schema_of(self.parameters)

    @property
    def combinations(self) -> float:
        """Number of vectors that can be sampled: a whole number, or infinity when a scalar is continuous."""
        counts = [len(parameter.levels) if parameter.levels is not None else math.inf for parameter in self.parameters]
        return math.prod(counts)

    def active(self, values: Mapping[str, Value]) -> tuple[str, ...]:
        """Names of the parameters that matter for these values, by their ``when``."""
        namespace = _namespace(values) if self._is_nested else SimpleNamespace(**values)
        return tuple(p.name for p in self.parameters if p.when is None or _holds(p, namespace))

    def canonical(self, values: Mapping[str, Value]) -> Parameters:
        """The values with every inactive parameter at its default, so that equal shapes have equal parameters."""
        active = set(self.active(values))
        return {p.name: values[p.name] if p.name in active else p.default for p in self.parameters}

    def carry(
        self,
        values: Mapping[str, Value],
        otherwise: Mapping[str, Value] | None = None,
        beyond: Collection[str] = (),
    ) -> Parameters:
        """Values of another version of the procedure, for this one.

        A parameter that still exists keeps its value, or the nearest that this space allows. One that is new, or whose
        value is no longer an option, takes that of ``otherwise``, or its default. beyond: names of numbers that may
        lie outside their Ranges.
        """
        fallback = {**self.defaults, **(otherwise or {})}
        carried = {p.name: _nearest(p, values.get(p.name), fallback[p.name]) for p in self.parameters}
        for p in self.parameters:
            value = values.get(p.name)
            if p.name in beyond and isinstance(p, Scalar | Integer) and _is_number(value):
                carried[p.name] = float(value) if isinstance(p, Scalar) else round(value)
        return self.canonical(carried)

    def sample(self, count: int, seed: int = 0) -> list[Parameters]:
        """Draw ``count`` different vectors at random; all of them, shuffled, when the space holds no more.

        Inactive parameters are at their default, so no two vectors mean the same shape. The product of the steps is
        never materialised, unless it is small.
        """
        return list(self.draw(count, seed))

    def draw(self, count: int, seed: int = 0, held: Mapping[str, Value] | None = None) -> Iterator[Parameters]:
        """The vectors of ``sample``, one after the other: who needs the first few only does not draw the rest.

        held: values that all vectors have, or the nearest that this space allows.
        """
        if count < 0:
            raise ValueError(f"cannot sample {count} vectors")
        rng = np.random.default_rng(seed)
        fixed = {p.name: _nearest(p, held[p.name], p.default) for p in self.parameters if held and p.name in held}
        free = ParameterSpace(tuple(p for p in self.parameters if p.name not in fixed))
        if free.combinations <= max(_ENUMERABLE, 4 * count):
            levels = [[(p.name, level) for level in p.levels or ()] for p in free]
            every = list(self.different({**dict(vector), **fixed} for vector in product(*levels)))
            return iter([every[i] for i in rng.permutation(len(every))[:count]])
        draws = ({**{p.name: p.sample(rng) for p in free}, **fixed} for _ in range(_DRAWS_PER_VECTOR * count))
        return islice(self.different(draws), count)

    def different(self, vectors: Iterable[Mapping[str, Value]]) -> Iterator[Parameters]:
        """The vectors, each canonical, without those that equal one before."""
        seen: set[tuple[Value, ...]] = set()
        for vector in map(self.canonical, vectors):
            if (values := tuple(vector.values())) not in seen:
                seen.add(values)
                yield vector

    def encode(self, values: Mapping[str, Value]) -> NDArray[np.float64]:
        """Parameters in their own units to a vector (P,): scalars in [0, 1], other kinds as class indices."""
        return np.array([parameter.encode(values[parameter.name]) for parameter in self.parameters], dtype=np.float64)

    def decode(self, encoded: Sequence[float] | NDArray[np.floating[Any]]) -> Parameters:
        """The inverse of ``encode``; values outside the space are moved to its nearest end."""
        return {p.name: p.decode(float(e)) for p, e in zip(self.parameters, encoded, strict=True)}

    def distinct(self, vectors: Sequence[NDArray[np.float64]]) -> list[NDArray[np.float64]]:
        """The encoded vectors (P,) without those that mean the same as one before, see ``canonical``."""
        unique: dict[tuple[Value, ...], NDArray[np.float64]] = {}
        for vector in vectors:
            unique.setdefault(tuple(self.canonical(self.decode(vector)).values()), vector)
        return list(unique.values())

    def at_limit(self, values: Mapping[str, Value]) -> tuple[str, ...]:
        """Names of the active scalars near an end of their Range, for the author: perhaps the Range ends too soon.

        Integers are left out: they have few values, and the least or the most of something is often what is meant.
        """
        return tuple(p.name for p, _ in self._resting(values, _SHOWN) if isinstance(p, Scalar))

    def pressed(self, values: Mapping[str, Value]) -> set[End]:
        """The ends that active numbers rest on or have passed, for a search that may try longer Ranges there."""
        return {(p.name, side) for p, side in self._resting(values, _SEARCHED)}

    def outside(self, values: Mapping[str, Value]) -> tuple[Excess, ...]:
        """The active numbers that lie outside their Ranges."""
        sides = ((p, p.end_passed(values[p.name])) for p in self._numbers(values))
        return tuple(Excess(p.name, float(values[p.name]), getattr(p, side), side) for p, side in sides if side)

    def widened(self) -> ParameterSpace:
        """The space for a search that may leave it: every Range is longer, an integer's by two or more to a side."""
        return ParameterSpace(
            tuple(
                p.widened() if isinstance(p, Scalar) else p.widened(least=2) if isinstance(p, Integer) else p
                for p in self.parameters
            )
        )

    def limits(self, wide: ParameterSpace, free: Sequence[set[End]]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The least and the greatest scalars (N, P), encoded in ``wide``: this space's own but for the free ends."""
        low, high = np.zeros((len(free), len(self))), np.ones((len(free), len(self)))
        for column, (parameter, longer) in enumerate(zip(self, wide, strict=True)):
            if isinstance(parameter, Scalar):
                least, most = longer.encode(parameter.low), longer.encode(parameter.high)
                low[:, column] = [0.0 if (parameter.name, "low") in ends else least for ends in free]
                high[:, column] = [1.0 if (parameter.name, "high") in ends else most for ends in free]
        return low, high

    def clipped(self, values: Mapping[str, Value], names: Sequence[str]) -> Parameters:
        """The values, but for these names at the nearest that the space allows."""
        nearest = self.carry(values)
        return {**values, **{name: nearest[name] for name in names}}

    def _numbers(self, values: Mapping[str, Value]) -> list[Scalar | Integer]:
        active = self.active(values)
        return [p for p in self.parameters if isinstance(p, Scalar | Integer) and p.name in active]

    def _resting(self, values: Mapping[str, Value], margin: float) -> Iterator[tuple[Scalar | Integer, Side]]:
        for parameter in self._numbers(values):
            if side := parameter.end_at(values[parameter.name], margin):
                yield parameter, side


def _namespace(values: Mapping[str, Value]) -> SimpleNamespace:
    """The values as attributes; ``legs.width`` is an attribute of ``legs``."""
    plain = {name: value for name, value in values.items() if "." not in name}
    inner: dict[str, dict[str, Value]] = {}
    for name in values.keys() - plain.keys():
        first, _, rest = name.partition(".")
        inner.setdefault(first, {})[rest] = values[name]
    return SimpleNamespace(**plain, **{name: _namespace(several) for name, several in inner.items()})


def _nearest(parameter: Parameter, value: Value | None, otherwise: Value) -> Value:
    if isinstance(parameter, Scalar | Integer):
        if isinstance(value, int | float) and not isinstance(value, bool):
            return parameter.decode(parameter.encode(value))
        return otherwise
    return value if value in (parameter.levels or ()) and value is not None else otherwise


def _is_number(value: Value | None) -> TypeGuard[float]:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < math.inf


def _holds(parameter: Parameter, namespace: SimpleNamespace) -> bool:
    assert parameter.when is not None
    try:
        return bool(parameter.when(namespace))
    except Exception as error:
        raise ValueError(f"{parameter.name}: its when= failed: {type(error).__name__}: {error}") from error
