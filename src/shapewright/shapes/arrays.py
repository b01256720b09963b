"""Arrays of shapes, and the change of place and size that normalises one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bytes = NDArray[np.uint8]
_BESIDE = 64
"""Rows that are taken as one: numpy goes ten times as fast along rows of 192 numbers as along rows of 3."""


def ends(points: Floats) -> Floats:
    """(2, D): the least and the greatest number of each column of points (N, D), N at least 1."""
    width, even = points.shape[1], len(points) // _BESIDE * _BESIDE
    wide = points[:even].reshape(-1, _BESIDE * width)

    def most(pick: np.ufunc) -> Floats:
        parts = [pick.reduce(wide, axis=0).reshape(-1, width)] if even else []
        return np.asarray(pick.reduce(np.concatenate([*parts, points[even:]]), axis=0))

    return np.stack([most(np.minimum), most(np.maximum)])


@dataclass(frozen=True)
class Transform:
    """A uniform scale about a centre: ``normalised = (original - centre) * scale``.

    Attributes:
        centre: (3,), of a drawing (2,).
        scale: a positive factor.
    """

    centre: tuple[float, ...]
    scale: float

    def apply(self, points: ArrayLike) -> Floats:
        return np.asarray((np.asarray(points, dtype=np.float64) - self.centre) * self.scale)

    def invert(self, points: ArrayLike) -> Floats:
        return np.asarray(np.asarray(points, dtype=np.float64) / self.scale + self.centre)
