"""Differences of drawings that are blurred at several scales: smooth enough to search with."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from shapewright.comparison.outline import silhouette
from shapewright.rendering.ink import coverage
from shapewright.shapes import Drawing, Floats, Shape

SMALL = 64
"""Pixels along the side of the pictures that are compared."""
SCALES = ((12.0, 16), (6.0, 8), (3.0, 4), (1.0, 2))
"""Coarse to fine: a blur, as its standard deviation in pixels, and the pixels between the samples of a picture."""
UNIT = 56.0
"""What a black pixel counts: a step of the search takes 20 as small, which is about a third of it."""
_ENDS = np.cumsum([0, *((SMALL // step) ** 2 for _, step in SCALES)]).tolist()
PARTS = tuple(slice(start, end) for start, end in pairwise(_ENDS))
"""Of the residuals, one for each of the SCALES."""


class BlurredDifference:
    """How a replica differs from one drawing, as pictures blurred at every one of the SCALES.

    Blurred pictures change evenly while an edge moves by as much as the blur is wide, sharp ones within a pixel.
    """

    def __init__(self, reference: Drawing) -> None:
        self._reference = at_scales(coverage(reference, SMALL))

    def residual(self, replica: Shape) -> Floats | None:
        """(1360,): differences of the pictures' samples; a black pixel counts UNIT. PARTS tells the scales apart.

        None for a mesh, and for a replica so thin that no pixel shows it.
        """
        if not isinstance(replica, Drawing) or not silhouette(replica).any():
            return None
        return at_scales(coverage(replica, SMALL)) - self._reference


def _lens(blur: float, step: int) -> Floats:
    """(SMALL / step, SMALL): takes samples of a row of pixels, blurred; times what a sample stands for along it."""
    centres = np.arange(SMALL // step)[:, None] * step + (step - 1) / 2.0
    weights = np.exp(-0.5 * ((np.arange(SMALL) - centres) / blur) ** 2)
    return np.asarray(weights * (step / (blur * math.sqrt(2.0 * math.pi))))


_LENSES = tuple(_lens(*scale) for scale in SCALES)


def at_scales(covered: Floats, part: slice = slice(None)) -> Floats:
    """(K,): a picture (SMALL, SMALL) of coverage, 0 to 1, at the SCALES, in units of UNIT for each pixel of it.

    part: one of PARTS, for its scale alone.
    """
    lenses = _LENSES if part == slice(None) else (_LENSES[PARTS.index(part)],)
    sharp = covered * UNIT
    return np.concatenate([(lens @ sharp @ lens.T).ravel() for lens in lenses])
