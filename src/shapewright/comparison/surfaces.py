"""Points on surfaces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapewright.shapes import Floats, Ints, Mesh


@dataclass(frozen=True, eq=False)
class Samples:
    """Points on a surface.

    points: (N, 3).
    faces: (N,), the index of the face that each lies on.
    normals: (N, 3), the unit normals of these faces.
    area: of the whole surface.
    """

    points: Floats
    faces: Ints
    normals: Floats
    area: float


def sample(mesh: Mesh, count: int, seed: int = 0) -> Samples:
    """Points uniform by area. Raises ValueError for a surface without area."""
    rng = np.random.default_rng(seed)
    corners = mesh.triangles
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(across, axis=1)
    total = float(lengths.sum())
    if not total > 0.0:
        raise ValueError("the surface has no area")
    faces = rng.choice(len(corners), count, p=lengths / lengths.sum())
    corners = corners[faces]
    u, v = rng.random((2, count, 1))
    over = u + v > 1.0
    u, v = np.where(over, 1.0 - u, u), np.where(over, 1.0 - v, v)
    points = corners[:, 0] + u * (corners[:, 1] - corners[:, 0]) + v * (corners[:, 2] - corners[:, 0])
    return Samples(points, faces, across[faces] / lengths[faces, None], total / 2.0)


def area(mesh: Mesh) -> float:
    """Of the whole surface, in square units of the mesh."""
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2.0
