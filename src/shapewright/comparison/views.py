"""How much two meshes differ in pictures taken from the same places: overlap of silhouettes, difference of depths."""

from __future__ import annotations

import numpy as np

from shapewright.rendering.cameras import THREE_VIEWS
from shapewright.rendering.raster import render
from shapewright.shapes import Bytes, Mesh


def intersection_over_union(first: Mesh, second: Mesh) -> float:
    """IoU of the silhouettes of the normalised meshes, 0 to 1: the mean over THREE_VIEWS, of 128 pixels a side."""
    a, b = _depths(first, 128) > 0, _depths(second, 128) > 0
    union, overlap = (a | b).sum(axis=(1, 2)), (a & b).sum(axis=(1, 2))
    return float(np.where(union > 0, overlap / np.maximum(union, 1), 1.0).mean())


def depth_difference(first: Mesh, second: Mesh) -> float:
    """Mean absolute difference of the depths of the normalised meshes where either is, in THREE_VIEWS of 64 pixels.

    0 to 1: of the depth that a picture can tell; what only one of the two covers counts whole.
    """
    a, b = _depths(first, 64), _depths(second, 64)
    both, either = (a > 0) & (b > 0), (a > 0) | (b > 0)
    apart = np.where(both, np.abs(a.astype(float) - b) / 255.0, either.astype(float))
    return float(apart.sum() / max(either.sum(), 1))


def _depths(mesh: Mesh, size: int) -> Bytes:
    """(C, size, size): pictures of depth, 0 where there is nothing."""
    return render([mesh.normalised()], THREE_VIEWS, size, supersample=1, threads=1)[0, :, 1]
