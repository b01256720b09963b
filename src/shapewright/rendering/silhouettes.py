"""Binary silhouettes of triangles in orthographic views, without a depth buffer.

Corners are snapped to 1/256 of a pixel, as graphics hardware does. On that grid a row's crossing with an edge lies
either on a pixel centre or at least 2^-24 away from it, so double precision decides every pixel exactly: neighbours
share no pixel and leave no gap, and a triangle that covers no pixel centre writes nothing.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import ArrayLike

from shapewright.shapes import Bytes, Floats, Ints

SIZE = 256  # rows and columns of a silhouette; it shows [-1, 1] x [-1, 1]

_SUBPIXELS = 256.0  # places of a corner along a pixel, as on graphics hardware
_BELOW = 2.0**-30
"""Of a pixel: more than any rounding error, less than the distance of any crossing from a pixel centre."""


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


@njit(nogil=True, cache=True)
def draw(vertices: Floats, faces: Ints, axes: Floats, images: Bytes) -> None:
    """Draw triangles in N views (N, 2, 3): 1 where one covers the pixel's centre; row 0 is the bottom row.

    Vertices (V, 3) that faces use lie at most 1 from the origin.
    """
    columns, rows = np.empty(len(vertices)), np.empty(len(vertices))
    images[:] = 0
    for n in range(len(images)):
        _project(vertices, axes[n], columns, rows)
        _fill_triangles(columns, rows, faces, images[n])


@njit(nogil=True, cache=True)
def _project(vertices: Floats, axes: Floats, columns: Floats, rows: Floats) -> None:
    """Pixel coordinates in one view, snapped to 1/256; whole numbers are pixel centres."""
    half = SIZE / 2.0
    for v in range(len(vertices)):
        x, y, z = vertices[v, 0], vertices[v, 1], vertices[v, 2]
        right = axes[0, 0] * x + axes[0, 1] * y + axes[0, 2] * z
        up = axes[1, 0] * x + axes[1, 1] * y + axes[1, 2] * z
        columns[v] = np.rint(((right + 1.0) * half - 0.5) * _SUBPIXELS) / _SUBPIXELS
        rows[v] = np.rint(((up + 1.0) * half - 0.5) * _SUBPIXELS) / _SUBPIXELS


@njit(nogil=True, cache=True, error_model="numpy")
def _fill_triangles(columns: Floats, rows: Floats, faces: Ints, image: Bytes) -> None:
    """Set every pixel whose centre lies in a triangle, or on its left or bottom edge."""
    pixels = image.ravel()
    for face in range(len(faces)):
        a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
        xa, ya, xb, yb, xc, yc = columns[a], rows[a], columns[b], rows[b], columns[c], rows[c]
        if np.ceil(min(ya, yb, yc)) == np.ceil(max(ya, yb, yc)) or np.ceil(min(xa, xb, xc)) == np.ceil(max(xa, xb, xc)):
            continue  # most triangles of a fine mesh lie between two rows or two columns of pixel centres
        if ya > yb:
            xa, ya, xb, yb = xb, yb, xa, ya
        if yb > yc:
            xb, yb, xc, yc = xc, yc, xb, yb
        if ya > yb:
            xa, ya, xb, yb = xb, yb, xa, ya
        bottom, middle, top = math.ceil(ya), math.ceil(yb), math.ceil(yc)
        slope = (xc - xa) / (yc - ya)
        if bottom < middle:
            _fill_rows(pixels, bottom, middle, xa + (bottom - ya) * slope, slope, xa, ya, xb, yb)
        if middle < top:
            _fill_rows(pixels, middle, top, xa + (middle - ya) * slope, slope, xb, yb, xc, yc)


@njit(nogil=True, cache=True, error_model="numpy")
def _fill_rows(
    pixels: Bytes, first: int, end: int, long: float, long_slope: float, x0: float, y0: float, x1: float, y1: float
) -> None:
    """Fill rows between the long edge, which crosses the first of them at ``long``, and the edge from 0 to 1."""
    slope = (x1 - x0) / (y1 - y0)
    short = x0 + (first - y0) * slope
    for row in range(first, end):
        left = math.ceil(min(long, short) - _BELOW)
        right = math.ceil(max(long, short) - _BELOW)
        if left < right:
            pixels[row * SIZE + left : row * SIZE + right] = 1
        long += long_slope
        short += slope
