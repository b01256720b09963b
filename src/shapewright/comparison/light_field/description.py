"""The light field descriptor of one shape: 10 light fields x 10 silhouettes x 47 whole numbers (Chen et al. 2003)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from shapewright.comparison.light_field.coefficients import COEFFICIENTS, coefficients, quantise
from shapewright.comparison.light_field.dodecahedra import LIGHT_FIELDS, VIEWS, directions
from shapewright.comparison.light_field.least_cost import Weighted, by_coefficient, weighted
from shapewright.rendering.silhouettes import SIZE, draw, view_axes
from shapewright.shapes import Bytes, Mesh

_AXES = view_axes(directions())


@dataclass(frozen=True, eq=False)
class Descriptor:
    """Quantised coefficients of a shape's silhouettes.

    coefficients: (10, 10, 47), uint8, by light field and view: 35 of the region's transform (ART), 10 of the contour's
        (Fourier), circularity, eccentricity. All 0 for a silhouette of no pixels: a flat sheet's that is seen edge-on.
    bits: of the 35, which are 0 to 15 when it is 4, and 0 to 255 like the others when it is 8.
    """

    coefficients: Bytes
    bits: int = 4

    @cached_property
    def by_view(self) -> Weighted:
        """Weighted coefficients (10, 10, 47) as ``least_cost.least_of_some`` takes them."""
        return weighted(self.coefficients, self.bits)

    @cached_property
    def by_coefficient(self) -> Weighted:
        """Weighted coefficients (47, 100) as ``least_cost.least_of_all`` takes them."""
        return by_coefficient(self.by_view)


def describe(mesh: Mesh, bits: int = 4) -> Descriptor:
    """The descriptor of a mesh; it does not depend on the mesh's position and size, nor on the order of its faces.

    bits: of the ART coefficients, 4 or 8. Raises ValueError for any other number, and for a mesh that has no
    faces, no size, or none that a double can hold, or that covers no pixel in any view, as a line does.
    """
    if not isinstance(mesh, Mesh):
        raise TypeError("the light field compares meshes; drawings are compared by shapewright.outline")
    transform = mesh.normalisation()
    if not (math.isfinite(transform.scale) and transform.scale > 0.0 and np.isfinite(transform.centre).all()):
        raise ValueError(
            "a mesh of this size cannot be normalised; its coordinates are too large or too close together"
        )
    vertices = transform.apply(mesh.vertices)
    values = np.empty((LIGHT_FIELDS, VIEWS, COEFFICIENTS))
    images = np.empty((VIEWS, SIZE, SIZE), dtype=np.uint8)
    for axes, of_light_field in zip(_AXES, values, strict=True):
        draw(vertices, mesh.faces, axes, images)
        of_light_field[:] = coefficients(images)
    if not values.any():
        raise ValueError("no view shows a pixel of the mesh: its triangles have no area to speak of")
    return Descriptor(quantise(values, bits), bits)
