"""The predictor: shapes in, parameters of the procedure out."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import astuple, dataclass
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from torch import nn

from shapewright.parameters import Parameters, ParameterSpace, Prediction, from_record, to_record
from shapewright.prediction.devices import torch_threads
from shapewright.prediction.heads import SizeInput
from shapewright.prediction.inference import Metrics, Pictures, infer
from shapewright.prediction.network import CompactNetwork, make_network
from shapewright.prediction.training import Epoch
from shapewright.prediction.views.silhouettes import joined
from shapewright.rendering.cameras import ANYWHERE, PAGE, Camera
from shapewright.rendering.framed import pictures_of
from shapewright.rendering.raster import render
from shapewright.shapes import Drawing, Mesh, ReferenceShape, Views, extent_of
from shapewright.shapes.shelf import fresh
from shapewright.storage import write_file

_WORDS = {Drawing: "drawings", Views: "pictures of objects", Mesh: "meshes"}


@dataclass(frozen=True, eq=False)
class Predictor:
    """A trained network, the space it predicts in, and the cameras it looks through.

    space: whose parameters it predicts.
    network: in evaluation mode.
    cameras: through which it looks at shapes.
    size: pixels along a side of its pictures.
    metrics: per parameter, on held-out samples.
    curve: loss by epoch; empty where it was loaded.
    samples: how many shapes it learned from.
    threads: for rendering and torch; all cores by default.
    """

    space: ParameterSpace
    network: nn.Module
    cameras: tuple[Camera, ...]
    size: int
    metrics: Metrics
    curve: list[Epoch]
    samples: int
    threads: int | None = None

    def save(self, path: Path) -> None:
        """Write what another iteration can resume: space, network, cameras; no parameter's ``when``."""
        record = {
            "network": "compact" if isinstance(self.network, CompactNetwork) else "vgg19",
            "state": {name: tensor.cpu() for name, tensor in self.network.state_dict().items()},
            "space": [to_record(parameter) for parameter in self.space],
            "cameras": [list(astuple(camera)) for camera in self.cameras],
            "size": self.size,
            "samples": self.samples,
            "metrics": self.metrics,
        }
        # torch reports a full disk as a RuntimeError of its archive; bytes of our own raise OSError.
        buffer = io.BytesIO()
        torch.save(record, buffer)
        write_file(path, buffer.getvalue())

    @classmethod
    def load(cls, path: Path) -> Predictor:
        """Read what ``save`` wrote; the curve is in the run's record. Raises OSError or RuntimeError for a bad file."""
        record = torch.load(path, map_location="cpu", weights_only=True)
        space = ParameterSpace(tuple(from_record(parameter) for parameter in record["space"]))
        cameras = tuple(Camera(*values) for values in record["cameras"])
        sized = any(name.startswith("size.") for name in record["state"])
        network = make_network(record["network"], space, len(cameras), record["size"], sized=sized)
        network.load_state_dict(record["state"])
        return cls(space, network.eval(), cameras, record["size"], record["metrics"], [], record["samples"])

    def predict(
        self, shapes: Sequence[ReferenceShape], extents: Sequence[float | None] | None = None
    ) -> list[Parameters]:
        """The parameters for each shape, which need not be normalised. extents: as for ``infer``."""
        return self.infer(shapes, extents).decode()

    def infer(self, shapes: Sequence[ReferenceShape], extents: Sequence[float | None] | None = None) -> Prediction:
        """What is likely for each shape, and how far off each scalar may be.

        extents: the longest side of each, for normalised shapes where sizes mean what they say; by default, and for
        None, that of the shape as it is.

        Raises ValueError for shapes of another kind than it has learned from.
        """
        kind = Views if self.cameras == (ANYWHERE,) else Drawing if self.cameras == (PAGE,) else Mesh
        if any(_kind(shape) is not kind for shape in shapes):
            raise ValueError(f"this predictor has learned from {_WORDS[kind]}; give it such")
        objects = [shape for shape in shapes if isinstance(shape, Views)]
        images: Pictures = Drawn(shapes, self.cameras, self.size, self.threads)
        if objects:
            images = np.stack([pictures_of(view, self.size) for some in objects for view in some.views])
        with torch_threads(self.threads):
            prediction = infer(self.network, self.space, images, self._sides(shapes, extents))
        return joined(prediction, [len(some) for some in objects]) if objects else prediction

    def _sides(
        self, shapes: Sequence[ReferenceShape], extents: Sequence[float | None] | None
    ) -> NDArray[np.float32] | None:
        if not isinstance(self.network.size, SizeInput):
            return None
        given = extents or [None] * len(shapes)
        sides = [extent or extent_of(shape) for shape, extent in zip(shapes, given, strict=True)]
        return np.array(sides, dtype=np.float32)


@dataclass(frozen=True, eq=False)
class Drawn:
    """Pictures of shapes, each drawn when it is asked for: those of many shapes together take much memory."""

    shapes: Sequence[ReferenceShape]
    cameras: tuple[Camera, ...]
    size: int
    threads: int | None

    @property
    def shape(self) -> tuple[int, ...]:
        return (len(self.shapes), len(self.cameras), 2, self.size, self.size)

    def __len__(self) -> int:
        return len(self.shapes)

    def __getitem__(self, rows: slice) -> NDArray[np.uint8]:
        some = [fresh(shape).normalised() for shape in self.shapes[rows]]
        return render(some, self.cameras, self.size, threads=self.threads)


def _kind(shape: ReferenceShape) -> type[Mesh] | type[Drawing] | type[Views]:
    """The kind of shapes to have learned from: meshes for points."""
    return type(shape) if isinstance(shape, Drawing | Views) else Mesh
