"""The search where a procedure makes few shapes: all are built once and measured against each reference."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from shapewright.building import Workers
from shapewright.parameters import Parameters, ParameterSpace, Prediction
from shapewright.search.objective import Criterion

_MOST = 128
"""Shapes of a space: a quick search of eight numbers builds as many for each reference."""


def is_small(space: ParameterSpace) -> bool:
    """Whether a procedure makes so few shapes that each reference can be measured against all."""
    return space.combinations <= _MOST


def best_of_all(
    prediction: Prediction, criterion: Criterion, crew: Workers, progress: Callable[[int, int], None] | None = None
) -> list[Parameters]:
    """The parameters of the least cost for each reference; the predicted ones where nothing can be measured."""
    space, last = prediction.space, criterion.parts[-1]
    builds = [build for build in crew.build(space.sample(_MOST)) if build.shape is not None]
    vectors = [space.encode(build.parameters) for build in builds]
    best = prediction.decode()
    for row in range(len(prediction)):
        residuals = criterion.measure([(row, build.shape) for build in builds if build.shape is not None])
        costs = [
            np.inf
            if residual is None
            else float(np.abs(residual[last]).sum()) + _surprise(prediction, criterion, row, v)
            for residual, v in zip(residuals, vectors, strict=True)
        ]
        if costs and min(costs) < np.inf:
            best[row] = builds[int(np.argmin(costs))].parameters
        if progress:
            progress(row + 1, len(prediction))
    return best


def _surprise(prediction: Prediction, criterion: Criterion, row: int, vector: np.ndarray) -> float:
    return criterion.surprise_cost and criterion.surprise_cost * prediction.surprise(row, vector)
