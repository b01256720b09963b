"""One step of a search that minimises the sum of absolute residuals, within bounds.

A linear model of the residuals, made from shapes that were measured anyway, is minimised by iteratively reweighted
least squares (Gauss-Newton for an L1 norm). Bounds are kept by coordinate descent on each quadratic: a parameter that
rests on the end of its range does not drag its neighbours along.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from shapewright.shapes import Floats

_REWEIGHTINGS, _SWEEPS = 6, 12
"""Of the residuals for each step, and of the parameters for each quadratic: a step's cost is within 2 % of the least
that a long search finds (tests/search/test_descent.py)."""
_RIDGE = 1e-3
"""Added to the curvature of each parameter: one without any effect stays where it is."""


@njit(nogil=True, cache=True)
def bounded_step(jacobian: Floats, residual: Floats, low: Floats, high: Floats, floor: float) -> Floats:
    """The step x (P,), low <= x <= high, that makes |residual + jacobian x| small in sum.

    jacobian: (P, K), one row a parameter. residual: (K,). floor: residuals below it weigh as if they were as large.
    A parameter whose bounds are both 0 stays where it is.
    """
    count = len(jacobian)
    step = np.zeros(count)
    hessian = np.empty((count, count))
    gradient = np.empty(count)
    for _ in range(_REWEIGHTINGS):
        left = residual.copy()
        for p in range(count):
            if step[p] != 0.0:
                left += jacobian[p] * step[p]
        weights = 1.0 / np.maximum(np.abs(left), floor)
        for p in range(count):
            weighted = jacobian[p] * weights
            gradient[p] = np.dot(weighted, left)
            for q in range(p + 1):
                hessian[p, q] = hessian[q, p] = np.dot(weighted, jacobian[q])
            hessian[p, p] += _RIDGE
        for _ in range(_SWEEPS):
            for p in range(count):
                wanted = min(max(step[p] - gradient[p] / hessian[p, p], low[p]), high[p])
                moved = wanted - step[p]
                if moved != 0.0:
                    step[p] = wanted
                    for q in range(count):
                        gradient[q] += hessian[q, p] * moved
    return step


def learn_slope(jacobian: Floats, step: Floats, change: Floats) -> None:
    """Let the model (P, K) agree with what a step (P,) changed of the residuals (K,), and else stay (Broyden 1965)."""
    length = float(step @ step)
    if length > 0.0:
        jacobian += np.outer(step, change - step @ jacobian) / length
