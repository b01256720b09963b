"""The light field descriptor of one shape: 10 light fields x 10 silhouettes x 47 whole numbers (Chen et al. 2003)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from shapewright.comparison.light_field.coefficients import COEFFICIENTS, coefficients, quantise
from shapewright.comparison.light_field.contours import FOURIER
from shapewright.comparison.light_field.dodecahedra import LIGHT_FIELDS, VIEWS, directions
from shapewright.comparison.light_field.least_cost import Weighted, by_coefficient, weighted
from shapewright.comparison.light_field.regions import ART
from shapewright.rendering.silhouettes import SIZE, draw, view_axes
from shapewright.shapes import Mesh

Bytes = NDArray[np.uint8]

_AXES = view_axes(directions())


@dataclass(frozen=True, eq=False)
class Descriptor:
    """Quantised coefficients of a shape's silhouettes, uint8; the axes are light field, view, coefficient.

    A silhouette of no pixels, such as that of a flat sheet seen edge-on, is all 0.

    art: (10, 10, 35), 0 to 15 when ``bits`` is 4 and 0 to 255 when it is 8.
    fourier: (10, 10, 10), 0 to 255.
    circularity: (10, 10), 0 to 255.
    eccentricity: (10, 10), 0 to 255.
    bits: of ``art``, 4 or 8.
    """

    art: Bytes
    fourier: Bytes
    circularity: Bytes
    eccentricity: Bytes
    bits: int = 4

    @cached_property
    def coefficients(self) -> Bytes:
        """All 47 of each silhouette in the order of the fields: (10, 10, 47)."""
        others = np.stack([self.circularity, self.eccentricity], axis=-1)
        return np.concatenate([self.art, self.fourier, others], axis=-1)

    @cached_property
    def by_view(self) -> Weighted:
        """Weighted coefficients (10, 10, 47) as ``least_cost.least_of_some`` takes them."""
        return weighted(self.coefficients, self.bits)

    @cached_property
    def by_coefficient(self) -> Weighted:
        """Weighted coefficients (47, 100) as ``least_cost.least_of_all`` takes them."""
        return by_coefficient(self.by_view)

    @classmethod
    def of(cls, coefficients: Bytes, bits: int = 4) -> Descriptor:
        """The inverse of ``coefficients``."""
        art, fourier, circularity, eccentricity = np.split(
            coefficients, [ART, ART + FOURIER, ART + FOURIER + 1], axis=-1
        )
        return cls(art, fourier, circularity[..., 0], eccentricity[..., 0], bits)


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
    return Descriptor.of(quantise(values, bits), bits)
