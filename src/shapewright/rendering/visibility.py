"""What of a mesh can be seen from outside, and what lies inside it, by its depths in views from all round.

References are triangle soups with faces inside them that nobody sees, and some of their faces point the wrong way, so
neither closed surfaces nor normals help.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product

import numpy as np
from numba import njit
from numpy.typing import NDArray

from shapewright.rendering.cameras import Camera, pack
from shapewright.rendering.raster import Singles, view
from shapewright.shapes import Floats, Ints, Mesh

_DISTANCE = 4.0
"""Of the cameras to the origin, in units of the mesh's largest extent: far enough for little perspective."""
_STEEPEST = 0.25
"""Cosine between a face and the view that still shows where it lies: depths at steeper faces are too coarse."""
_DEEP = 0.004
"""How far behind what a view shows a hidden point lies, as a share of the distance to it: more than rounding."""


@dataclass(frozen=True, eq=False)
class AllRound:
    """A normalised mesh, seen from in front of the faces, edges and corners of a cube around it."""

    cameras: tuple[Camera, ...]  # the 26 places
    inverse_depths: Singles  # (26, size, size), one over the distance along each view, 0 where there is nothing

    @classmethod
    def of(cls, mesh: Mesh, size: int, radius: float) -> AllRound:
        """size: of a picture, in pixels. radius: of the ball that fills it; 0.87 holds all of a normalised mesh."""
        cameras = _all_round(radius)
        return cls(cameras, np.stack([view(mesh, camera, size)[1] for camera in cameras]))

    def shows(self, points: Floats, normals: Floats) -> NDArray[np.bool_]:
        """Whether some view shows each point (N, 3) of the surface. normals: (N, 3), of either orientation."""
        return np.asarray(_shown(points, normals, pack(self.cameras), self.inverse_depths, True) != 0)

    def encloses(self, points: Floats) -> NDArray[np.bool_]:
        """Whether every view hides each point (N, 3) behind the surface, so that it lies inside the mesh."""
        size = self.inverse_depths.shape[1]
        hidden = np.ones(len(points), dtype=bool)
        for camera, inverse in zip(self.cameras, self.inverse_depths, strict=True):
            column, row, depth = camera.project(points, size)
            nearest = inverse[np.clip(row.astype(int), 0, size - 1), np.clip(column.astype(int), 0, size - 1)]
            hidden &= (nearest > 0.0) & (depth * nearest > 1.0 + _DEEP)
        return hidden


@cache
def _all_round(radius: float) -> tuple[Camera, ...]:
    field = math.degrees(2.0 * math.atan(radius / math.sqrt(_DISTANCE**2 - radius**2)))
    return tuple(
        Camera(math.degrees(math.atan2(x, z)), math.degrees(math.atan2(y, math.hypot(x, z))), _DISTANCE, field)
        for x, y, z in product((-1.0, 0.0, 1.0), repeat=3)
        if (x, y, z) != (0.0, 0.0, 0.0)
    )


def shown_by(points: Floats, normals: Floats, cameras: Sequence[Camera], inverse_depths: Singles) -> Ints:
    """(N,): which cameras show each point (N, 3) of a surface, a bit for each; at most 60 cameras.

    normals: (N, 3), of either orientation. inverse_depths: (C, size, size), see ``AllRound``.
    """
    return np.asarray(_shown(points, normals, pack(cameras), inverse_depths, False))


@njit(nogil=True, cache=True)
def _shown(points: Floats, normals: Floats, cameras: Floats, views: Singles, first: bool) -> Ints:
    """Bits of the views, of packed cameras, that show each point: nothing is nearer by more than a pixel's slant.

    first: whether the first such view is enough.
    """
    seen = np.zeros(len(points), np.int64)
    half = views.shape[1] / 2.0
    last = views.shape[1] - 1
    for n in range(len(points)):
        for c in range(len(cameras)):
            camera = cameras[c]
            right, up, towards, length, cosine = 0.0, 0.0, 0.0, 0.0, 0.0
            for axis in range(3):
                place = points[n, axis]
                right += camera[axis] * place
                up += camera[3 + axis] * place
                towards += camera[6 + axis] * place
                ray = camera[9] * camera[6 + axis] - place
                length += ray * ray
                cosine += ray * normals[n, axis]
            cosine = abs(cosine) / math.sqrt(length)
            if cosine <= _STEEPEST:
                continue
            away = camera[9] - towards
            scale = camera[10] / away * half
            column = min(max(int(half + scale * right), 0), last)
            row = min(max(int(half - scale * up), 0), last)
            if views[c, row, column] > 0.0:
                slant = math.sqrt(max(1.0 - cosine * cosine, 0.0)) / cosine
                if away - 1.0 / views[c, row, column] < (0.25 + slant) / scale:
                    seen[n] |= np.int64(1) << c
                    if first:
                        break
    return seen
