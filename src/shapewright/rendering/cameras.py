"""Cameras: where the views of a shape are taken from, and how that place is written as numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Camera:
    """A perspective camera that looks at the origin, up along +Y where it has no roll."""

    azimuth: float  # degrees about the up axis, 0 in front (+Z), 90 to the right (+X)
    elevation: float  # degrees above the horizon
    distance: float = 2.6  # to the origin, in units of the shape's largest extent
    field_of_view: float = 36.0  # degrees, of the whole image
    roll: float = 0.0  # degrees about the line of sight; positive turns the picture clockwise

    def frame(self) -> NDArray[np.float64]:
        """(3, 3): rows are the camera's right, up and backward (towards the camera) axes."""
        azimuth, elevation = math.radians(self.azimuth), math.radians(self.elevation)
        level = math.cos(elevation)
        backward = np.array([math.sin(azimuth) * level, math.sin(elevation), math.cos(azimuth) * level])
        right = np.array([math.cos(azimuth), 0.0, -math.sin(azimuth)])
        up, roll = np.cross(backward, right), math.radians(self.roll)
        turned = math.cos(roll) * right + math.sin(roll) * up, math.cos(roll) * up - math.sin(roll) * right
        return np.stack([*turned, backward])

    @property
    def focal_length(self) -> float:
        """In units of half an image: what is as wide as it is far away covers this many halves of the image."""
        return 1.0 / math.tan(math.radians(self.field_of_view) / 2.0)

    def project(self, points: NDArray[np.float64], size: int) -> tuple[NDArray[np.float64], ...]:
        """Column, row and depth, (N,) each, of points (N, 3) in a picture of size x size pixels.

        Columns and rows count pixels from the upper left corner, fractions included: the first pixel reaches from 0 to
        1. Outside the picture they are below 0 or above ``size``. Depth is the distance along the view, in units of the
        shape's largest extent; it is negative behind the camera.
        """
        right, up, towards = self.frame() @ points.T
        depth = self.distance - towards
        scale = self.focal_length / depth * size / 2.0
        return size / 2.0 + scale * right, size / 2.0 - scale * up, depth


THREE_VIEWS = (Camera(35.0, 25.0), Camera(0.0, 5.0), Camera(90.0, 15.0))
"""Three-quarter, front and side, each from a little above."""
PAGE = Camera(0.0, 0.0)  # the camera of drawings: there is one picture of them, and it is never moved
ANYWHERE = Camera(
    0.0, 20.0
)  # stands for the cameras of pictures of which nobody knows where these were, see ``anywhere``
THUMBNAIL = Camera(35.0, 25.0, distance=3.6, field_of_view=27.5)
"""The three-quarter view, in which a ball of radius 0.856 about the origin fills the picture."""

_FURTHER = ((215.0, 25.0), (125.0, -20.0), (300.0, 55.0))  # behind, below, above
_GOLDEN_ANGLE = 180.0 * (3.0 - math.sqrt(5.0))  # degrees; steps of it come back to no place they were at
_ELEVATION, _DISTANCE = math.radians(85.0), (1.8, 6.0)
"""Limits of learned cameras, in radians and units of the largest extent: short of the poles, where the azimuth means
nothing; outside the shape, whose corners are 0.87 from the origin; near enough for it to fill part of a picture."""


def starting_views(count: int = 3, distance: float = 2.6) -> tuple[Camera, ...]:
    """Cameras in ``count`` places: three-quarter, front, side, then behind, below, above, and all round."""
    known = [(camera.azimuth, camera.elevation) for camera in THREE_VIEWS] + list(_FURTHER)
    around = [((_GOLDEN_ANGLE * i) % 360.0, 60.0 * math.sin(i)) for i in range(len(known), count)]
    return tuple(Camera(azimuth, elevation, distance) for azimuth, elevation in (known + around)[:count])


def positions(cameras: Sequence[Camera]) -> NDArray[np.float64]:
    """(C, 3): azimuth and elevation in radians, and distance. Numbers of like size, fit to be optimised."""
    return np.array([[math.radians(c.azimuth), math.radians(c.elevation), c.distance] for c in cameras])


def placed(cameras: Sequence[Camera], positions: NDArray[np.float64]) -> tuple[Camera, ...]:
    """The cameras at other positions (C, 3), the inverse of ``positions``."""
    return tuple(
        replace(camera, azimuth=math.degrees(azimuth), elevation=math.degrees(elevation), distance=float(distance))
        for camera, (azimuth, elevation, distance) in zip(cameras, positions, strict=True)
    )


def within_reach(positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """The nearest positions (C, 3) that are short of the poles, clear of the shape and not too far from it."""
    lowest, highest = (-np.inf, -_ELEVATION, _DISTANCE[0]), (np.inf, _ELEVATION, _DISTANCE[1])
    return np.clip(positions, lowest, highest)


def pack(cameras: Sequence[Camera]) -> NDArray[np.float64]:
    """(C, 11): per camera its frame (9), distance and focal length in units of half an image, for the rasteriser."""
    return _packed(tuple(cameras)).copy()


@lru_cache(maxsize=64)
def _packed(cameras: tuple[Camera, ...]) -> NDArray[np.float64]:
    return np.array([[*camera.frame().ravel(), camera.distance, camera.focal_length] for camera in cameras])
