"""Drawings in PNG files: what is dark, outlined between the pixels."""

from __future__ import annotations

import io
from typing import Any, cast

import numpy as np
import shapely
from numpy.typing import NDArray

from shapewright.references.errors import UnreadableError
from shapewright.shapes import Drawing, Floats

MOST = 1024
"""Larger pictures are reduced to so many pixels along their longer side."""
_SLACK = 0.3
"""Pixels that an outline may be simplified by."""

# Which two sides of a cell an outline joins, by the sum of its dark corners: 1 top left, 2 top right, 4 bottom right,
# 8 bottom left. Sides: 0 top, 1 right, 2 bottom, 3 left. Two dark corners across from each other (5 and 10) stay apart.
_JOINED = {
    **dict.fromkeys((1, 14), ((3, 0),)),
    **dict.fromkeys((2, 13), ((0, 1),)),
    **dict.fromkeys((3, 12), ((3, 1),)),
    **dict.fromkeys((4, 11), ((1, 2),)),
    **dict.fromkeys((6, 9), ((0, 2),)),
    **dict.fromkeys((7, 8), ((2, 3),)),
    5: ((3, 0), (1, 2)),
    10: ((0, 1), (2, 3)),
}


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
    """The area where a picture (H, W) of values in [0, 1] is above one half, by marching squares; y up, in pixels."""
    grid = np.pad(darkness.astype(np.float64), 1)
    dark = grid > 0.5
    height, width = grid.shape
    rows, columns = np.mgrid[:height, :width] - 1.0
    with np.errstate(divide="ignore", invalid="ignore"):
        right = columns[:, :-1] + (0.5 - grid[:, :-1]) / np.diff(grid, axis=1)
        down = rows[:-1] + (0.5 - grid[:-1]) / np.diff(grid, axis=0)
    across, along = np.stack([right, rows[:, :-1]], axis=-1), np.stack([columns[:-1], down], axis=-1)
    sides = (across[:-1], along[:, 1:], across[1:], along[:, :-1])
    kinds = dark[:-1, :-1] + 2 * dark[:-1, 1:] + 4 * dark[1:, 1:] + 8 * dark[1:, :-1]
    pieces: list[Floats] = []
    for kind, joined in _JOINED.items():
        chosen = kinds == kind
        pieces += [np.stack([sides[a][chosen], sides[b][chosen]], axis=1) for a, b in joined]
    segments = np.concatenate(pieces) * [1.0, -1.0]
    lines: Any = shapely.linestrings(segments)
    rings = shapely.line_merge(shapely.multilinestrings(lines))
    area: Any = shapely.simplify(shapely.build_area(rings), _SLACK)
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
