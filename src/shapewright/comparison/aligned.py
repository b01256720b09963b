"""The light field distance of shapes that are aligned already: cheap enough to search with."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shapewright.comparison.coefficients import coefficients, levels, quantise
from shapewright.comparison.descriptor import Descriptor
from shapewright.comparison.dodecahedra import VIEWS, directions
from shapewright.comparison.least_cost import WEIGHTS, weighted
from shapewright.rendering.silhouettes_raster import SIZE, draw, view_axes
from shapewright.shapes import Mesh

FIELD = 0
"""The light field that is compared: it sees a shape from ten directions."""
_AXES = view_axes(directions()[FIELD])
Floats = NDArray[np.float64]


class AlignedCost:
    """The raw distance between one reference and its replicas, in one light field, without trying rotations.

    It is an upper bound of the light field distance, at a tenth of a descriptor's time.
    """

    def __init__(self, reference: Descriptor | Mesh) -> None:
        whole = quantise(_coefficients(reference)) if isinstance(reference, Mesh) else reference.coefficients[FIELD]
        self._target = weighted(whole, 4).astype(np.int64)
        self._middle = (whole + 0.5) * WEIGHTS

    def __call__(self, replica: Mesh) -> float:
        """The cost of a replica, infinite for one that no view shows."""
        values = _coefficients(replica)
        return float(np.abs(weighted(quantise(values), 4) - self._target).sum()) if values.any() else np.inf

    def residual(self, replica: Mesh) -> Floats | None:
        """(470,): the weighted differences of which the cost is the sum of absolute values, before quantisation.

        They vary smoothly with the replica's parameters. None for a replica that no view shows.
        """
        values = _coefficients(replica)
        return np.asarray(levels(values) * WEIGHTS - self._middle).ravel() if values.any() else None


def _coefficients(mesh: Mesh) -> Floats:
    vertices = mesh.normalisation().apply(mesh.vertices)
    images = np.empty((VIEWS, SIZE, SIZE), dtype=np.uint8)
    draw(vertices, mesh.faces, _AXES, images)
    return coefficients(images)
