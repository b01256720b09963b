"""Adaptive sampling: more samples where the references are (the paper's future work, section 7)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import cycle, islice
from typing import Any

import numpy as np

from shapewright.parameters import Parameters, ParameterSpace

_LEAST_SPREAD, _SPREADS = 0.03, 3.0
"""Of a scalar's normal step: its least size in shares of the Range, and its size in mean errors."""
_LEAST_CHANGE = 0.1  # least probability that a parameter of classes changes


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

    def moved(centre: Parameters) -> Parameters:
        encoded = space.encode(centre)
        for column, parameter in enumerate(space):
            measured = metrics.get(parameter.name, {})
            if parameter.classes:
                if rng.random() < max(_LEAST_CHANGE, 1.0 - measured.get("accuracy", 1.0)):
                    encoded[column] = rng.integers(parameter.classes)
            else:
                encoded[column] += max(_LEAST_SPREAD, _SPREADS * measured.get("mae", 0.0)) * rng.standard_normal()
        return space.decode(encoded)

    return list(islice(space.different(map(moved, islice(cycle(centres), 10 * count))), count))
