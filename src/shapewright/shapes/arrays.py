"""Arrays of shapes, and the change of place and size that normalises one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bytes = NDArray[np.uint8]


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
