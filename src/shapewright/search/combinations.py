"""Combinations of discrete choices, as encoded vectors: the likeliest, and those beside a given one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shapewright.parameters import ParameterSpace

Floats = NDArray[np.float64]
_UNLIKELY = 1e-4
_LIKELIEST = 4


def likeliest(space: ParameterSpace, inferred: Sequence[NDArray[np.float32]], count: int) -> list[Floats]:
    """The ``count`` likeliest encoded vectors of one shape, likeliest first: scalars as predicted, classes combined.

    Vectors that differ only in parameters that do not matter there count once. What has no chance at all is left out.
    """
    beams: list[tuple[float, list[float]]] = [(0.0, [])]
    for parameter, values in zip(space, inferred, strict=True):
        if parameter.classes:
            possible = np.flatnonzero(values > 0.0)
            logs = np.log(values[possible])
            beams = [
                (total + log, [*head, float(k)]) for total, head in beams for k, log in zip(possible, logs, strict=True)
            ]
            beams = sorted(beams, key=lambda beam: -beam[0])[: 4 * count]
        else:
            beams = [(total, [*head, float(values)]) for total, head in beams]
    unique: dict[tuple[object, ...], Floats] = {}
    for _, vector in beams:
        centre = np.array(vector)
        unique.setdefault(_meaning(space, centre), centre)
    return list(unique.values())[:count]


def surprise(space: ParameterSpace, inferred: Sequence[NDArray[np.float32]], centre: Floats) -> float:
    """Minus the logarithm of the probability that is inferred for the choices that matter at a point."""
    active = set(space.active(space.decode(centre)))
    chances = [
        inferred[i][int(centre[i])]
        for i, parameter in enumerate(space)
        if parameter.classes and parameter.name in active
    ]
    return -float(np.log(np.maximum(chances, _UNLIKELY)).sum())


def plain(space: ParameterSpace, centre: Floats) -> Floats:
    """The same choices, and all scalars at their defaults."""
    return np.where(space.scalars, space.encode(space.defaults), centre)


def others(
    space: ParameterSpace, centre: Floats, inferred: Sequence[NDArray[np.float32]] | None = None
) -> list[Floats]:
    """The vectors that differ from one in a single choice that matters there, then those of the likeliest choices.

    inferred: of what is likely; without it there are none of these.
    """
    active = set(space.active(space.decode(centre)))
    vectors = []
    for column, parameter in enumerate(space):
        for k in range(parameter.classes if parameter.name in active else 0):
            if k != centre[column]:
                vectors.append(centre.copy())
                vectors[-1][column] = k
    if inferred is not None:
        vectors += [np.where(space.scalars, centre, each) for each in likeliest(space, inferred, _LIKELIEST)]
    unique = {_meaning(space, centre): centre}
    for each in vectors:
        unique.setdefault(_meaning(space, each), each)
    return list(unique.values())[1:]


def _meaning(space: ParameterSpace, vector: Floats) -> tuple[object, ...]:
    """What a vector decodes to, but for parameters that do not matter there."""
    return tuple(space.canonical(space.decode(vector)).values())
