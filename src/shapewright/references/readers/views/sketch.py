"""Line sketches as silhouettes: what their outer lines enclose."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from shapewright.references.errors import UnreadableError

Mask: TypeAlias = NDArray[np.bool_]

_THIN = 0.02  # half the width of a line, at most, as a share of the picture's longer side
_LARGEST_GAP = 0.03  # share of the drawing's longer side up to which gaps in an outline are closed
_WHOLE = 0.9  # share of the largest area that closing gaps encloses; as much is enclosed with as few closed as it takes
_ENCLOSED = 1.5  # times the area of the lines that a filled sketch has at least


def is_sketch(ink: Mask) -> bool:
    """Whether what is dark consists of lines."""
    depth = ndimage.distance_transform_edt(np.pad(ink, 1))
    return bool(ink.any() and depth.max() <= max(2.0, _THIN * max(ink.shape)))


def filled(ink: Mask) -> tuple[Mask, str]:
    """What lines enclose, lines included, and a note.

    Where the outline has gaps these are closed, the smallest first, up to 3 % of its size. Raises UnreadableError where
    it stays open.
    """
    rows, columns = (np.flatnonzero(ink.any(axis=axis)) for axis in (1, 0))
    size = max(np.ptp(rows), np.ptp(columns)) + 1
    most = int(_LARGEST_GAP * size / 2.0) + 1
    wide = np.pad(ink, most + 1)
    away = ndimage.distance_transform_edt(~wide)
    found = [_closed(wide, away, reach) for reach in range(most + 1)]
    areas = [int(mask.sum()) for mask in found]
    if max(areas) >= _ENCLOSED * ink.sum():
        reach = next(i for i, area in enumerate(areas) if area >= _WHOLE * max(areas))
        note = "a line sketch: filled inside its outline"
        closed = f"{note}, over gaps of up to {2 * reach} pixels" if reach else note
        return np.asarray(found[reach][most + 1 : -most - 1, most + 1 : -most - 1]), closed
    raise UnreadableError(
        "a line sketch whose outline is open: close it, or put a mask beside it, white where the object is, as "
        "NAME.mask.png"
    )


def _closed(ink: Mask, away: NDArray[np.float64], reach: int) -> Mask:
    """What is enclosed where lines are thicker by ``reach`` on either side, and thinner again after that."""
    if reach == 0:
        return np.asarray(ndimage.binary_fill_holes(ink))
    inside = ndimage.binary_fill_holes(away <= reach)
    return np.asarray((ndimage.distance_transform_edt(inside) > reach) | ink)
