"""How much two drawings differ to the eye: the light field's measures on the one silhouette that a drawing has.

Zernike moments of the region and Fourier coefficients of the outer contour (Chen et al. 2003, section 4; the program of
its authors replaces the moments by the angular radial transform), neither of them quantised.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import eval_jacobi

from shapewright.comparison.light_field.coefficients import coefficients
from shapewright.comparison.light_field.contours import FOURIER
from shapewright.comparison.light_field.regions import ART
from shapewright.rendering.ink import fill, outlines
from shapewright.rendering.silhouettes import SIZE
from shapewright.settings import Align
from shapewright.shapes import Bytes, Drawing, Floats

# Orders and repetitions of the 35 moments of the paper, order 0 left out: it is the same for every shape.
_ORDERS = np.array([(n, m) for n in range(1, 11) for m in range(n % 2, n + 1, 2)])


@dataclass(frozen=True, eq=False)
class Outline:
    """The coefficients of one drawing.

    zernike: (35,) complex moments of orders 1 to 10, moduli at most 1.
    fourier: (10,), magnitudes 1 to 10 of the contour, each over magnitude 0.
    """

    zernike: NDArray[np.complex128]
    fourier: Floats


def descriptor(drawing: Drawing) -> Outline:
    """The coefficients of a drawing; its position and size do not matter.

    Raises ValueError for a drawing so thin that no pixel shows it. A pixel is 1/128 of the largest extent.
    """
    image = silhouette(drawing)
    if not image.any():
        raise ValueError("the drawing is too thin to be seen; give its lines a width")
    return Outline(_zernike(image), coefficients(image[None])[0, ART : ART + FOURIER])


def descriptors(drawings: Iterable[Drawing]) -> list[Outline]:
    """The coefficients of many drawings, in their order: see ``descriptor``."""
    return [descriptor(drawing) for drawing in drawings]


def distance(a: Drawing | Outline, b: Drawing | Outline, align: Align = "free") -> float:
    """L1 distance of the coefficients, those of the contour twice as in the light field distance; 0 for equal drawings.

    align: "free" compares moduli, which no rotation and no reflection changes; "upright" compares the moments as
    complex numbers, which tell how a drawing is turned.
    """
    return float(distances([a], [b], align)[0, 0])


def distances(
    drawings: Sequence[Drawing | Outline], others: Sequence[Drawing | Outline] | None = None, align: Align = "free"
) -> Floats:
    """Distances (N, M) of N drawings to M others, or to each other: see ``distance``."""
    if align not in ("free", "upright"):
        raise ValueError(f'align is "free" or "upright", not {align!r}')
    first = _table(drawings, align)
    second = first if others is None else _table(others, align)
    return np.stack([np.abs(second - row).sum(axis=-1) for row in first]) if len(first) else np.zeros((0, len(second)))


def silhouette(drawing: Drawing) -> Bytes:
    """The normalised drawing in [-1, 1] x [-1, 1]: (256, 256), 1 where it covers a pixel's centre, bottom row first."""
    corners, rings, _ = outlines(drawing.normalised())
    image = np.empty((SIZE, SIZE), dtype=np.uint8)
    fill((corners + 1.0) * (SIZE / 2) - 0.5, rings, image)
    return image


def _zernike(image: Bytes) -> NDArray[np.complex128]:
    """Means of the Zernike polynomials over the foreground, mapped to the unit disc about the middle of its box."""
    rows, columns = np.nonzero(image)
    down, across = rows - (rows.min() + rows.max()) / 2.0, columns - (columns.min() + columns.max()) / 2.0
    radius = np.hypot(down, across)
    radius /= max(radius.max(), 1.0)
    turn = np.exp(-1j * np.arctan2(down, across))
    moments = [
        (radius**m * eval_jacobi((n - m) // 2, m, 0, 1.0 - 2.0 * radius**2) * turn**m).mean() for n, m in _ORDERS
    ]
    return np.array(moments)


def _table(drawings: Sequence[Drawing | Outline], align: Align) -> NDArray[np.complex128] | Floats:
    described = [drawing if isinstance(drawing, Outline) else descriptor(drawing) for drawing in drawings]
    moments = np.array([outline.zernike for outline in described]).reshape(-1, len(_ORDERS))
    contours = np.array([outline.fourier for outline in described]).reshape(-1, FOURIER)
    return np.concatenate([np.abs(moments) if align == "free" else moments, 2.0 * contours], axis=1)
