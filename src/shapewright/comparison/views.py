"""How much two meshes differ in pictures taken from the same places: overlap of silhouettes, difference of depths."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shapewright.rendering.cameras import THREE_VIEWS, Camera
from shapewright.rendering.raster import render
from shapewright.shapes import Bytes, Floats, Mesh


def intersection_over_union(
    first: Sequence[Mesh],
    second: Sequence[Mesh],
    cameras: Sequence[Camera] = THREE_VIEWS,
    size: int = 128,
    threads: int | None = None,
) -> Floats:
    """IoU of silhouettes, (N,), the mean over the cameras: first[i] against second[i], each normalised; 0 to 1."""
    a, b = (_depths(meshes, cameras, size, threads) > 0 for meshes in (first, second))
    union = (a | b).sum(axis=(2, 3))
    overlap = (a & b).sum(axis=(2, 3))
    return np.asarray(np.where(union > 0, overlap / np.maximum(union, 1), 1.0).mean(axis=1))


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
    a, b = (_depths(meshes, cameras, size, threads) for meshes in (first, second))
    both, either = (a > 0) & (b > 0), (a > 0) | (b > 0)
    apart = np.where(both, np.abs(a.astype(float) - b) / 255.0, either.astype(float))
    return np.asarray(apart.sum(axis=(1, 2, 3)) / np.maximum(either.sum(axis=(1, 2, 3)), 1))


def _depths(meshes: Sequence[Mesh], cameras: Sequence[Camera], size: int, threads: int | None) -> Bytes:
    """(N, C, size, size): pictures of depth, 0 where there is nothing."""
    return render([mesh.normalised() for mesh in meshes], cameras, size, supersample=1, threads=threads)[:, :, 1]
