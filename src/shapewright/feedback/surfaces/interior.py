"""Points inside a shape, between points on its surface: so that a post is told from a ring, in soups too."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
from numpy.typing import NDArray

from shapewright.rendering.cameras import Camera, pack
from shapewright.rendering.raster import draw_view
from shapewright.shapes import Floats, Mesh

_SIZE = 128
_DISTANCE = 4.0
_DEEP = 0.004  # how far behind what a view shows a point must lie


def _all_round() -> tuple[Camera, ...]:
    """26 cameras: in front of the faces, edges and corners of a cube."""
    field = math.degrees(2.0 * math.atan(0.88 / math.sqrt(_DISTANCE**2 - 0.88**2)))
    return tuple(
        Camera(math.degrees(math.atan2(x, z)), math.degrees(math.atan2(y, math.hypot(x, z))), _DISTANCE, field)
        for x, y, z in product((-1.0, 0.0, 1.0), repeat=3)
        if (x, y, z) != (0.0, 0.0, 0.0)
    )


_CAMERAS = pack(_all_round())


def inside(mesh: Mesh, points: Floats) -> NDArray[np.bool_]:
    """Which points (N, 3) no view from outside shows. mesh: normalised."""
    hidden = np.ones(len(points), dtype=bool)
    shade, inverse = np.empty((2, _SIZE, _SIZE), dtype=np.float32)
    projected = np.empty_like(mesh.vertices)
    for camera in _CAMERAS:
        draw_view(mesh.vertices, mesh.faces, camera, projected, shade, inverse)
        right, up, towards = camera[:9].reshape(3, 3) @ points.T
        away = camera[9] - towards
        scale = camera[10] / away * _SIZE / 2.0
        column = np.clip((_SIZE / 2.0 + scale * right).astype(int), 0, _SIZE - 1)
        row = np.clip((_SIZE / 2.0 - scale * up).astype(int), 0, _SIZE - 1)
        seen = inverse[row, column]
        hidden &= (seen > 0.0) & (away * seen > 1.0 + _DEEP)
    return hidden


def filled(mesh: Mesh, points: Floats, seed: int = 0) -> Floats:
    """The points (N, 3) on a mesh's surface, and as many between pairs of them as lie inside it."""
    if len(points) < 2:
        return points
    rng = np.random.default_rng(seed)
    first, second = rng.integers(len(points), size=(2, len(points)))
    part = rng.random((len(points), 1))
    between = points[first] * part + points[second] * (1.0 - part)
    return np.concatenate([points, between[inside(mesh, between)]])
