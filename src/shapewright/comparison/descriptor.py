"""The light field descriptor of one shape: 10 light fields x 10 silhouettes x 47 whole numbers (Chen et al. 2003)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from shapewright.comparison.coefficients import ART, BASIS, CELLS, FOURIER, light_field_coefficients, quantise
from shapewright.comparison.dodecahedra import LIGHT_FIELDS, VIEWS, directions
from shapewright.rendering.silhouettes_raster import SIZE, fill_triangles, project, view_axes
from shapewright.shapes import Mesh

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_AXES = view_axes(directions())


@dataclass(frozen=True, eq=False)
class Descriptor:
    """Quantised coefficients of a shape's silhouettes; the axes are light field, view, coefficient. All uint8.

    art: (10, 10, 35), 0 to 15 when ``bits`` is 4 and 0 to 255 when it is 8. fourier: (10, 10, 10).
    circularity, eccentricity: (10, 10). A silhouette of no pixels, such as that of a flat sheet seen edge-on, is all 0.
    """

    art: Bytes
    fourier: Bytes
    circularity: Bytes
    eccentricity: Bytes
    bits: int = 4

    @property
    def coefficients(self) -> Bytes:
        """All 47 of each silhouette in the order of the fields: (10, 10, 47)."""
        others = np.stack([self.circularity, self.eccentricity], axis=-1)
        return np.concatenate([self.art, self.fourier, others], axis=-1)

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
    transform = mesh.normalisation()
    if not (math.isfinite(transform.scale) and transform.scale > 0.0 and np.isfinite(transform.centre).all()):
        raise ValueError(
            "a mesh of this size cannot be normalised; its coordinates are too large or too close together"
        )
    art = np.empty((LIGHT_FIELDS, VIEWS, ART))
    fourier = np.empty((LIGHT_FIELDS, VIEWS, FOURIER))
    others = np.empty((LIGHT_FIELDS, VIEWS, 2))
    _describe(transform.apply(mesh.vertices), mesh.faces, _AXES, CELLS, BASIS, art, fourier, others)
    if not art.any():
        raise ValueError("no view shows a pixel of the mesh: its triangles have no area to speak of")
    return Descriptor.of(np.concatenate(quantise(art, fourier, others, bits), axis=-1), bits)


@njit(nogil=True, cache=True)
def _describe(
    vertices: Floats,
    faces: Ints,
    axes: Floats,
    cells: Ints,
    basis: Floats,
    art: Floats,
    fourier: Floats,
    others: Floats,
) -> None:
    images = np.empty((VIEWS, SIZE, SIZE), np.uint8)
    columns, rows = np.empty(len(vertices)), np.empty(len(vertices))
    for i in range(LIGHT_FIELDS):
        images[:] = 0
        for m in range(VIEWS):
            project(vertices, axes[i, m], columns, rows)
            fill_triangles(columns, rows, faces, images[m])
        light_field_coefficients(images, cells, basis, art[i], fourier[i], others[i])
