"""The 47 coefficients of a silhouette in the light field descriptor, and their quantisation.

Chen, Tian, Shen, Ouhyoung, "On Visual Similarity Based 3D Model Retrieval", 2003, with the tables, the rounding and the
order of the program that its authors published: quantised coefficients equal those of that program when it is fed the
same silhouettes.
"""

from __future__ import annotations

import numpy as np

from shapewright.comparison.light_field.contours import FOURIER, contour_coefficients
from shapewright.comparison.light_field.regions import ART, BASIS, CELLS, region_coefficients
from shapewright.shapes import Bytes, Floats

COEFFICIENTS = ART + FOURIER + 2

_ART_LEVELS = (  # of 4 bits: the largest index whose level is below the value
    *(0.0, 0.003585473, 0.007418411, 0.011535520, 0.015982337, 0.020816302, 0.026111312, 0.031964674),
    *(0.038508176, 0.045926586, 0.054490513, 0.064619488, 0.077016351, 0.092998687, 0.115524524, 0.154032694),
)

# The end of the last level, as wide as the one before: quantise has no need of it, levels has.
_ART_END = 2.0 * _ART_LEVELS[-1] - _ART_LEVELS[-2]


def coefficients(images: Bytes) -> Floats:
    """Coefficients (V, 47) of the silhouettes (V, 256, 256) of one light field, which share one scale.

    images: 1 in the foreground and 0 elsewhere, with at least ``contours.MARGIN`` empty pixels along every border.
    Returns 35 of the region's transform, 10 of the contour's, circularity and eccentricity, all in [0, 1] or, for
    the contour's, about that; all 0 for an empty silhouette.
    """
    result = np.empty((len(images), COEFFICIENTS))
    boxes = np.empty((len(images), 4), dtype=np.int64)
    art, fourier = np.empty((len(images), ART)), np.empty((len(images), FOURIER))
    region_coefficients(images, CELLS, BASIS, boxes, art, result[:, -2], result[:, -1])
    contour_coefficients(images, boxes, fourier)
    result[:, :ART], result[:, ART:-2] = art, fourier
    return result


def quantise(values: Floats, bits: int = 4) -> Bytes:
    """Coefficients (..., 47) to whole numbers: ART to 4 or 8 bits, Fourier to 8 bits of [0, 1/2], the others of [0, 1].

    Raises ValueError for any other number of bits.
    """
    if bits not in (4, 8):
        raise ValueError(f"ART coefficients have 4 or 8 bits, not {bits}")
    whole = np.minimum(values * 256.0, 255.0)
    whole[..., ART:-2] = np.minimum(values[..., ART:-2] * 512.0, 255.0)
    if bits == 4:
        whole[..., :ART] = np.maximum(np.searchsorted(_ART_LEVELS, values[..., :ART]) - 1, 0)
    return whole.astype(np.uint8)


def levels(values: Floats) -> Floats:
    """Coefficients (..., 47) on the scale of ``quantise`` with ART of 4 bits, but not rounded down."""
    scaled = values * 256.0
    scaled[..., ART:-2] *= 2.0
    scaled[..., :ART] = np.interp(values[..., :ART], (*_ART_LEVELS, _ART_END), np.arange(len(_ART_LEVELS) + 1))
    return scaled
