"""Ranges that references need: as long as their values ask for, with a margin."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shapewright.feedback.ideas.proposal import Interval, Proposal, Ranges
from shapewright.parameters import Integer, Parameter, Parameters, ParameterSpace, Scalar
from shapewright.shapes import Floats

# Where nothing else is said, chosen on seed 0 of benchmarks/suggestions.py.
_MARGIN = 0.03  # around the values of a longer Range, of their spread
_MARGIN_OF_SPREAD, _MARGIN_OF_SIZE = 0.12, 0.08  # around those of a new one: of the spread, and of the greatest value
_SMALL = 0.05  # a greatest value below counts as this much, in units of the shape
_NEEDED, _WANTED = (0.02, 0.98), (0.05, 0.95)  # quantiles between which values spread: after trials, and before
_WIDER = 0.6  # of their spread, that a Range to begin with is longer at both ends
_LEAST_OF_SIZE, _LEAST = 0.3, 0.04  # the least spread: of the median, and in units of the shape
_LOWEST_OF_LOW, _LOWEST = 0.3, 0.004  # the least low end of positive values: of the low quantile, and in these units


def narrowed(proposal: Proposal, space: ParameterSpace, values: Sequence[Parameters]) -> Ranges:
    """Ranges that the references need, with a margin, given their parameters."""
    wide = proposal.ranges
    if proposal.rule is None:
        return {name: _kept_short(space[name], [float(v[name]) for v in values], wide[name]) for name in wide}
    return {
        q.name: wide[q.name]
        if q.limits
        else _around(np.array([float(v[q.name]) for v in values]), q.whole, wide[q.name])
        for q in proposal.rule.quantities
    }


def generous(values: Floats, whole: bool) -> Interval:
    """Low, high and default of a Range to begin with: far wider than what hypotheses ask for. whole: integers only."""
    low, high = (float(q) for q in np.quantile(values, _WANTED))
    middle = float(np.median(values))
    if whole:
        return max(1.0, low - 1), high + 2, middle
    more = _WIDER * max(high - low, _LEAST_OF_SIZE * abs(middle), _LEAST)
    low = low - more if low < 0 else max(low - more, _LOWEST_OF_LOW * low, _LOWEST)
    return low, high + more, middle


def _kept_short(parameter: Parameter, values: Sequence[float], wide: Interval) -> Interval:
    """The old Range, as much longer as the values need with a margin, and no longer than the one that was tried."""
    assert isinstance(parameter, Scalar | Integer)
    low, high = min(values), max(values)
    margin = _MARGIN * (high - low) if isinstance(parameter, Scalar) else 0.0
    return (
        max(_down(low - margin), wide[0]) if low < parameter.low else parameter.low,
        min(-_down(-high - margin), wide[1]) if high > parameter.high else parameter.high,
        parameter.default,
    )


def _around(values: Floats, whole: bool, wide: Interval) -> Interval:
    """Low, high and default: the values and a margin, inside the wide range."""
    if whole:
        least, most = float(values.min()), float(values.max())
        alike = float(least == most)
        return max(1.0, least - alike), most + alike, float(np.median(values))
    low, high = (float(q) for q in np.quantile(values, _NEEDED))
    margin = _MARGIN_OF_SPREAD * (high - low) + _MARGIN_OF_SIZE * max(abs(low), abs(high), _SMALL)
    default = float(np.median(values)) if wide[2] != 1.0 else 1.0
    low, high = max(wide[0], low - margin), min(wide[1], high + margin)
    low, high = _down(min(low, default)), -_down(-max(high, default))
    return low, high, min(max(default, low), high)


def _down(value: float) -> float:
    """The next lower number of two digits."""
    unit = 10.0 ** (np.floor(np.log10(abs(value))) - 1) if value else 1.0
    return float(np.floor(value / unit + 1e-9) * unit)
