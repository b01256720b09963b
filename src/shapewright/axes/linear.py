"""Which way shapes of one kind stand, learned from some of them that stand right."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from shapewright.shapes import Floats

_RIDGE = 3e-3  # of the weights, beside the mean loss of a shape; benchmarks/axes.py has others
_STEPS = 150


@dataclass(frozen=True, eq=False)
class Linear:
    """How likely each turn is the right one: a softmax over the 24 of a weighted sum of their features."""

    weights: Floats  # (F,)

    @classmethod
    def learned(cls, features: Floats, right: NDArray[np.bool_]) -> Linear:
        """features: (N, 24, F), scaled. right: (N, 24), turns after which a shape stands right, one at least."""

        def loss(weights: Floats) -> tuple[float, Floats]:
            logs = log_softmax(features @ weights)
            among = np.where(right, logs, -np.inf)
            most = among.max(axis=1, keepdims=True)
            sure = most + np.log(np.exp(among - most).sum(axis=1, keepdims=True))
            surplus = np.exp(logs) - np.exp(among - sure)
            gradient = np.tensordot(surplus, features, axes=2) / len(features) + _RIDGE * weights
            return float(-sure.mean() + 0.5 * _RIDGE * weights @ weights), gradient

        found = minimize(loss, np.zeros(features.shape[2]), jac=True, method="L-BFGS-B", options={"maxiter": _STEPS})
        return cls(np.asarray(found.x))

    def log_likely(self, features: Floats) -> Floats:
        """(N, 24): logarithms of the likelihoods, which add up to 1. features: (N, 24, F), scaled."""
        return log_softmax(features @ self.weights)


def log_softmax(values: Floats) -> Floats:
    """Over the last axis."""
    shifted = values - values.max(axis=-1, keepdims=True)
    return np.asarray(shifted - np.log(np.exp(shifted).sum(axis=-1, keepdims=True)))
