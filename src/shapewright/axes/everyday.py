"""What everyday things look like when they stand right, whatever their kind: learned by ``benchmarks/axes.py``.

Points of scanners look otherwise than meshes: their undersides are open, and nothing of them is even.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from importlib.resources import files

import numpy as np

from shapewright.axes.linear import log_softmax
from shapewright.shapes import Floats

_MOST = 4.0  # standard deviations from the mean that a feature counts at most
Weights = Mapping[str, Floats]


def scaled(features: Floats, weights: Weights | None = None) -> Floats:
    """Features (..., F) in standard deviations from their mean over everyday things in all turns."""
    known = weights or everyday()
    return np.clip((features - known["mean"]) / known["spread"], -_MOST, _MOST)


def log_likely(features: Floats, weights: Weights | None = None) -> Floats:
    """(N, 24): logarithms of how likely each turn is right, which add up to 1, by a small network.

    features: (N, 24, F), scaled.
    """
    known = weights or everyday()
    hidden = np.tanh(features @ known["hidden"].T + known["hidden_bias"])
    return log_softmax(hidden @ known["out"])


@cache
def everyday(points: bool = False) -> Weights:
    """The weights that come with shapewright. points: of things that a scanner has seen from some sides."""
    name = "weights_of_points.json" if points else "weights.json"
    text = files("shapewright.axes").joinpath(name).read_text(encoding="utf-8")
    return {name: np.array(values) for name, values in json.loads(text).items()}
