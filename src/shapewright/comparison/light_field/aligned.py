"""The light field distance of shapes that are aligned already: cheap enough to search with."""

from __future__ import annotations

import numpy as np

from shapewright.comparison.light_field.coefficients import coefficients, levels, quantise
from shapewright.comparison.light_field.description import Descriptor
from shapewright.comparison.light_field.dodecahedra import VIEWS, directions
from shapewright.comparison.light_field.least_cost import WEIGHTS, weighted
from shapewright.rendering.cameras import THREE_VIEWS, Camera
from shapewright.rendering.raster import render
from shapewright.rendering.silhouettes import SIZE, draw, view_axes
from shapewright.shapes import Floats, Mesh, Shape

_AXES = [view_axes(views) for views in directions()]
_DEPTH = 3000.0
"""What depth counts where it differs altogether, on the raw scale of distances: compatible shapes are up to 2700 apart.

Little beside a light field that differs, much beside one that does not. docs/benchmarks.md has what depth brings.
"""
_DEPTH_VIEWS = (*THREE_VIEWS, Camera(215.0, -25.0))
"""The fourth looks from behind and below: at undersides and backs, which the others do not see."""
_DEPTH_SIZE = 24
"""Pixels along the side of a picture of depth: 24 found more than 16, see docs/benchmarks.md."""


class AlignedCost:
    """How a replica differs from one reference in one light field, without trying rotations; and in depth.

    The light field's part is an upper bound of the raw distance, and takes a tenth of a descriptor's time. For shapes
    that are aligned, the least over the fields is hardly above the distance. Depth shows what silhouettes cannot, such
    as the boards in a closed shelf. field: 0 to 9, each sees a shape from ten directions.
    """

    def __init__(self, reference: Mesh, field: int = 0) -> None:
        self._axes = _AXES[field]
        normal = reference.normalised()
        values = self._coefficients(normal)
        self._whole, self._exact = weighted(quantise(values), 4).astype(np.int64), levels(values)
        self._depths = _depths(normal)

    def __call__(self, replica: Mesh) -> float:
        """The raw distance, infinite for a replica that no view shows."""
        values = self._coefficients(replica.normalised())
        return float(np.abs(weighted(quantise(values), 4) - self._whole).sum()) if values.any() else np.inf

    def residual(self, replica: Shape) -> Floats | None:
        """(2774,): what a search makes small, the sum of absolute values: weighted differences, before quantisation.

        They vary smoothly with the replica's parameters: 470 of the light field, then those of depth. None for a
        drawing, and for a replica that no view shows.
        """
        if not isinstance(replica, Mesh):
            return None
        normal = replica.normalised()
        light = self.light(normal)
        if light is None:
            return None
        return np.concatenate([light, (_depths(normal) - self._depths) * (_DEPTH / len(self._depths))])

    def light(self, normal: Mesh) -> Floats | None:
        """(470,): the part of the residual that is the light field's, of a normalised replica."""
        values = self._coefficients(normal)
        return ((levels(values) - self._exact) * WEIGHTS).ravel() if values.any() else None

    def _coefficients(self, normal: Mesh) -> Floats:
        images = np.empty((VIEWS, SIZE, SIZE), dtype=np.uint8)
        draw(normal.vertices, normal.faces, self._axes, images)
        return coefficients(images)


def _depths(normal: Mesh) -> Floats:
    """(2304,): small pictures of a normalised shape's depth, 0 to 1."""
    pictures = render([normal], _DEPTH_VIEWS, size=_DEPTH_SIZE, supersample=3, threads=1)
    return pictures[0, :, 1].ravel() / 255.0


def nearest_field(a: Descriptor, b: Descriptor) -> int:
    """The light field in which two shapes that are aligned differ least."""
    apart = [
        np.abs(x.astype(np.int64) - y).sum(axis=0) @ WEIGHTS
        for x, y in zip(a.coefficients, b.coefficients, strict=True)
    ]
    return int(np.argmin(apart))
