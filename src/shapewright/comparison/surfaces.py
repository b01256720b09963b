"""Distance between the surfaces of two shapes."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from shapewright.shapes import Floats, Mesh


def sample_surface(mesh: Mesh, count: int, seed: int = 0) -> Floats:
    """Points on the surface, (count, 3), uniform by area."""
    rng = np.random.default_rng(seed)
    corners = mesh.triangles
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    if not areas.sum() > 0.0:
        raise ValueError("the surface has no area")
    faces = corners[rng.choice(len(corners), count, p=areas / areas.sum())]
    u, v = rng.random((2, count, 1))
    over = u + v > 1.0
    u, v = np.where(over, 1.0 - u, u), np.where(over, 1.0 - v, v)
    return np.asarray(faces[:, 0] + u * (faces[:, 1] - faces[:, 0]) + v * (faces[:, 2] - faces[:, 0]))


def chamfer(first: Mesh, second: Mesh, points: int = 2000, seed: int = 0) -> float:
    """Chamfer distance of the normalised meshes, in units of the largest extent: the mean of both directed means.

    Each surface is sampled at ``points`` points, so two equal shapes are not quite at 0 (about 0.01 at 2,000 points)
    unless the sampling falls alike.
    """
    a, b = (sample_surface(mesh.normalised(), points, seed) for mesh in (first, second))
    there, _ = cKDTree(b).query(a)
    back, _ = cKDTree(a).query(b)
    return float((there.mean() + back.mean()) / 2.0)
