"""Residual colours: how far each place of one surface is from the other, on a mesh fine enough to show it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from shapewright.comparison.surface_distance import NearSurface
from shapewright.shapes import Floats, Ints, Mesh

LIMIT = 0.1
"""Distance at the end of the colour scale, in units of the largest extent."""
_LONGEST = 0.05
_MOST = 30_000
# sRGB. Where a shape has too much, where it agrees, and where it lies inside the other.
_BEYOND, _AGREES, _WITHIN = (203, 60, 42), (226, 226, 222), (41, 98, 176)


@dataclass(frozen=True, eq=False)
class Residual:
    """vertices (V, 3), faces (F, 3); distances (V,) to the other surface; colours (V, 3) in linear light, 0 to 1."""

    vertices: Floats
    faces: Ints
    distances: Floats
    colours: Floats
    signed: bool  # whether the other surface has an inside; distances are then negative there


class ResidualColours:
    """The residual colours of replicas against one reference; all meshes are normalised."""

    def __init__(self, reference: Mesh) -> None:
        self.reference = reference

    @cached_property
    def _surface(self) -> NearSurface:
        return NearSurface(self.reference)

    @cached_property
    def _refined(self) -> Mesh:
        return refined(self.reference)

    def of(self, replica: Mesh) -> dict[Literal["replica", "reference"], Residual]:
        """Of the replica against the reference, and of the reference against the replica."""
        return {
            "replica": residual(refined(replica), self._surface),
            "reference": residual(self._refined, NearSurface(replica)),
        }


def residual(mesh: Mesh, other: NearSurface) -> Residual:
    """Colour the vertices of a mesh by their distance to another surface, both normalised; see ``refined``."""
    distances = other.distances(mesh.vertices)
    return Residual(mesh.vertices, mesh.faces, distances, scale(distances), other.closed)


def scale(distances: Floats) -> Floats:
    """(N, 3) colours of distances (N,): grey at 0, red at LIMIT and beyond, blue at -LIMIT; linear light."""
    beyond, agrees, within = (_linear(np.array(colour) / 255.0) for colour in (_BEYOND, _AGREES, _WITHIN))
    share = np.clip(distances / LIMIT, -1.0, 1.0)[:, None]
    end = np.where(share >= 0.0, beyond, within)
    return np.asarray(agrees + np.abs(share) ** 0.7 * (end - agrees))


def refined(mesh: Mesh, longest: float = _LONGEST) -> Mesh:
    """The same surface in triangles whose edges are at most ``longest``, as far as _MOST triangles allow.

    Triangles are halved at the middle of their longest edge, the largest first; a mesh of very many may become a
    quarter more. Vertices at the same place become one.
    """
    triangles = mesh.triangles
    most = max(_MOST, len(triangles) * 5 // 4)
    while True:
        squared = ((triangles - np.roll(triangles, -1, axis=1)) ** 2).sum(axis=2)
        length = squared.max(axis=1)
        long = length > longest**2
        left = most - len(triangles)
        if not long.any() or left <= 0:
            break
        if int(long.sum()) > left:
            long = np.zeros(len(triangles), dtype=bool)
            long[np.argpartition(-length, left - 1)[:left]] = True
        rows = np.arange(int(long.sum()))
        edge = squared[long].argmax(axis=1)
        cut = triangles[long]
        a, b, c = cut[rows, edge], cut[rows, (edge + 1) % 3], cut[rows, (edge + 2) % 3]
        middle = (a + b) / 2.0
        halves = np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])
        triangles = np.concatenate([triangles[~long], halves])
    keys = np.ascontiguousarray(np.round(triangles.reshape(-1, 3), 6) + 0.0).view(np.dtype((np.void, 24))).ravel()
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    return Mesh(triangles.reshape(-1, 3)[first], inverse.reshape(-1, 3))


def _linear(srgb: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4))
