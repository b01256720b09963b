"""Points as small discs that lie in the surface: the surface splats of Zwicker et al. 2001, without their blending."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from scipy.spatial import cKDTree

from shapewright.rendering.cameras import Camera, pack
from shapewright.shapes import Floats, Mesh, Points

LIGHT = (0.35, 0.5, 0.79)  # as for triangles
AMBIENT = 0.25
_NEIGHBOUR = 6
"""The radius of a disc is the distance of this neighbour: on a square grid of points the sixth is the first that is
further than one step, at 1.41 steps, so that four discs cover the gap between them."""
_WIDEST = 3.0  # times the median radius: a point far from all others is no large disc
_GRAZING = 0.1  # cosine: of a disc that is seen more from its edge only the sample of its centre is drawn
_NEAR = 0.05  # as for triangles


def radii(points: Points) -> Floats:
    """(N,): of the disc of each point, by how far its neighbours are; points that are few or all alone have 0."""
    count = min(_NEIGHBOUR, len(points) - 1)
    if not count:
        return np.zeros(1)
    distances = cKDTree(points.positions).query(points.positions, k=[count + 1])[0][:, 0]
    return np.asarray(np.minimum(distances, _WIDEST * np.median(distances)))


def view(points: Points, camera: Camera, size: int, radius: Floats | None = None) -> tuple[Any, Any]:
    """One view of normalised points: shading and inverse depth, (size, size) float32 each, as ``raster.view``.

    A point without a normal is a disc turned to the camera, of a middle shade. radius: of ``radii``.
    """
    shade, inverse = np.zeros((2, size, size), dtype=np.float32)
    normals = np.zeros_like(points.positions) if points.normals is None else points.normals
    _draw(points.positions, normals, radii(points) if radius is None else radius, pack([camera])[0], shade, inverse)
    return shade, inverse


def discs(points: Points) -> Mesh:
    """A square for each point, two triangles, in the surface and as wide as its disc; a level one without a normal."""
    normals = np.zeros_like(points.positions) if points.normals is None else points.normals
    normals = np.where((normals == 0.0).all(axis=1)[:, None], [0.0, 1.0, 0.0], normals)
    axis = np.eye(3)[np.abs(normals).argmin(axis=1)]
    across = np.cross(normals, axis)
    across *= (radii(points) / np.linalg.norm(across, axis=1))[:, None]
    along = np.cross(normals, across)
    corners = points.positions[:, None] + np.stack([-across, -along, across, along], axis=1)
    squares = 4 * np.arange(len(points))[:, None, None] + np.array([[0, 1, 2], [0, 2, 3]])
    return Mesh(corners.reshape(-1, 3), squares.reshape(-1, 3))


@njit(nogil=True, cache=True)
def _draw(positions: Any, normals: Any, radius: Any, camera: Any, shade: Any, inverse: Any) -> None:
    side = len(shade)
    half = side / 2.0
    for p in range(len(positions)):
        x, y, z = positions[p, 0], positions[p, 1], positions[p, 2]
        right = camera[0] * x + camera[1] * y + camera[2] * z
        up = camera[3] * x + camera[4] * y + camera[5] * z
        away = camera[9] - (camera[6] * x + camera[7] * y + camera[8] * z)
        if away < _NEAR:
            continue
        # The normal with the camera's axes; its last number is towards the camera, and made positive.
        nx, ny, nz = normals[p, 0], normals[p, 1], normals[p, 2]
        a = camera[0] * nx + camera[1] * ny + camera[2] * nz
        b = camera[3] * nx + camera[4] * ny + camera[5] * nz
        c = camera[6] * nx + camera[7] * ny + camera[8] * nz
        light = (AMBIENT + 1.0) / 2.0
        if a * a + b * b + c * c > 0.0:
            light = AMBIENT + (1.0 - AMBIENT) * min(abs(a * LIGHT[0] + b * LIGHT[1] + c * LIGHT[2]), 1.0)
        else:
            c = 1.0
        towards = -a * right - b * up + c * away  # cosine of the angle to the camera, times the distance
        if towards < 0.0:
            a, b, c, towards = -a, -b, -c, -towards
        edge_on = towards < _GRAZING * np.sqrt(right * right + up * up + away * away)
        scale = half * camera[10]
        column, row = half + scale * right / away, half - scale * up / away
        reach = scale * radius[p] / away
        # At least the one sample that the point falls on.
        left, last = max(0, int(np.floor(column - reach))), min(side - 1, int(np.floor(column + reach)))
        top, bottom = max(0, int(np.floor(row - reach))), min(side - 1, int(np.floor(row + reach)))
        for i in range(top, bottom + 1):
            v = (half - i - 0.5) / scale
            for j in range(left, last + 1):
                u = (j + 0.5 - half) / scale
                facing = c - a * u - b * v
                depth = towards / facing if facing > 0.0 and not edge_on else away  # where the sample's ray meets it
                dx, dy, dz = u * depth - right, v * depth - up, depth - away
                if edge_on or facing <= 0.0 or dx * dx + dy * dy + dz * dz > radius[p] * radius[p]:
                    if i != int(np.floor(row)) or j != int(np.floor(column)):
                        continue
                    depth = away
                if 1.0 / depth > inverse[i, j]:
                    inverse[i, j] = 1.0 / depth
                    shade[i, j] = light
