"""Binary silhouettes of triangles in orthographic views, without a depth buffer.

Corners are snapped to 1/256 of a pixel, as graphics hardware does. On that grid a row's crossing with an edge lies
either on a pixel centre or at least 2^-24 away from it, so double precision decides every pixel exactly: neighbours
share no pixel and leave no gap, and a triangle that covers no pixel centre writes nothing.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import ArrayLike, NDArray

from shapewright.shapes import Mesh

SIZE = 256
"""Rows and columns of a silhouette; it shows [-1, 1] x [-1, 1]."""

_SUBPIXELS = 256.0
_BELOW = 2.0**-30  # more than any rounding error, less than the distance of any crossing from a pixel centre

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def view_axes(directions: ArrayLike) -> Floats:
    """Image axes of cameras that look from each direction at the origin, up = +Y: (..., 3) to (..., 2, 3).

    The first axis runs right, the second up. Raises ValueError for a direction along Y, which has no such axes.
    """
    towards = np.asarray(directions, dtype=np.float64)
    right = np.cross([0.0, 1.0, 0.0], towards)
    length = np.linalg.norm(right, axis=-1, keepdims=True)
    if (length <= 1e-9 * np.linalg.norm(towards, axis=-1, keepdims=True)).any():
        raise ValueError("a camera on the Y axis has no up direction in its image")
    right = right / length
    up = np.cross(towards, right)
    return np.stack([right, up / np.linalg.norm(up, axis=-1, keepdims=True)], axis=-2)


def silhouettes(mesh: Mesh, directions: ArrayLike) -> Bytes:
    """Silhouettes (N, 256, 256) of a mesh seen from N directions (N, 3): 1 where a triangle covers the pixel's centre.

    The mesh is centred and scaled to a largest extent of 1 first; row 0 is the bottom row.
    Raises ValueError when the mesh has no faces or no size.
    """
    normalised = mesh.normalised()
    axes = view_axes(directions)
    images = np.zeros((len(axes), SIZE, SIZE), dtype=np.uint8)
    columns, rows = np.empty((2, len(normalised.vertices)))
    for image, view in zip(images, axes, strict=True):
        project(normalised.vertices, view, columns, rows)
        fill_triangles(columns, rows, normalised.faces, image)
    return images


@njit(nogil=True, cache=True)
def project(vertices: Floats, axes: Floats, columns: Floats, rows: Floats) -> None:
    """Pixel coordinates of vertices (V, 3) in one view, snapped to 1/256; whole numbers are pixel centres."""
    half = SIZE / 2.0
    for v in range(len(vertices)):
        x, y, z = vertices[v, 0], vertices[v, 1], vertices[v, 2]
        right = axes[0, 0] * x + axes[0, 1] * y + axes[0, 2] * z
        up = axes[1, 0] * x + axes[1, 1] * y + axes[1, 2] * z
        columns[v] = np.rint(((right + 1.0) * half - 0.5) * _SUBPIXELS) / _SUBPIXELS
        rows[v] = np.rint(((up + 1.0) * half - 0.5) * _SUBPIXELS) / _SUBPIXELS


@njit(nogil=True, cache=True)
def fill_triangles(columns: Floats, rows: Floats, faces: Ints, image: Bytes) -> None:
    """Set every pixel whose centre lies in a triangle, or on its left or bottom edge; all must fall inside the image."""
    for face in range(len(faces)):
        a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
        if rows[a] > rows[b]:
            a, b = b, a
        if rows[b] > rows[c]:
            b, c = c, b
        if rows[a] > rows[b]:
            a, b = b, a
        bottom, middle, top = math.ceil(rows[a]), math.ceil(rows[b]), math.ceil(rows[c])
        if bottom == top:
            continue
        leftmost = min(columns[a], columns[b], columns[c])
        rightmost = max(columns[a], columns[b], columns[c])
        if math.ceil(leftmost) == math.ceil(rightmost):
            continue
        long_slope = (columns[c] - columns[a]) / (rows[c] - rows[a])
        if middle > bottom:
            slope = (columns[b] - columns[a]) / (rows[b] - rows[a])
            for row in range(bottom, middle):
                along = columns[a] + (row - rows[a]) * long_slope - _BELOW
                across = columns[a] + (row - rows[a]) * slope - _BELOW
                for column in range(math.ceil(min(along, across)), math.ceil(max(along, across))):
                    image[row, column] = 1
        if top > middle:
            slope = (columns[c] - columns[b]) / (rows[c] - rows[b])
            for row in range(middle, top):
                along = columns[a] + (row - rows[a]) * long_slope - _BELOW
                across = columns[b] + (row - rows[b]) * slope - _BELOW
                for column in range(math.ceil(min(along, across)), math.ceil(max(along, across))):
                    image[row, column] = 1
