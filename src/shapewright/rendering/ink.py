"""Drawings as pictures: areas filled by even and odd."""

from __future__ import annotations

import io

import numpy as np
import shapely
from numba import njit
from numpy.typing import NDArray

from shapewright.shapes import Bytes, Drawing, Floats, Ints

HALF = 0.53  # half the side of the page that pictures show, the drawing's largest extent being 1


def picture(drawing: Drawing, size: int, supersample: int) -> Bytes:
    """Two pictures of a drawing, (2, size, size), row 0 at the top; 0 is white and 255 black.

    Channel 0 shows it normalised; channel 1 stretched to the same width and height, in which flat and narrow drawings
    show as much as others. Each pixel is the mean of supersample x supersample samples.
    """
    points, rings, _ = outlines(drawing)
    low, high = points.min(axis=0), points.max(axis=0)
    centre, extent = (low + high) / 2.0, high - low
    side = size * supersample
    samples = np.empty((2, side, side), dtype=np.uint8)
    for channel, unit in enumerate((extent.max(), extent)):
        scaled = (points - centre) / unit * [1.0, -1.0]
        fill((scaled + HALF) * (side / (2.0 * HALF)) - 0.5, rings, samples[channel])
    blocks = samples.reshape(2, size, supersample, size, supersample)
    return np.asarray(blocks.mean(axis=(2, 4)) * 255.0 + 0.5).astype(np.uint8)


def coverage(drawing: Drawing, size: int) -> Floats:
    """The share of each pixel that a normalised drawing covers, exactly: (size, size), row 0 at the top, 0 to 1.

    Unlike ``picture`` it changes evenly with the drawing, however little that moves. The page is the same.
    """
    points, rings, holes = outlines(drawing)
    low, high = points.min(axis=0), points.max(axis=0)
    scaled = (points - (low + high) / 2.0) / (high - low).max() * [1.0, -1.0]
    image = np.zeros((size, size + 1))
    _cover((scaled + HALF) * (size / (2.0 * HALF)), rings, holes, image)
    return np.cumsum(image, axis=1)[:, :size]


def png(drawing: Drawing, size: int = 512) -> bytes:
    """A PNG file of a drawing, black on white, its largest extent nearly filling size x size pixels."""
    from PIL import Image

    buffer = io.BytesIO()
    Image.fromarray(255 - picture(drawing, size, 4)[0]).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def outlines(drawing: Drawing) -> tuple[Floats, Ints, NDArray[np.bool_]]:
    """The corners of all rings, (P, 2), one ring after the other, where each begins and the last ends, (R + 1,), holes.

    Each ring ends with its first corner; no two rings enclose the same area twice. The last are the rings that are
    holes, (R,).
    """
    geometry = drawing.geometry
    parts = shapely.get_parts(geometry if geometry.geom_type == "Polygon" else shapely.unary_union(geometry))
    rings, owners = shapely.get_rings(parts[shapely.area(parts) > 0.0], return_index=True)
    counts = shapely.get_num_coordinates(rings)
    starts = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
    return shapely.get_coordinates(rings), starts, np.diff(owners, prepend=-1) == 0


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


@njit(nogil=True, cache=True)
def _cover(points: Floats, rings: Ints, holes: NDArray[np.bool_], image: Floats) -> None:
    """Add to each pixel by how much more of it is covered than of its left neighbour.

    points: (P, 2), column and row inside the image but for its last column; whole numbers are pixel corners. An edge
    covers what lies to its right in the rows that it crosses, more or less by its direction; the sum over a ring's
    edges is what lies in it.
    """
    for r in range(len(rings) - 1):
        first, last = rings[r], rings[r + 1] - 1
        area = 0.0
        for i in range(first, last):
            area += (points[i, 0] + points[i + 1, 0]) * (points[i, 1] - points[i + 1, 1])
        for i in range(first, last):
            xa, ya, xb, yb = points[i, 0], points[i, 1], points[i + 1, 0], points[i + 1, 1]
            sign = 1.0 if (area < 0.0) != holes[r] else -1.0
            if ya < yb:
                xa, ya, xb, yb, sign = xb, yb, xa, ya, -sign
            for row in range(int(yb), int(np.ceil(ya)) if ya > yb else 0):
                above, below = max(yb, float(row)), min(ya, row + 1.0)
                left = xb + (above - yb) * (xa - xb) / (ya - yb)
                right = xb + (below - yb) * (xa - xb) / (ya - yb)
                left, right = min(left, right), max(left, right)
                before, weight = 0.0, sign * (below - above)
                for column in range(int(left), int(right) + 2):
                    covered = _passed(column + 1.0, left, right) - _passed(float(column), left, right)
                    image[row, column] += weight * (covered - before)
                    before = covered


@njit(nogil=True, cache=True)
def _passed(column: float, left: float, right: float) -> float:
    """How far an edge that spans from left to right lies behind a column, on average over its rows."""
    if column <= left:
        return 0.0
    if column >= right:
        return column - (left + right) / 2.0
    return (column - left) ** 2 / (2.0 * (right - left))
