"""The search where a procedure makes few shapes: all are built once and measured against each reference."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from shapewright.building import Crew
from shapewright.parameters import Parameters, ParameterSpace, Prediction
from shapewright.search.candidates import Candidate
from shapewright.search.objective import Criterion

_MOST = 128
"""Shapes of a space: a quick search of eight numbers builds as many for each reference."""


def is_small(space: ParameterSpace) -> bool:
    """Whether a procedure makes so few shapes that each reference can be measured against all."""
    return space.combinations <= _MOST


def best_of_all(
    prediction: Prediction, criterion: Criterion, crew: Crew, progress: Callable[[int, int], None] | None = None
) -> list[Parameters]:
    """The parameters of the least cost for each reference; the predicted ones where nothing can be measured."""
    space, last = prediction.space, criterion.parts[-1]
    made = [(build.parameters, build.shape) for build in crew.build(space.sample(_MOST)) if build.shape is not None]
    vectors = [space.encode(parameters) for parameters, _ in made]
    best = prediction.decode()
    for row in range(len(prediction)):
        residuals = criterion.measure([(row, shape) for _, shape in made])
        candidates = [Candidate(vector, criterion.surprise(prediction, row, vector)) for vector in vectors]
        pairs = zip(candidates, residuals, strict=True)
        costs = [np.inf if residual is None else each.cost_of(residual, last) for each, residual in pairs]
        if costs and min(costs) < np.inf:
            best[row] = made[int(np.argmin(costs))][0]
        if progress:
            progress(row + 1, len(prediction))
    return best
