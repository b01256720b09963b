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

_AXES = [view_axes(views) for views in directions()]
Floats = NDArray[np.float64]


class AlignedCost:
    """The raw distance between one reference and its replicas, in one light field, without trying rotations.

    It is an upper bound of the light field distance, at a tenth of a descriptor's time; for shapes that are aligned
    the least over the fields is hardly above it. field: 0 to 9, each sees a shape from ten directions.
    """

    def __init__(self, reference: Mesh, field: int = 0) -> None:
        self._axes = _AXES[field]
        values = self._coefficients(reference)
        self._whole, self._exact = weighted(quantise(values), 4).astype(np.int64), levels(values) * WEIGHTS

    def __call__(self, replica: Mesh) -> float:
        """The cost of a replica, infinite for one that no view shows."""
        values = self._coefficients(replica)
        return float(np.abs(weighted(quantise(values), 4) - self._whole).sum()) if values.any() else np.inf

    def residual(self, replica: Mesh) -> Floats | None:
        """(470,): the weighted differences of which the cost is the sum of absolute values, before quantisation.

        They vary smoothly with the replica's parameters. None for a replica that no view shows.
        """
        values = self._coefficients(replica)
        return np.asarray(levels(values) * WEIGHTS - self._exact).ravel() if values.any() else None

    def _coefficients(self, mesh: Mesh) -> Floats:
        vertices = mesh.normalisation().apply(mesh.vertices)
        images = np.empty((VIEWS, SIZE, SIZE), dtype=np.uint8)
        draw(vertices, mesh.faces, self._axes, images)
        return coefficients(images)


def nearest_field(a: Descriptor, b: Descriptor) -> int:
    """The light field in which two shapes that are aligned differ least."""
    apart = [
        np.abs(x.astype(np.int64) - y).sum(axis=0) @ WEIGHTS
        for x, y in zip(a.coefficients, b.coefficients, strict=True)
    ]
    return int(np.argmin(apart))
