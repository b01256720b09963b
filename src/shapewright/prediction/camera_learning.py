"""Cameras that are learned with the network: the gradient of the loss by their positions, and the steps they take.

A z-buffer's picture has no derivative, but it changes as the camera moves, and the network says which changes of which
pixels lower the loss. The gradient by a position is the sum over pixels of the one times the other (the chain rule),
the change of the picture taken as a central difference of two renders.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import torch
from numpy.typing import NDArray

from shapewright.rendering.cameras import Camera, placed, positions, within_reach
from shapewright.rendering.raster import render
from shapewright.shapes import Floats, Shape

STEP = 0.02  # from the middle to either render, radians and units of distance: a small picture changes by whole samples


def camera_gradient(
    shapes: Sequence[Shape],
    cameras: Sequence[Camera],
    by_pixel: NDArray[np.float32],
    step: float = STEP,
    supersample: int = 2,
    threads: int | None = 1,
) -> Floats:
    """Gradient of a loss by azimuth (radians), elevation (radians) and distance of every camera: (C, 3).

    by_pixel: (N, C, 2, S, S), the gradient of the loss by the images, which hold values in [0, 1].
    """
    count, size = len(cameras), by_pixel.shape[-1]
    offsets = step * np.concatenate([np.eye(3), -np.eye(3)])
    moved = [camera for offset in offsets for camera in placed(cameras, positions(cameras) + offset)]
    images = render(shapes, moved, size, supersample, threads)
    ahead, behind = np.split(images.reshape(len(shapes), 6, count, 2, size, size).astype(np.float32), 2, axis=1)
    slopes = (ahead - behind) / np.float32(2.0 * step * 255.0)
    gradient: Floats = np.einsum("nacxyz,ncxyz->ca", slopes, by_pixel, optimize=True).astype(np.float64)
    return gradient


class LearnedCameras:
    """Cameras that take Adam's steps down the gradient of the loss."""

    def __init__(self, cameras: Sequence[Camera], rate: float, steps: int, constant: bool = False) -> None:
        """rate: of Adam, in radians and units of distance. It rises and falls over ``steps``, unless constant."""
        self.cameras = tuple(cameras)
        self._positions = torch.from_numpy(positions(cameras))
        self._optimiser = torch.optim.Adam([self._positions], lr=rate)
        self._rates = torch.optim.lr_scheduler.LambdaLR(
            self._optimiser,
            lambda step: 1.0 if constant else math.sin(math.pi * min((step + 0.5) / max(steps, 1), 1.0)) ** 2,
        )

    def step(self, gradient: Floats) -> None:
        """gradient: (C, 3), of ``camera_gradient``."""
        self._positions.grad = torch.from_numpy(gradient)
        self._optimiser.step()
        self._rates.step()
        self._positions.copy_(torch.from_numpy(within_reach(self._positions.numpy())))
        self.cameras = placed(self.cameras, self._positions.numpy())
