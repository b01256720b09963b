"""Drawings in PNG files: what is dark, outlined between the pixels."""

from __future__ import annotations

import io
from typing import Any, cast

import numpy as np
import shapely
from contourpy import FillType, contour_generator
from numpy.typing import NDArray

from shapewright.references.errors import UnreadableError
from shapewright.shapes import Drawing

MOST = 1024
"""Pixels along the longer side; a larger picture is reduced to this size. A disc as large is outlined in 60 ms."""
_SLACK = 0.3
"""Pixels that an outline may be simplified by: less than half a pixel, so it stays between a dark and a light one."""


def read_png(data: bytes) -> tuple[Drawing, tuple[str, ...]]:
    """The dark part of a picture of any size, in pixels, y up; what is transparent counts as white.

    Raises UnreadableError where nothing is dark.
    """
    darkness = _darkness(data)
    if not (darkness > 0.5).any():
        raise UnreadableError("nothing in the picture is dark: a drawing is dark on white")
    lightest, darkest = float(darkness.min()), float(darkness.max())
    if lightest < 0.5:
        darkness = (darkness - lightest) / (darkest - lightest)  # grey ink on yellow paper
    rim = np.concatenate([darkness[0], darkness[-1], darkness[:, 0], darkness[:, -1]])
    inverted = (rim > 0.5).all() and not (darkness > 0.5).all()
    note = "dark all round: if it is meant to be light on dark, invert it"
    return Drawing(outline(darkness)), (note,) if inverted else ()


def outline(darkness: NDArray[np.float32]) -> shapely.Polygon | shapely.MultiPolygon:
    """The area where a picture (H, W) of values in [0, 1] is above one half, by marching squares; y up, in pixels.

    Two dark pixels that touch in a corner are joined where the mean of the four around it is above one half.
    """
    grid = np.pad(darkness.astype(np.float64), 1)
    height, width = grid.shape
    contours = contour_generator(np.arange(width) - 1.0, 1.0 - np.arange(height), grid, fill_type=FillType.OuterOffset)
    parts: list[shapely.Polygon] = []
    for points, offsets in zip(*contours.filled(0.5, np.inf), strict=True):
        rim, *holes = np.split(points, offsets[1:-1])
        parts.append(shapely.Polygon(rim, holes))
    whole: Any = parts[0] if len(parts) == 1 else shapely.MultiPolygon(parts)
    area: Any = shapely.simplify(whole, _SLACK)
    return cast("shapely.Polygon | shapely.MultiPolygon", area if area.is_valid else shapely.make_valid(area))


def _darkness(data: bytes) -> NDArray[np.float32]:
    """(H, W): 0 for white to 1 for black."""
    from PIL import Image

    with Image.open(io.BytesIO(data), formats=["PNG"]) as image:
        image.load()
        if image.mode.startswith("I"):  # 16 bits, which a conversion would cut off at 255
            return 1.0 - _reduced(Image.fromarray(np.asarray(image, dtype=np.float32) / np.float32(65535.0)))
        coloured = image.convert("RGBA")
    white = Image.new("RGBA", coloured.size, "white")
    white.alpha_composite(coloured)
    return 1.0 - _reduced(white.convert("L").convert("F")) / np.float32(255.0)


def _reduced(image: Any) -> NDArray[np.float32]:
    scale = MOST / max(image.size)
    if scale < 1.0:
        from PIL import Image

        image = image.resize([max(1, round(side * scale)) for side in image.size], Image.Resampling.BOX)
    return np.asarray(image, dtype=np.float32)
