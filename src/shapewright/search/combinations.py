"""Combinations of discrete choices beside a given one, as encoded vectors."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shapewright.parameters import ParameterSpace

Floats = NDArray[np.float64]


def plain(space: ParameterSpace, vector: Floats) -> Floats:
    """The same choices, and all scalars at their defaults."""
    return np.where(space.scalars, space.encode(space.defaults), vector)


def others(space: ParameterSpace, vector: Floats, choices: Sequence[Floats] = ()) -> list[Floats]:
    """The vectors that differ from one in a single choice that matters there, then those with some given choices.

    All have the scalars of the one vector, and each means another shape.
    """
    active = set(space.active(space.decode(vector)))
    beside = []
    for column, parameter in enumerate(space):
        for k in range(parameter.classes if parameter.name in active else 0):
            if k != vector[column]:
                beside.append(vector.copy())
                beside[-1][column] = k
    beside += [np.where(space.scalars, vector, chosen) for chosen in choices]
    return space.distinct([vector, *beside])[1:]
