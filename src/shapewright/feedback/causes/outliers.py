"""References that may not belong to their collection: they are unlike all others."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shapewright.comparison import light_field
from shapewright.settings import Align
from shapewright.shapes import Floats

NEIGHBOURS = 3
"""Nearest other references, of which the mean distance counts."""
# Where nothing else is said, chosen on seed 0 of benchmarks/causes.py.
_FENCE = 1.0  # interquartile ranges above the third quartile
_LEAST = 0.22  # no reference is an outlier that has neighbours nearer than this
_MOST = 400  # others that a reference is compared with, at most


def isolation(
    descriptors: Sequence[light_field.Descriptor | None],
    align: Align = "free",
    threads: int | None = None,
    seed: int = 0,
) -> Floats:
    """Mean distance of each reference to its three nearest others, (N,); NaN where it cannot be described.

    Of a large collection some hundreds, drawn at random, stand for all.
    """
    rows = [i for i, descriptor in enumerate(descriptors) if descriptor]
    result = np.full(len(descriptors), np.nan)
    if len(rows) <= NEIGHBOURS:
        return result
    some = rows
    if len(rows) > _MOST:
        some = sorted(np.random.default_rng(seed).choice(rows, _MOST, replace=False).tolist())
    described = [d for i in rows if (d := descriptors[i])]
    others = [d for i in some if (d := descriptors[i])]
    between = light_field.distances(described, None if len(some) == len(rows) else others, align, threads)
    between[np.array(rows)[:, None] == np.array(some)[None, :]] = np.inf
    result[rows] = np.sort(between, axis=1)[:, :NEIGHBOURS].mean(axis=1)
    return result


def outliers(isolated: Floats) -> NDArray[np.bool_]:
    """Which references are further from all others than the bulk of the collection is from its own neighbours.

    isolated: of every reference, see ``isolation``. A fence as that of box plots, but at one interquartile range: it
    makes a guess that the author confirms.
    """
    known = isolated[np.isfinite(isolated)]
    if len(known) < 2 * NEIGHBOURS:
        return np.zeros(len(isolated), dtype=bool)
    low, high = np.quantile(known, [0.25, 0.75])
    return np.asarray(isolated > max(high + _FENCE * (high - low), _LEAST))
