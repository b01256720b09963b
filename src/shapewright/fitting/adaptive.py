"""Adaptive sampling: more samples where the references are (the paper's future work, section 7)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from shapewright.parameters import Parameters, ParameterSpace, Value

_LEAST_SPREAD, _SPREADS = 0.03, 3.0
"""Of a scalar's normal step: its least size in shares of the Range, and its size in mean errors."""
_LEAST_CHANGE = 0.1
"""Least probability that a parameter of classes changes."""


def around(
    space: ParameterSpace,
    centres: Sequence[Parameters],
    metrics: Mapping[str, Mapping[str, Any]],
    count: int,
    seed: int,
) -> list[Parameters]:
    """``count`` different vectors near the given ones, taken in turn.

    A scalar moves by a normal step of three times its mean error on held-out samples (at least 3 % of its Range);
    another parameter changes to a class drawn at random with the share in which it is mistaken (at least 10 %). So
    there is more variety where the predictor errs more.
    """
    rng = np.random.default_rng([seed, len(centres)])
    drawn: dict[tuple[Value, ...], Parameters] = {}
    for i in range(10 * count if centres else 0):
        if len(drawn) == count:
            break
        encoded = space.encode(centres[i % len(centres)])
        for column, parameter in enumerate(space):
            measured = metrics.get(parameter.name, {})
            if parameter.classes:
                if rng.random() < max(_LEAST_CHANGE, 1.0 - measured.get("accuracy", 1.0)):
                    encoded[column] = rng.integers(parameter.classes)
            else:
                encoded[column] += max(_LEAST_SPREAD, _SPREADS * measured.get("mae", 0.0)) * rng.standard_normal()
        vector = space.canonical(space.decode(encoded))
        drawn.setdefault(tuple(vector.values()), vector)
    return list(drawn.values())
