"""Ranges that end too soon: which ends a shape's parameters rest on, and a space that goes on beyond them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from shapewright.parameters import Integer, Parameter, Parameters, ParameterSpace, Scalar
from shapewright.shapes import Floats

End = tuple[str, Literal["low", "high"]]
MARGIN = 0.03
"""Share of its Range within which a scalar rests on an end."""
_BEYOND = 0.01


@dataclass(frozen=True)
class Wish:
    """A value outside a parameter's Range, and the end that it is beyond."""

    parameter: str
    value: float
    end: float

    @property
    def side(self) -> Literal["low", "high"]:
        return "low" if self.value < self.end else "high"


def pressed(space: ParameterSpace, parameters: Parameters) -> set[End]:
    """The ends of Ranges that the numbers among these parameters rest on or have passed."""
    ends: set[End] = set()
    active = space.active(parameters)
    for parameter in space:
        if isinstance(parameter, Scalar | Integer) and parameter.name in active:
            value, margin = float(parameters[parameter.name]), MARGIN * (parameter.high - parameter.low)
            if isinstance(parameter, Integer):
                margin = 0.0
            if value <= parameter.low + margin:
                ends.add((parameter.name, "low"))
            if value >= parameter.high - margin:
                ends.add((parameter.name, "high"))
    return ends


def widened(space: ParameterSpace) -> ParameterSpace:
    """The space with every Range longer, by once its length below and twice above; nothing from 0 on comes below 0."""
    return ParameterSpace(tuple(_wide(parameter) for parameter in space))


def limits(space: ParameterSpace, wide: ParameterSpace, ends: Sequence[set[End]]) -> tuple[Floats, Floats]:
    """The least and the greatest scalars (N, P), encoded in ``wide``: the space's own but for the given ends."""
    low, high = np.zeros((len(ends), len(space))), np.ones((len(ends), len(space)))
    for column, (parameter, longer) in enumerate(zip(space, wide, strict=True)):
        if isinstance(parameter, Scalar):
            for row, free in enumerate(ends):
                if (parameter.name, "low") not in free:
                    low[row, column] = longer.encode(parameter.low)
                if (parameter.name, "high") not in free:
                    high[row, column] = longer.encode(parameter.high)
    return low, high


def beyond(space: ParameterSpace, parameters: Parameters) -> tuple[Wish, ...]:
    """The parameters that lie outside the space."""
    wishes = []
    active = space.active(parameters)
    for parameter in space:
        if isinstance(parameter, Scalar | Integer) and parameter.name in active:
            value, margin = float(parameters[parameter.name]), _BEYOND * (parameter.high - parameter.low)
            if value < parameter.low - margin:
                wishes.append(Wish(parameter.name, value, parameter.low))
            elif value > parameter.high + margin:
                wishes.append(Wish(parameter.name, value, parameter.high))
    return tuple(wishes)


def inside(space: ParameterSpace, parameters: Parameters, names: Sequence[str]) -> Parameters:
    """The parameters, but for these names at the nearest values that the space allows."""
    nearest = space.carry(parameters)
    return {**parameters, **{name: nearest[name] for name in names}}


def _wide(parameter: Parameter) -> Parameter:
    if isinstance(parameter, Scalar):
        span = parameter.high - parameter.low
        low = parameter.low - span
        if parameter.low >= 0.0:
            low = max(low, parameter.low / 4.0)
        return replace(parameter, low=low, high=parameter.high + 2.0 * span, steps=None)
    if isinstance(parameter, Integer):
        span = max(parameter.high - parameter.low, 2)
        low = parameter.low - span if parameter.low < 0 else max(parameter.low - span, min(parameter.low, 1))
        return replace(parameter, low=low, high=parameter.high + span)
    return parameter
