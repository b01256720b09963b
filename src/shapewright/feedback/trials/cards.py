"""The picture of a suggestion: references with what they miss marked, the replicas before and after."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from shapewright.rendering.cameras import THUMBNAIL
from shapewright.rendering.raster import view
from shapewright.rendering.thumbnails import thumbnail
from shapewright.shapes import Floats, Mesh

Picture: TypeAlias = NDArray[np.uint8]
"""RGB and how much it covers, (rows, columns, 4): whoever shows it has a light or a dark ground."""
SIZE = 300
"""Pixels of each picture's sides."""
_LARGER = 2  # times that, pictures are drawn before they are cut to what they show
_MARGIN = 0.04  # around that, of its own side
_MARK, _STRENGTH = np.array([235, 110, 30]), 0.55  # colour of what is marked, and its share of the pixel's
_BEHIND = 0.03  # how far behind what a view shows a point may lie
_DOT = 3  # pixels around a point that are marked


@dataclass(frozen=True, eq=False)
class Example:
    """One row of a picture."""

    reference: Mesh
    marked: Floats  # points (N, 3) of the normalised reference that the replica before does not come near
    before: Mesh  # the replica by the procedure that is there
    after: Mesh  # the one by the changed procedure


def card(examples: Sequence[Example], size: int = SIZE) -> bytes:
    """PNG: a row for each example with the marked reference, the replica before and the one after.

    The three of a row are as large as their cells allow, at one scale.
    """
    meshes = [[(row.reference, row.marked), (row.before, None), (row.after, None)] for row in examples]
    rows = [_cut([_picture(*shown, _LARGER * size) for shown in row], size) for row in meshes]
    buffer = io.BytesIO()
    Image.fromarray(np.concatenate(rows)).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def _cut(pictures: Sequence[Picture], size: int) -> Picture:
    """One row of pictures, (size, n * size, 4), of the square around all that they show."""
    shown = np.any([picture[:, :, 3] > 0 for picture in pictures], axis=0)
    rows, columns = np.flatnonzero(shown.any(axis=1)), np.flatnonzero(shown.any(axis=0))
    if not len(rows):
        rows = columns = np.arange(len(shown))
    half = (0.5 + _MARGIN) * max(float(np.ptp(rows)), float(np.ptp(columns)), 1.0)
    middle = (columns[0] + columns[-1]) / 2.0, (rows[0] + rows[-1]) / 2.0
    left, top = (-round(place - half) for place in middle)
    cells = []
    for picture in pictures:
        cell = Image.new("RGBA", (round(2 * half),) * 2)
        cell.paste(Image.fromarray(picture), (left, top))
        cells.append(np.asarray(cell.resize((size, size), Image.Resampling.LANCZOS)))
    return np.concatenate(cells, axis=1)


def _picture(mesh: Mesh, marked: Floats | None, size: int) -> Picture:
    """The mesh in grey, and in orange what is marked, (size, size, 4)."""
    grey, alpha = np.moveaxis(np.array(Image.open(io.BytesIO(thumbnail(mesh, size))), dtype=np.float64), -1, 0)
    picture = np.repeat(grey[:, :, None], 3, axis=2)
    if marked is not None and len(marked):
        mask = _mask(mesh.normalised(), marked, size) & (alpha > 0)
        tinted = _MARK * (grey[mask] / 255.0)[:, None]
        picture[mask] = (1.0 - _STRENGTH) * picture[mask] + _STRENGTH * tinted
    return np.round(np.dstack([picture, alpha])).astype(np.uint8)


def _mask(mesh: Mesh, points: Floats, size: int) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """Pixels at points that can be seen, (size, size)."""
    _, inverse = view(mesh, THUMBNAIL, size)
    across, down, away = THUMBNAIL.project(points, size)
    column, row = across.astype(int), down.astype(int)
    mask = np.zeros((size, size), dtype=bool)
    for i in range(-_DOT, _DOT + 1):
        for j in range(-_DOT, _DOT + 1):
            r, c = np.clip(row + i, 0, size - 1), np.clip(column + j, 0, size - 1)
            seen = np.abs(inverse[r, c] * away - 1.0) < _BEHIND / away
            mask[r[seen], c[seen]] = True
    return mask
