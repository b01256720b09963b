"""The light field distance of shapes that are aligned already: cheap enough to search with."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shapewright.comparison.coefficients import coefficients, quantise
from shapewright.comparison.descriptor import Descriptor
from shapewright.comparison.dodecahedra import directions
from shapewright.comparison.least_cost import weighted
from shapewright.rendering.silhouettes_raster import silhouettes
from shapewright.shapes import Mesh

FIELDS = (0,)
"""Light fields that are compared: each sees a shape from ten directions."""


class AlignedCost:
    """The raw distance between one reference and its replicas, over FIELDS, without trying rotations.

    With one light field it is an upper bound of the light field distance, at a tenth of a descriptor's time.
    """

    def __init__(self, reference: Descriptor) -> None:
        self._target = weighted(reference.coefficients[list(FIELDS)], reference.bits).astype(np.int64)

    def __call__(self, replica: Mesh) -> float:
        """The cost of a replica, infinite for one that no view shows."""
        mesh = replica.normalised()
        seen: list[NDArray[np.uint8]] = []
        for field in FIELDS:
            values = coefficients(silhouettes(mesh, directions()[field]))
            if not values.any():
                return np.inf
            seen.append(quantise(values))
        ours = weighted(np.stack(seen), 4).astype(np.int64)
        return float(np.abs(ours - self._target).sum() / len(FIELDS))
