"""Augmentation: training shapes made less clean, as real references are, while their parameters stay the same.

Leaving parts out and adding foreign ones was measured as well, and found fewer references (docs/benchmarks.md).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from shapewright.prediction.dataset import Dataset
from shapewright.prediction.views.silhouettes import redrawn
from shapewright.rendering.cameras import ANYWHERE
from shapewright.rendering.raster import render
from shapewright.shapes import Mesh

TURN, TILT = 4.0, 1.5  # standard deviation, in degrees, of turns about the up axis, and about the others
STRETCH = 0.04  # of the logarithm of each axis's scale
JITTER = 0.006  # of each coordinate of a vertex, as a share of the largest extent
SHARE = 0.5  # How likely each change is. All five by hand; docs/benchmarks.md, Augmentation, measures them together.


def augmented(data: Dataset, seed: int, threads: int | None = None) -> Dataset:
    """The same parameters with shapes turned, stretched and jittered, each or not; drawings stay as they are."""
    if data.kind is not Mesh:
        return data
    rng = np.random.default_rng([seed, len(data)])
    shapes = [worn(shape, rng) if isinstance(shape, Mesh) else shape for shape in data.shapes]
    if data.cameras == (ANYWHERE,):
        return redrawn(replace(data, shapes=shapes), rng, threads)
    return replace(data, shapes=shapes, images=render(shapes, data.cameras, data.size, threads=threads))


def worn(mesh: Mesh, rng: np.random.Generator) -> Mesh:
    """A mesh after some of the changes, normalised."""
    for change in (_turn, _stretch, _jitter):
        if rng.random() < SHARE:
            mesh = change(mesh, rng)
    return mesh.normalised()


def _turn(mesh: Mesh, rng: np.random.Generator) -> Mesh:
    x, y, z = np.radians(rng.normal(size=3) * (TILT, TURN, TILT))
    rotation, triangle = np.linalg.qr(np.array([[1.0, -z, y], [z, 1.0, -x], [-y, x, 1.0]]))
    return mesh.transformed(rotation * np.sign(np.diag(triangle)))


def _stretch(mesh: Mesh, rng: np.random.Generator) -> Mesh:
    return replace(mesh, vertices=mesh.vertices * np.exp(rng.normal(scale=STRETCH, size=3)))


def _jitter(mesh: Mesh, rng: np.random.Generator) -> Mesh:
    moved = rng.normal(scale=JITTER * float(mesh.extent.max()), size=mesh.vertices.shape)
    return replace(mesh, vertices=mesh.vertices + moved)
