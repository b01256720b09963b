"""Training data: sampled parameters, the shapes they build, and their pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Build, commonest_place, describe_failures
from shapewright.parameters import Parameters, ParameterSpace
from shapewright.procedures import ProcedureError
from shapewright.rendering.cameras import THREE_VIEWS, Camera
from shapewright.rendering.raster import render
from shapewright.shapes import Drawing, Mesh, ReferenceShape, Shape


@dataclass(frozen=True, eq=False)
class Dataset:
    """Shapes, their pictures, and the parameters that built them."""

    parameters: list[Parameters]  # N vectors in the procedure's units
    targets: NDArray[np.float32]  # (N, P) float32, encoded
    active: NDArray[np.bool_]  # (N, P) bool, whether the parameter matters there
    images: NDArray[np.uint8]  # (N, C, 2, S, S) uint8
    shapes: list[ReferenceShape]  # N, normalised, all meshes or scans of them, or all drawings
    cameras: tuple[Camera, ...]  # C, that took the images
    extents: NDArray[np.float32] | None = None  # (N,), longest sides in the procedure's unit; None: proportions alone

    def __len__(self) -> int:
        return len(self.parameters)

    @property
    def kind(self) -> type[Mesh] | type[Drawing]:
        """What was built."""
        return Drawing if isinstance(self.shapes[0], Drawing) else Mesh

    @property
    def size(self) -> int:
        """Pixels along a side of an image."""
        return int(self.images.shape[-1])

    def take(self, indices: NDArray[np.int64]) -> Dataset:
        return replace(
            self,
            parameters=[self.parameters[i] for i in indices],
            targets=self.targets[indices],
            active=self.active[indices],
            images=self.images[indices],
            shapes=[self.shapes[i] for i in indices],
            extents=None if self.extents is None else self.extents[indices],
        )

    def seen_by(self, cameras: Sequence[Camera], threads: int | None = None) -> Dataset:
        """The same shapes in pictures that other cameras take; itself when the cameras are the same."""
        if tuple(cameras) == self.cameras:
            return self
        images = render(self.shapes, cameras, self.size, threads=threads)
        return replace(self, images=images, cameras=tuple(cameras))


def shapes_of(builds: Sequence[Build], kind: type[Shape]) -> tuple[list[Build], list[Shape]]:
    """The builds with a shape of this kind, and these shapes normalised. Raises ProcedureError for fewer than 10."""
    good = [build for build in builds if isinstance(build.shape, kind)]
    if len(good) < min(10, len(builds)):
        built, wanted = ("drawings", "meshes") if kind is Mesh else ("meshes", "drawings")
        other = any(build.shape is not None and not isinstance(build.shape, kind) for build in builds)
        why = f"it builds {built}, and these references need {wanted}" if other else describe_failures(builds)
        message = f"only {len(good)} of {len(builds)} sampled shapes can be used: {why}"
        raise ProcedureError(message, None if other else commonest_place(builds), summary=True)
    return good, [build.shape.normalised() for build in good if build.shape is not None]


def make_dataset(
    space: ParameterSpace,
    parameters: Sequence[Parameters],
    shapes: Sequence[ReferenceShape],
    cameras: Sequence[Camera] = THREE_VIEWS,
    size: int = 64,
    threads: int | None = None,
    extents: Sequence[float] | None = None,
) -> Dataset:
    """Render normalised shapes from every camera and encode their parameters."""
    images = render(shapes, cameras, size, threads=threads)
    sides = None if extents is None else np.array(extents, dtype=np.float32)
    return Dataset(list(parameters), *encoded(space, parameters), images, list(shapes), tuple(cameras), sides)


def encoded(space: ParameterSpace, parameters: Sequence[Parameters]) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """(N, P) each: the targets of vectors, and whether each parameter matters there."""
    mattering = [set(space.active(values)) for values in parameters]
    active = np.array([[name in names for name in space.names] for names in mattering])
    return np.array([space.encode(values) for values in parameters], dtype=np.float32), active


def join(parts: Sequence[Dataset]) -> Dataset:
    """The rows of several datasets that the same cameras took."""
    return replace(
        parts[0],
        parameters=[values for part in parts for values in part.parameters],
        targets=np.concatenate([part.targets for part in parts]),
        active=np.concatenate([part.active for part in parts]),
        images=np.concatenate([part.images for part in parts]),
        shapes=[shape for part in parts for shape in part.shapes],
        extents=None if any(p.extents is None for p in parts) else np.concatenate([p.extents for p in parts]),
    )


def split(count: int, seed: int, shares: tuple[float, float] = (0.8, 0.1)) -> tuple[NDArray[np.int64], ...]:
    """Indices of the training, validation and test rows, disjoint, at random (paper section 4.2: .8, .1, .1).

    Rows differ from each other (ParameterSpace.sample draws without replacement), so nothing leaks between the parts.
    """
    order = np.random.default_rng(seed).permutation(count)
    first, second = (round(count * sum(shares[:i])) for i in (1, 2))
    return order[:first], order[first:second], order[second:]
