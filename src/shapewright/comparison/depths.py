"""How much the depth pictures of two shapes differ."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shapewright.rendering.cameras import THREE_VIEWS, Camera
from shapewright.rendering.raster import render
from shapewright.shapes import Floats, Mesh


def depth_difference(
    first: Sequence[Mesh],
    second: Sequence[Mesh],
    cameras: Sequence[Camera] = THREE_VIEWS,
    size: int = 64,
    threads: int | None = None,
) -> Floats:
    """Mean absolute difference of depth where either shape is, (N,): first[i] against second[i], each normalised.

    0 to 1: of the depth that a picture can tell; what only one of the two covers counts whole.
    """
    a, b = (
        render([mesh.normalised() for mesh in meshes], cameras, size, supersample=1, threads=threads)[:, :, 1]
        for meshes in (first, second)
    )
    both, either = (a > 0) & (b > 0), (a > 0) | (b > 0)
    apart = np.where(both, np.abs(a.astype(float) - b) / 255.0, either.astype(float))
    return np.asarray(apart.sum(axis=(1, 2, 3)) / np.maximum(either.sum(axis=(1, 2, 3)), 1))
