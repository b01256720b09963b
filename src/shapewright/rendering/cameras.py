"""Cameras: where the views of a shape are taken from."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Camera:
    """A perspective camera that looks at the origin, up along +Y.

    azimuth: degrees about the up axis, 0 in front (+Z), 90 to the right (+X). elevation: degrees above the horizon.
    distance: to the origin, in units of the shape's largest extent. field_of_view: degrees, of the whole image.
    """

    azimuth: float
    elevation: float
    distance: float = 2.6
    field_of_view: float = 36.0

    def frame(self) -> NDArray[np.float64]:
        """(3, 3): rows are the camera's right, up and backward (towards the camera) axes."""
        azimuth, elevation = math.radians(self.azimuth), math.radians(self.elevation)
        backward = np.array(
            [
                math.sin(azimuth) * math.cos(elevation),
                math.sin(elevation),
                math.cos(azimuth) * math.cos(elevation),
            ]
        )
        right = np.array([math.cos(azimuth), 0.0, -math.sin(azimuth)])
        return np.stack([right, np.cross(backward, right), backward])


THREE_VIEWS = (Camera(35.0, 25.0), Camera(0.0, 5.0), Camera(90.0, 15.0))
THUMBNAIL = Camera(35.0, 25.0, distance=3.6, field_of_view=27.5)


def pack(cameras: Sequence[Camera]) -> NDArray[np.float64]:
    """(C, 11): per camera its frame (9), distance and focal length in units of half an image, for the rasteriser."""
    return np.array(
        [
            [*camera.frame().ravel(), camera.distance, 1.0 / math.tan(math.radians(camera.field_of_view) / 2.0)]
            for camera in cameras
        ]
    )
