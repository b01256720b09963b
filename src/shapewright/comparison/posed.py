"""How a replica differs from a mesh in pictures from all round, in place and not mirrored: smooth, to search with.

A light field hardly sees whether a shape is mirrored or stands on its head. It keeps a part in the cost because its
moments change evenly while thin parts still lie beside each other, where pictures do not yet overlap.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from shapewright.comparison.light_field.aligned import AlignedCost
from shapewright.rendering.cameras import Camera
from shapewright.rendering.raster import DEPTH_RADIUS, Singles, view
from shapewright.shapes import Floats, Mesh, Shape

_DISTANCE = 4.0
"""Of the cameras to the origin, in units of the largest extent: far enough for little perspective."""
_FIELD = math.degrees(2.0 * math.asin(DEPTH_RADIUS / _DISTANCE))
"""In which all of a normalised mesh fits."""
_CORNER = math.degrees(math.atan(math.sqrt(0.5)))
"""Elevation of a cube's corner, seen from its centre."""
_SIZE, _SAMPLES = 16, 6
"""Pixels along the side of a picture, and samples along the side of a pixel. docs/benchmarks.md has other sizes."""
_ROLL = math.degrees(math.atan(1.0 / _SAMPLES))
"""Of the cameras: most edges of furniture, houses and boxes are level or upright. Turned by so much, the samples of a
pixel meet such an edge at _SAMPLES squared places in place of _SAMPLES, and coverage changes evenly with it."""
VIEWS = tuple(
    Camera(azimuth, elevation, _DISTANCE, _FIELD, _ROLL)
    for azimuth, elevation in (
        *((0.0, 0.0), (90.0, 0.0), (180.0, 0.0), (270.0, 0.0), (0.0, 90.0), (0.0, -90.0)),
        *((45.0, _CORNER), (225.0, _CORNER), (135.0, -_CORNER), (315.0, -_CORNER)),
    )
)
"""From in front of the faces of a cube, and of four of its corners no two of which share an edge: these see each face
slantwise from two sides, and a mirrored shape looks different to them."""
_PICTURES, _LIGHT = 6000.0, 0.5
"""What pictures count, where a replica covers nothing of what the reference covers; and the light field beside them, of
the raw distance. docs/benchmarks.md has other shares."""
_LEAST_COVERED = 0.02
"""Share of the pictures that a reference is taken to cover at least: by what it covers its differences are divided."""


class PosedDifference:
    """How a replica differs from one reference in the pose that both have. field: see ``AlignedCost``."""

    def __init__(self, reference: Mesh, field: int = 0) -> None:
        self._light = AlignedCost(reference, field)
        self._pictures = _pictures(reference.normalised())
        covered = max(float(self._pictures[:, 0].mean()), _LEAST_COVERED)
        self._weight = _PICTURES / (covered * self._pictures[:, 0].size)

    def __call__(self, replica: Shape) -> float:
        """The sum of absolute residuals, infinite where the two cannot be compared."""
        residual = self.residual(replica)
        return np.inf if residual is None else float(np.abs(residual).sum())

    def residual(self, replica: Shape) -> Floats | None:
        """(5590,): what a search makes small, the sum of absolute values.

        They vary smoothly with the replica's parameters: 470 of the light field, then coverage and depth of each pixel.
        None for a drawing, and for a replica that no view shows.
        """
        if not isinstance(replica, Mesh):
            return None
        normal = replica.normalised()
        light = self._light.light(normal)
        if light is None:
            return None
        return np.concatenate([_LIGHT * light, ((_pictures(normal) - self._pictures) * self._weight).ravel()])


def _pictures(normal: Mesh) -> Floats:
    """(views, 2, _SIZE, _SIZE): how much of each pixel a normalised mesh covers, and how far in front of the middle.

    Depth is 1 before the middle to -1 behind it, in units of DEPTH_RADIUS, times the coverage.
    """
    pictures = np.empty((len(VIEWS), 2, _SIZE, _SIZE))
    for picture, camera in zip(pictures, VIEWS, strict=True):
        _pooled(view(normal, camera, _SIZE * _SAMPLES)[1], camera.distance, picture)
    return pictures


@njit(nogil=True, cache=True)
def _pooled(inverse_depth: Singles, distance: float, picture: Floats) -> None:
    """Means of the samples of each pixel: coverage, and depth before the middle."""
    size = picture.shape[1]
    samples = len(inverse_depth) // size
    picture[:] = 0.0
    for row in range(len(inverse_depth)):
        for column in range(len(inverse_depth)):
            if inverse_depth[row, column] > 0.0:
                before = (distance - 1.0 / inverse_depth[row, column]) / DEPTH_RADIUS
                picture[0, row // samples, column // samples] += 1.0
                picture[1, row // samples, column // samples] += min(max(before, -1.0), 1.0)
    picture /= samples * samples
