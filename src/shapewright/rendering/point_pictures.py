"""Points in small pictures: each is a disc as wide as its neighbours are apart, shaded by how depth changes around it.

The pictures look like those of the surface that the points lie on, see ``raster``. No normals are asked for: many scans
have none, and those of others point either way.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numba import njit

from shapewright.rendering.cameras import Camera, pack
from shapewright.shapes import Bytes, Floats, Points

_CELLS = 24  # along the largest extent, of the grid in which points are counted
_FLAT = 12.0
"""Cells of 3 x 3 x 3 that a surface passes through. Planes at random angles pass through 9 to 13 of them."""
_WIDE = 0.8  # radius of a disc, in spacings: discs of points at random then cover 87 % of a surface
_LEAST, _MOST = 0.004, 0.04  # radius, in units of the largest extent
_AMBIENT, _LIGHT, _RADIUS = 0.25, (0.35, 0.5, 0.79), 0.87  # as in ``raster``, whose kernels are its own
_NEAR = 0.05  # points nearer to the camera than this are not drawn
_AROUND = 2  # samples on each side of a pixel, in whose window a plane is laid through the depths
_STEP = 0.05  # depths that differ by more belong to another surface, in units of the largest extent


def radii(positions: Floats) -> Floats:
    """(N,): of the discs that stand for points (N, 3), by how dense these are around each; in their own units."""
    low, size = positions.min(axis=0), max(float(np.ptp(positions, axis=0).max()), 1e-12)
    found = np.empty(len(positions))
    _measure_density((positions - low) / size, found)
    return found * size


def pictures(points: Points, cameras: Sequence[Camera], size: int, supersample: int) -> Bytes:
    """(C, 2, size, size): shading and depth of normalised points, as ``raster.render`` draws those of meshes."""
    images = np.zeros((len(cameras), 2, size, size), dtype=np.uint8)
    _draw(points.positions, radii(points.positions), pack(cameras), supersample, images)
    return images


def view(points: Points, camera: Camera, size: int) -> Any:
    """(size, size) float32: one over the distance along the view of normalised points; 0 where there is none."""
    inverse = np.zeros((size, size), dtype=np.float32)
    _discs(points.positions, radii(points.positions), pack([camera])[0], inverse)
    return inverse


@njit(nogil=True, cache=True)
def _measure_density(places: Any, found: Any) -> None:
    """Radii of points in a cube of side 1, from the points in the 27 cells around each."""
    side = _CELLS + 2
    counts = np.zeros((side, side, side), dtype=np.int64)
    cells = np.empty((len(places), 3), dtype=np.int64)
    for n in range(len(places)):
        for d in range(3):
            cells[n, d] = 1 + min(int(places[n, d] * _CELLS), _CELLS - 1)
        counts[cells[n, 0], cells[n, 1], cells[n, 2]] += 1
    for n in range(len(places)):
        i, j, k = cells[n]
        around = counts[i - 1 : i + 2, j - 1 : j + 2, k - 1 : k + 2].sum()
        spacing = math.sqrt(_FLAT / around) / _CELLS
        found[n] = min(max(_WIDE * spacing, _LEAST), _MOST)


@njit(nogil=True, cache=True)
def _draw(positions: Any, wide: Any, cameras: Any, supersample: int, images: Any) -> None:
    side = images.shape[2] * supersample
    inverse = np.empty((side, side), dtype=np.float32)
    for c in range(len(cameras)):
        inverse[:] = 0.0
        _discs(positions, wide, cameras[c], inverse)
        _resolve(inverse, cameras[c], supersample, images[c])


@njit(nogil=True, cache=True)
def _discs(positions: Any, wide: Any, camera: Any, inverse: Any) -> None:
    """Discs that face the camera; what is nearer hides what is behind."""
    side = len(inverse)
    half = side / 2.0
    for n in range(len(positions)):
        x, y, z = positions[n, 0], positions[n, 1], positions[n, 2]
        away = camera[9] - (camera[6] * x + camera[7] * y + camera[8] * z)
        if away < _NEAR:
            continue
        scale = half * camera[10] / away
        column = half + scale * (camera[0] * x + camera[1] * y + camera[2] * z)
        row = half - scale * (camera[3] * x + camera[4] * y + camera[5] * z)
        reach = max(scale * wide[n], 0.5)
        nearness = np.float32(1.0 / away)
        for i in range(max(0, math.ceil(row - reach - 0.5)), min(side, math.floor(row + reach - 0.5) + 1)):
            for j in range(max(0, math.ceil(column - reach - 0.5)), min(side, math.floor(column + reach - 0.5) + 1)):
                inside = (i + 0.5 - row) ** 2 + (j + 0.5 - column) ** 2 <= reach * reach
                if inside and nearness > inverse[i, j]:
                    inverse[i, j] = nearness


@njit(nogil=True, cache=True)
def _resolve(inverse: Any, camera: Any, supersample: int, image: Any) -> None:
    """Mean of the samples of each pixel, as bytes."""
    samples = supersample * supersample
    for row in range(image.shape[1]):
        for column in range(image.shape[2]):
            depth, covered, nearest = 0.0, 0, 0.0
            for i in range(row * supersample, (row + 1) * supersample):
                for j in range(column * supersample, (column + 1) * supersample):
                    if inverse[i, j] > 0.0:
                        behind = (1.0 / inverse[i, j] - camera[9]) / _RADIUS
                        depth += min(max(0.5 - 0.5 * behind, 0.0), 1.0) * (254.0 / 255.0) + 1.0 / 255.0
                        covered += 1
                        nearest = max(nearest, inverse[i, j])
            light = covered * _shade(inverse, row, column, supersample, nearest, camera) if covered else 0.0
            image[0, row, column] = np.uint8(light / samples * 255.0 + 0.5)
            image[1, row, column] = np.uint8(depth / samples * 255.0 + 0.5)


@njit(nogil=True, cache=True)
def _shade(inverse: Any, row: int, column: int, supersample: int, nearest: float, camera: Any) -> float:
    """By the plane through the depths around a pixel (least squares) that are near to its nearest one."""
    side, middle = len(inverse), 1.0 / nearest
    first, last = row * supersample - _AROUND, (row + 1) * supersample + _AROUND
    left, right = column * supersample - _AROUND, (column + 1) * supersample + _AROUND
    count = sx = sy = sxx = sxy = syy = sz = sxz = syz = 0.0
    for i in range(max(0, first), min(side, last)):
        for j in range(max(0, left), min(side, right)):
            if inverse[i, j] > 0.0:
                z = 1.0 / inverse[i, j] - middle
                if abs(z) <= _STEP:
                    x, y = float(j - left), float(last - i)
                    count += 1.0
                    sx, sy, sz = sx + x, sy + y, sz + z
                    sxx, sxy, syy = sxx + x * x, sxy + x * y, syy + y * y
                    sxz, syz = sxz + x * z, syz + y * z
    vxx, vxy, vyy = sxx - sx * sx / count, sxy - sx * sy / count, syy - sy * sy / count
    vxz, vyz = sxz - sx * sz / count, syz - sy * sz / count
    spread = vxx * vyy - vxy * vxy
    if spread < 1e-6:
        return _AMBIENT + (1.0 - _AMBIENT) * _LIGHT[2]
    step = 2.0 * middle / (side * camera[10])  # of a sample, at this depth
    nx, ny = (vxz * vyy - vyz * vxy) / spread / step, (vyz * vxx - vxz * vxy) / spread / step
    cosine = abs(nx * _LIGHT[0] + ny * _LIGHT[1] + _LIGHT[2]) / math.sqrt(nx * nx + ny * ny + 1.0)
    return float(_AMBIENT + (1.0 - _AMBIENT) * min(cosine, 1.0))
