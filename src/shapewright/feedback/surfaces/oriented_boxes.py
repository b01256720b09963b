"""Boxes around points: along the axes of space, unless another orientation fits much better."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from shapewright.shapes import Floats

# Where nothing else is said, chosen on seed 0 of benchmarks/suggestions.py.
_BETTER = 0.75  # part of the upright box's volume below which a turned box is preferred
_ENOUGH = 200  # points that tell how a box is turned
_THIN = 0.01  # added to every side, so that flat sets of points have a volume


@dataclass(frozen=True, eq=False)
class OrientedBox:
    """A box that may be turned."""

    centre: Floats  # (3,)
    size: Floats  # (3,), along its axes
    axes: Floats  # (3, 3), whose rows are unit vectors: the first nearest to X, and so on


def fit_box(points: Floats) -> OrientedBox:
    """The box around points (N, 3)."""
    upright, some = _along(points, np.eye(3)), points[:: max(1, len(points) // _ENOUGH)]
    _, _, principal = np.linalg.svd(some - some.mean(axis=0), full_matrices=False)
    about = [axes for axis in range(3) if (axes := _turned(some, axis)) is not None]
    turned = [_along(points, _ordered(axes)) for axes in [*about, principal]]
    best = min(turned, key=_volume)
    return best if _volume(best) < _BETTER * _volume(upright) else upright


def _volume(box: OrientedBox) -> float:
    return float(np.prod(box.size + _THIN))


def _along(points: Floats, axes: Floats) -> OrientedBox:
    places = points @ axes.T
    low, high = places.min(axis=0), places.max(axis=0)
    return OrientedBox((low + high) / 2.0 @ axes, high - low, axes)


def _turned(points: Floats, axis: int) -> Floats | None:
    """Axes, turned about one of space so that the rectangle around the points, seen along that axis, is least."""
    others = [i for i in range(3) if i != axis]
    flat = points[:, others]
    try:
        hull = flat[ConvexHull(flat).vertices]
    except (QhullError, ValueError):
        return None
    edges = np.roll(hull, -1, axis=0) - hull
    angles = np.unique(np.round(np.arctan2(edges[:, 1], edges[:, 0]) % (np.pi / 2.0), 4))
    cosine, sine = np.cos(angles), np.sin(angles)
    turns = np.stack([np.stack([cosine, sine], axis=1), np.stack([-sine, cosine], axis=1)], axis=1)
    places = turns @ hull.T
    sides = places.max(axis=2) - places.min(axis=2) + _THIN
    best = turns[sides.prod(axis=1).argmin()]
    axes = np.zeros((3, 3))
    axes[0, axis] = 1.0
    axes[1, others], axes[2, others] = best
    return axes


def _ordered(axes: Floats) -> Floats:
    """Rows in the order of X, Y, Z that they are nearest to, pointing the same way."""
    order: list[int] = []
    for column in range(3):
        rest = [row for row in range(3) if row not in order]
        order.append(max(rest, key=lambda row: abs(axes[row, column])))
    ordered = axes[order]
    signs = np.where(np.diagonal(ordered) < 0.0, -1.0, 1.0)
    return np.asarray(ordered * signs[:, None])
