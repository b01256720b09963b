"""The predictor: shapes in, parameters of the procedure out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shapewright.parameters import Parameters, ParameterSpace
from shapewright.prediction.network import CompactNetwork
from shapewright.prediction.training import Epoch, Metrics, infer, torch_threads
from shapewright.rendering.cameras import Camera
from shapewright.rendering.raster import render
from shapewright.shapes import Mesh


@dataclass(frozen=True, eq=False)
class Predictor:
    """A trained network, the space it predicts in, and the cameras it looks through.

    metrics: per parameter, on held-out samples. curve: loss by epoch. samples: how many shapes it learned from.
    """

    space: ParameterSpace
    network: CompactNetwork
    cameras: tuple[Camera, ...]
    size: int
    metrics: Metrics
    curve: list[Epoch]
    samples: int
    threads: int | None = None

    def predict(self, shapes: Sequence[Mesh]) -> list[Parameters]:
        """The parameters for each mesh, which need not be normalised."""
        return self.decode(self.infer(shapes))

    def infer(self, shapes: Sequence[Mesh]) -> list[NDArray[np.float32]]:
        """For each parameter (N,) encoded values of a scalar, or (N, classes) probabilities."""
        images = render([shape.normalised() for shape in shapes], self.cameras, self.size, threads=self.threads)
        with torch_threads(self.threads):
            return infer(self.network, self.space, images)

    def decode(self, inferred: Sequence[NDArray[np.float32]]) -> list[Parameters]:
        """Encoded scalars and the likeliest classes as parameter vectors, inactive parameters at their defaults."""
        columns = [values.argmax(axis=1) if values.ndim == 2 else values for values in inferred]
        return [self.space.canonical(self.space.decode(row)) for row in zip(*columns, strict=True)]
