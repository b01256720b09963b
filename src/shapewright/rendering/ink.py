"""Drawings as pictures: areas filled by even and odd."""

from __future__ import annotations

import io
from typing import TypeAlias

import numpy as np
import shapely
from numba import njit
from numpy.typing import NDArray

from shapewright.shapes import Drawing

Bytes: TypeAlias = NDArray[np.uint8]
Floats: TypeAlias = NDArray[np.float64]
Ints: TypeAlias = NDArray[np.int64]

HALF = 0.53
"""Half the side of the page that pictures show, the drawing's largest extent being 1."""


def picture(drawing: Drawing, size: int, supersample: int) -> Bytes:
    """Two pictures of a drawing, (2, size, size), row 0 at the top; 0 is white and 255 black.

    Channel 0 shows it normalised; channel 1 stretched to the same width and height, in which flat and narrow drawings
    show as much as others. Each pixel is the mean of supersample x supersample samples.
    """
    points, rings = outlines(drawing)
    low, high = points.min(axis=0), points.max(axis=0)
    centre, extent = (low + high) / 2.0, high - low
    side = size * supersample
    samples = np.empty((2, side, side), dtype=np.uint8)
    for channel, unit in enumerate((extent.max(), extent)):
        scaled = (points - centre) / unit * [1.0, -1.0]
        fill((scaled + HALF) * (side / (2.0 * HALF)) - 0.5, rings, samples[channel])
    blocks = samples.reshape(2, size, supersample, size, supersample)
    return np.asarray(blocks.mean(axis=(2, 4)) * 255.0 + 0.5).astype(np.uint8)


def png(drawing: Drawing, size: int = 512) -> bytes:
    """A PNG file of a drawing, black on white, its largest extent nearly filling size x size pixels."""
    from PIL import Image

    buffer = io.BytesIO()
    Image.fromarray(255 - picture(drawing, size, 4)[0]).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def outlines(drawing: Drawing) -> tuple[Floats, Ints]:
    """The corners of all rings, (P, 2), one ring after the other, and where each begins and the last ends, (R + 1,).

    Each ring ends with its first corner; no two rings enclose the same area twice.
    """
    geometry = drawing.geometry
    if geometry.geom_type != "Polygon":
        parts = shapely.get_parts(shapely.unary_union(geometry))
        rings = shapely.get_rings(parts[shapely.area(parts) > 0.0])
    else:
        rings = shapely.get_rings(geometry)
    counts = shapely.get_num_coordinates(rings)
    return shapely.get_coordinates(rings), np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)


@njit(nogil=True, cache=True)
def fill(points: Floats, rings: Ints, image: Bytes) -> None:
    """Set to 1 what lies in the rings, by even and odd, and the rest to 0.

    points: (P, 2), column and row; whole numbers are pixel centres. rings: as ``outlines`` gives them. What lies
    outside the image is cut off.
    """
    rows, columns = image.shape
    image[:] = 0
    for r in range(len(rings) - 1):
        for i in range(rings[r], rings[r + 1] - 1):
            xa, ya, xb, yb = points[i, 0], points[i, 1], points[i + 1, 0], points[i + 1, 1]
            if ya > yb:
                xa, ya, xb, yb = xb, yb, xa, ya
            first, end = max(0, int(np.ceil(ya))), min(rows, int(np.ceil(yb)))
            for row in range(first, end):
                column = max(0, int(np.ceil(xa + (row - ya) * (xb - xa) / (yb - ya))))
                if column < columns:
                    image[row, column] ^= 1
    for row in range(rows):
        for column in range(1, columns):
            image[row, column] ^= image[row, column - 1]
