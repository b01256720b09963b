"""How much the silhouettes of two shapes overlap."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shapewright.rendering.cameras import THREE_VIEWS, Camera
from shapewright.rendering.raster import render
from shapewright.shapes import Floats, Mesh


def intersection_over_union(
    first: Sequence[Mesh],
    second: Sequence[Mesh],
    cameras: Sequence[Camera] = THREE_VIEWS,
    size: int = 128,
    threads: int | None = None,
) -> Floats:
    """IoU of silhouettes, (N,), the mean over the cameras: first[i] against second[i], each normalised; 0 to 1."""
    a, b = (
        render([mesh.normalised() for mesh in meshes], cameras, size, supersample=1, threads=threads)[:, :, 1] > 0
        for meshes in (first, second)
    )
    union = (a | b).sum(axis=(2, 3))
    overlap = (a & b).sum(axis=(2, 3))
    return np.asarray(np.where(union > 0, overlap / np.maximum(union, 1), 1.0).mean(axis=1))
