"""Ranges that references need: as long as their values ask for, with a margin."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shapewright.feedback.ideas.proposal import Proposal, Ranges
from shapewright.parameters import Integer, Parameter, Parameters, ParameterSpace, Scalar
from shapewright.shapes import Floats

_MARGINS = 0.03, 0.12, 0.08
"""Of a longer Range, of the spread of its values; of a new one, of the spread and of the greatest value."""
_SPREAD = 0.02, 0.98  # quantiles between which the values of a new parameter spread
_SLACK = 0.05  # least greatest value that a margin is made from, in units of the shape


def narrowed(proposal: Proposal, space: ParameterSpace, values: Sequence[Parameters]) -> Ranges:
    """Ranges that the references need, with a margin, given their parameters."""
    wide = proposal.ranges
    if proposal.rule is None:
        return {name: _kept_short(space[name], [float(v[name]) for v in values], wide[name]) for name in wide}
    return {
        q.name: _around(np.array([float(v[q.name]) for v in values]), q.whole, wide[q.name])
        for q in proposal.rule.quantities
    }


def generous(values: Floats, whole: bool) -> tuple[float, float, float]:
    """Low, high and default of a Range to begin with: far wider than what hypotheses ask for. whole: integers only."""
    low, high = (float(q) for q in np.quantile(values, [0.05, 0.95]))
    middle = float(np.median(values))
    if whole:
        return max(1.0, low - 1), high + 2, middle
    spread = max(high - low, 0.3 * abs(middle), 0.04)
    low = low - 0.6 * spread if low < 0 else max(low - 0.6 * spread, 0.3 * low, 0.004)
    return low, high + 0.6 * spread, middle


def _kept_short(
    parameter: Parameter, values: Sequence[float], wide: tuple[float, float, float]
) -> tuple[float, float, float]:
    """The old Range, as much longer as the values need with a margin, and no longer than the one that was tried."""
    assert isinstance(parameter, Scalar | Integer)
    low, high = min(values), max(values)
    margin = _MARGINS[0] * (high - low) if isinstance(parameter, Scalar) else 0.0
    return (
        max(_down(low - margin), wide[0]) if low < parameter.low else parameter.low,
        min(-_down(-high - margin), wide[1]) if high > parameter.high else parameter.high,
        parameter.default,
    )


def _around(values: Floats, whole: bool, wide: tuple[float, float, float]) -> tuple[float, float, float]:
    """Low, high and default: the values and a margin, inside the wide range."""
    if whole:
        least, most = float(values.min()), float(values.max())
        alike = float(least == most)
        return max(1.0, least - alike), most + alike, float(np.median(values))
    low, high = (float(q) for q in np.quantile(values, _SPREAD))
    margin = _MARGINS[1] * (high - low) + _MARGINS[2] * max(abs(low), abs(high), _SLACK)
    default = float(np.median(values)) if wide[2] != 1.0 else 1.0
    low, high = max(wide[0], low - margin), min(wide[1], high + margin)
    low, high = _down(min(low, default)), -_down(-max(high, default))
    return low, high, min(max(default, low), high)


def _down(value: float) -> float:
    """The next lower number of two digits."""
    if value == 0.0:
        return 0.0
    unit = 10.0 ** (np.floor(np.log10(abs(value))) - 1)
    return float(np.floor(value / unit + 1e-9) * unit)
