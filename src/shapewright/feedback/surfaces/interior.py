"""Points inside a shape, between points on its surface: they tell a post from a ring, in triangle soups too."""

from __future__ import annotations

import numpy as np

from shapewright.rendering.visibility import AllRound
from shapewright.shapes import Floats, Mesh

_SIZE, _RADIUS = 128, 0.88
"""Pixels of the views that show what lies inside, and the radius of what they show."""


def filled(mesh: Mesh, points: Floats, seed: int = 0) -> Floats:
    """The points (N, 3) on a mesh's surface, and as many between pairs of them as lie inside it."""
    if len(points) < 2:
        return points
    rng = np.random.default_rng(seed)
    first, second = rng.integers(len(points), size=(2, len(points)))
    part = rng.random((len(points), 1))
    between = points[first] * part + points[second] * (1.0 - part)
    return np.concatenate([points, between[AllRound.of(mesh, _SIZE, _RADIUS).encloses(between)]])
