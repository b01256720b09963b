"""Silhouettes of meshes in perspective, each framed by its own box: what a picture says of a shape, place and size
aside."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from PIL import Image

from shapewright.shapes import Bytes, Floats, Mesh
from shapewright.shapes.views import REACH, SIDE, View

_NEAR = 0.05  # vertices nearer to the camera than this, in units of the largest extent, are drawn as if they were there


def framed(mesh: Mesh, places: Floats, size: int = 64, supersample: int = 4, stretched: bool = False) -> Bytes:
    """How much of each pixel the silhouette of a normalised mesh covers: (C, size, size), 0 to 255, row 0 at the top.

    The middle of the silhouette's box is that of the picture, and the longer side of the box takes the same part of
    every picture; where it is stretched both sides do. places: (C, 3), of the cameras, see ``anywhere``. Each
    pixel is the mean of supersample x supersample samples.
    """
    images = np.empty((len(places), size, size), dtype=np.uint8)
    side = size * supersample
    _draw(
        mesh.vertices,
        mesh.faces,
        np.radians(places[:, :2]),
        1.0 / places[:, 2],
        REACH,
        stretched,
        np.empty((side, side), np.uint8),
        images,
    )
    return images


def pictures_of(view: View, size: int) -> Bytes:
    """(1, 2, size, size): a silhouette as it is framed, and stretched to the same width and height, 0 to 255."""
    mask = Image.fromarray(view.mask)
    rows, columns = (np.flatnonzero((view.mask > 127).any(axis=axis)) for axis in (1, 0))
    box = (columns[0], rows[0], columns[-1] + 1, rows[-1] + 1) if len(rows) else (0, 0, SIDE, SIDE)
    low, high = np.array(box[:2], float), np.array(box[2:], float)
    margin = (high - low) * (1.0 / REACH - 1.0) / 2.0
    room = int(np.ceil(margin.max()))
    wide = Image.fromarray(np.pad(view.mask, room))
    stretched = (*(low - margin + room), *(high + margin + room))
    whole = mask.resize((size, size), Image.Resampling.BOX)
    return np.stack([np.asarray(whole), np.asarray(wide.resize((size, size), Image.Resampling.BOX, stretched))])[None]


@njit(nogil=True, cache=True)
def _draw(
    vertices: Any, faces: Any, turns: Any, distances: Any, reach: float, stretched: bool, samples: Any, images: Any
) -> None:
    flat = np.empty((len(vertices), 2))
    for c in range(len(turns)):
        _flatten(vertices, turns[c], distances[c], flat)
        _frame(flat, faces, reach, stretched, len(samples))
        samples[:] = 0
        for f in range(len(faces)):
            _fill(flat, faces[f, 0], faces[f, 1], faces[f, 2], samples)
        _pool(samples, images[c])


@njit(nogil=True, cache=True)
def _flatten(vertices: Any, turn: Any, distance: float, flat: Any) -> None:
    """Column and row of each vertex at a distance of 1, the axes being those of ``Camera.frame``."""
    across, along = np.cos(turn[0]), np.sin(turn[0])
    level, above = np.cos(turn[1]), np.sin(turn[1])
    for v in range(len(vertices)):
        x, y, z = vertices[v, 0], vertices[v, 1], vertices[v, 2]
        towards = along * x + across * z
        away = max(distance - level * towards - above * y, _NEAR)
        flat[v, 0] = (across * x - along * z) / away
        flat[v, 1] = (above * towards - level * y) / away


@njit(nogil=True, cache=True)
def _frame(flat: Any, faces: Any, reach: float, stretched: bool, side: int) -> None:
    """Move and scale the corners that faces use so that their box is in the middle of ``side`` samples."""
    low, high = np.full(2, np.inf), np.full(2, -np.inf)
    for f in range(len(faces)):
        for k in range(3):
            for axis in range(2):
                place = flat[faces[f, k], axis]
                low[axis], high[axis] = min(low[axis], place), max(high[axis], place)
    extent = np.maximum(high - low, 1e-9)
    if not stretched:
        extent[:] = extent.max()
    for v in range(len(flat)):
        for axis in range(2):
            middle = (low[axis] + high[axis]) / 2.0
            flat[v, axis] = side * (0.5 + reach * (flat[v, axis] - middle) / extent[axis])


@njit(nogil=True, cache=True, error_model="numpy")
def _fill(flat: Any, a: int, b: int, c: int, samples: Any) -> None:
    """Set every sample whose middle lies in a triangle."""
    xa, ya, xb, yb, xc, yc = flat[a, 0], flat[a, 1], flat[b, 0], flat[b, 1], flat[c, 0], flat[c, 1]
    if ya > yb:
        xa, ya, xb, yb = xb, yb, xa, ya
    if yb > yc:
        xb, yb, xc, yc = xc, yc, xb, yb
    if ya > yb:
        xa, ya, xb, yb = xb, yb, xa, ya
    first, last = int(np.ceil(ya - 0.5)), min(int(np.ceil(yc - 0.5)), len(samples))
    for row in range(max(first, 0), last):
        y = row + 0.5
        long = xa + (y - ya) * (xc - xa) / (yc - ya)
        short = xa + (y - ya) * (xb - xa) / (yb - ya) if y < yb else xb + (y - yb) * (xc - xb) / (yc - yb)
        left = max(int(np.ceil(min(long, short) - 0.5)), 0)
        right = min(int(np.ceil(max(long, short) - 0.5)), len(samples))
        for column in range(left, right):
            samples[row, column] = 1


@njit(nogil=True, cache=True)
def _pool(samples: Any, image: Any) -> None:
    size = len(image)
    step = len(samples) // size
    full = step * step
    for row in range(size):
        for column in range(size):
            count = 0
            for i in range(row * step, (row + 1) * step):
                for j in range(column * step, (column + 1) * step):
                    count += samples[i, j]
            image[row, column] = np.uint8(count * 255 // full)
