"""What the judge of meshes would say of a replica and of what was scanned, by what the scan shows of it."""

from __future__ import annotations

import json
import math
from functools import cache
from importlib.resources import files

import numpy as np

from shapewright.judging.scans.shortfall import Shortfall
from shapewright.shapes import Floats

_FLOORS = np.array([0.003, 0.002, 0.01, 0.01, 0.0, 0.0, 0.003, 0.01, 0.01, 0.0, 0.0, 0.0])
"""Added before the logarithm, so that what hardly shows counts alike; 0 leaves a difference as it is."""
Weights = dict[str, Floats]


def features(shortfall: Shortfall) -> Floats:
    """(12,): what is learned from."""
    row = shortfall.row()
    return np.where(_FLOORS > 0.0, np.log(np.maximum(row, 0.0) + np.maximum(_FLOORS, 1e-9)), row)


def likeness(shortfall: Shortfall, weights: Weights | None = None) -> float:
    """The fidelity, 0 to 1, of a small network that benchmarks/judging_scans.py teaches by the judge of meshes."""
    weights = weights or _weights()
    scaled = (features(shortfall) - weights["mean"]) / weights["spread"]
    hidden = np.tanh(weights["hidden"] @ scaled + weights["hidden_bias"])
    out = float(weights["out"] @ hidden + weights["out_bias"][0])
    return 1.0 / (1.0 + math.exp(-min(max(out, -40.0), 40.0)))


@cache
def _weights() -> Weights:
    text = files("shapewright.judging.scans").joinpath("weights.json").read_text(encoding="utf-8")
    return {name: np.array(values) for name, values in json.loads(text).items()}
