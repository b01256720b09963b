"""What a person says of a pair that differs so much: good, passable or wrong, as one number."""

from __future__ import annotations

import json
import math
from functools import cache
from importlib.resources import files

import numpy as np

from shapewright.judging.differences import Differences
from shapewright.shapes import Floats

_TAKEN = 13
"""Of the differences, the first ones, are learned from; another pose and a stretch decide alone."""
_FLOORS = np.array([0.01, 0.02, 0.01, 0.003, 0.003, 0.0, 0.0, 0.01, 0.01, 0.0, 0.0, 0.02, 0.02])
"""Added before the logarithm, so that what hardly shows counts alike; 0 leaves a difference as it is."""
_POSE, _POSE_SLOPE = math.log(1.8), 0.1
"""Of ``other_pose``. Of 576 replicas labelled by eye none fits 1.8 times as well in another pose."""
_STRETCH, _STRETCH_SLOPE = 0.12, 0.02
"""Of ``stretch``. Of 61 good and passable replicas of other proportions, none is its reference stretched by so much."""
_ONE_VIEW, _ONE_VIEW_SLOPE = 0.6, 0.04
_BESIDE, _BESIDE_SLOPE = 4.2, 0.15
"""Of the worst view's depth, and of how many times it is the mean: one side shows another thing than the others do, as
the top of an open can. None of those 576 replicas does so."""
Weights = dict[str, Floats]


def features(differences: Differences) -> Floats:
    """(13,): what is learned from."""
    row = differences.row()[:_TAKEN]
    return np.where(_FLOORS > 0.0, np.log(np.maximum(row, 0.0) + np.maximum(_FLOORS, 1e-9)), row)


def opinion(differences: Differences, weights: Weights | None = None) -> float:
    """The mean opinion, 0 to 1: a good replica counts 1, a passable one 1/2, a wrong one 0.

    Two logistic regressions on depth say how likely it is good, and not wrong. A small network says how likely nothing
    stands out: a small difference beside an exact rest is another rule, the same difference in a rough replica is not.
    benchmarks/judging.py learns all of them.
    """
    weights, x = weights or _weights(), features(differences)
    scaled = (x - weights["mean"]) / weights["spread"]
    good, passable = (_logistic(float(w[0] + w[1:] @ scaled[:2])) for w in (weights["good"], weights["passable"]))
    hidden = np.tanh(weights["hidden"] @ scaled + weights["hidden_bias"])
    whole = _logistic(float(weights["out"] @ hidden + weights["out_bias"][0]))
    return exception(differences) * (passable + good * whole) / 2.0


def exception(differences: Differences) -> float:
    """0 where another pose, a stretch or a single view explains everything, 1 where none does."""
    d = differences
    posed = _logistic((d.other_pose - _POSE) / _POSE_SLOPE)
    stretched = _logistic((_STRETCH - d.stretch) / _STRETCH_SLOPE)
    beside = d.worst_depth / max(d.depth, 0.01)
    one_view = _logistic((d.worst_depth - _ONE_VIEW) / _ONE_VIEW_SLOPE) * _logistic((beside - _BESIDE) / _BESIDE_SLOPE)
    return (1.0 - posed) * (1.0 - stretched) * (1.0 - one_view)


@cache
def _weights() -> Weights:
    text = files("shapewright.judging").joinpath("weights.json").read_text(encoding="utf-8")
    return {name: np.array(values) for name, values in json.loads(text).items()}


def _logistic(x: float) -> float:
    return 1.0 / (1.0 + math.exp(-min(max(x, -40.0), 40.0)))
