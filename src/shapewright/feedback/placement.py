"""Laying a replica over its reference, where a part that one of them lacks has moved its bounding box."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import numpy as np

from shapewright.feedback.surface import Surface
from shapewright.shapes import Floats, Transform

_POINTS = 160
_FURTHEST = 0.1  # distances beyond count as this: what has no counterpart must not pull
_CLOSE = 0.008  # mean distance at which no other place is tried
_BETTER = 0.85  # what another place must reach of the cost in the middle
_SAME = 0.01


def place(reference: Surface, replica: Surface) -> Transform:
    """The scale and shift of a normalised replica under which the two surfaces are nearest to each other.

    Tried are, per axis, equal extents, and lower sides, middles and upper sides that coincide.
    """
    theirs, ours = _thinned(reference), _thinned(replica)
    best = Transform((0.0, 0.0, 0.0), 1.0)
    least = _cost(reference, replica, theirs, ours, best)
    if least < _CLOSE:
        return best
    least *= _BETTER
    for candidate in _candidates(reference.points[reference.visible], replica.points[replica.visible]):
        cost = _cost(reference, replica, theirs, ours, candidate)
        if cost < least:
            best, least = candidate, cost
    return best


def _thinned(surface: Surface) -> Floats:
    points = surface.points[surface.visible]
    return points[:: max(1, len(points) // _POINTS)]


def _cost(reference: Surface, replica: Surface, theirs: Floats, ours: Floats, transform: Transform) -> float:
    """Mean of the distances there and back, none of them beyond _FURTHEST."""
    there, _ = replica.tree.query(transform.invert(theirs), distance_upper_bound=_FURTHEST / transform.scale)
    back, _ = reference.tree.query(transform.apply(ours), distance_upper_bound=_FURTHEST)
    return float(np.minimum(there * transform.scale, _FURTHEST).mean() + np.minimum(back, _FURTHEST).mean()) / 2.0


def _candidates(theirs: Floats, ours: Floats) -> Iterator[Transform]:
    low, high = theirs.min(axis=0), theirs.max(axis=0)
    own_low, own_high = ours.min(axis=0), ours.max(axis=0)
    scales: list[float] = []
    for scale in [1.0, *(high - low) / np.maximum(own_high - own_low, 1e-6)]:
        if 0.4 < scale < 2.5 and all(abs(scale - other) > _SAME for other in scales):
            scales.append(float(scale))
    for scale in scales:
        per_axis: list[list[float]] = []
        for axis in range(3):
            shifts: list[float] = []
            for part in (0.5, 0.0, 1.0):
                target = low[axis] + part * (high[axis] - low[axis])
                source = own_low[axis] + part * (own_high[axis] - own_low[axis])
                shift = float(target - scale * source)
                if all(abs(shift - other) > _SAME for other in shifts):
                    shifts.append(shift)
            per_axis.append(shifts)
        for shifts in map(list, product(*per_axis)):
            yield Transform(tuple(-value / scale for value in shifts), scale)
