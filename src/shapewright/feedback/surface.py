"""What of a mesh can be seen from outside: points spread evenly over its visible surface.

References are triangle soups with faces inside them that nobody sees; only what some view shows is judged.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from shapewright.comparison.surfaces import Samples, sample
from shapewright.rendering.cameras import Camera, pack
from shapewright.rendering.raster import draw_view
from shapewright.shapes import Floats, Ints, Mesh, Transform

SAMPLES = 4000
_SIZE = 160
_DISTANCE = 4.0
_STEEPEST = 0.25  # cosine between a face and the view that still shows where it lies
_ROUNDS = 3
_REACH = 1.0  # spacings around a point within which its tangent plane stands for the surface


def _all_round() -> tuple[Camera, ...]:
    """26 cameras: in front of the faces, edges and corners of a cube."""
    places = [np.array(place) for place in product((-1, 0, 1), repeat=3) if any(place)]
    return tuple(
        Camera(
            math.degrees(math.atan2(x, z)),
            math.degrees(math.atan2(y, math.hypot(x, z))),
            _DISTANCE,
            math.degrees(2.0 * math.atan(0.87 / math.sqrt(_DISTANCE**2 - 0.87**2))),
        )
        for x, y, z in places
    )


_CAMERAS = pack(_all_round())


@dataclass(frozen=True, eq=False)
class Surface:
    """Points spread evenly over a mesh's surface. Units are those of the mesh.

    points, normals: (N, 3), of either orientation. faces: (N,), the face each lies on. visible: (N,), whether some
    view from outside shows it. area: of the surface that can be seen.
    """

    points: Floats
    normals: Floats
    faces: Ints
    visible: NDArray[np.bool_]
    area: float

    @classmethod
    def of(cls, mesh: Mesh, count: int = SAMPLES, seed: int = 0) -> Surface:
        """At least ``count`` points, more where much of the surface is hidden, at most three times as many.

        mesh: normalised. Raises ValueError for a mesh without area, or one that no view shows.
        """
        drawn, shown = [], []
        views = _depths(mesh)
        for number in range(_ROUNDS):
            more = sample(mesh, count, seed + number)
            drawn.append(more)
            shown.append(_seen(more, views))
            if sum(int(seen.sum()) for seen in shown) >= count // 2:
                break
        visible = np.concatenate(shown)
        if not visible.any():
            raise ValueError("no view shows the mesh")
        return cls(
            np.concatenate([some.points for some in drawn]),
            np.concatenate([some.normals for some in drawn]),
            np.concatenate([some.faces for some in drawn]),
            visible,
            drawn[0].area * float(visible.mean()),
        )

    @classmethod
    def roughly(cls, mesh: Mesh, count: int = 1000, seed: int = 0) -> Surface:
        """``count`` points of the whole surface, all taken to be visible, as they are where nothing lies inside."""
        drawn = sample(mesh, count, seed)
        return cls(drawn.points, drawn.normals, drawn.faces, np.ones(count, dtype=bool), drawn.area)

    @cached_property
    def tree(self) -> cKDTree:
        """Of all points, hidden ones too."""
        return cKDTree(self.points)

    @property
    def spacing(self) -> float:
        """Side of the square that each point stands for."""
        return math.sqrt(self.area / max(int(self.visible.sum()), 1))

    def moved(self, transform: Transform) -> Surface:
        """The same points elsewhere."""
        return replace(self, points=transform.apply(self.points), area=self.area * transform.scale**2)

    def distance(self, points: Floats) -> Floats:
        """Distance (M,) of points (M, 3) to the surface: to the tangent plane of the nearest point, near to it."""
        straight, nearest = self.tree.query(points)
        above = np.abs(((points - self.points[nearest]) * self.normals[nearest]).sum(axis=1))
        aside = np.sqrt(np.maximum(straight**2 - above**2, 0.0))
        return np.asarray(np.hypot(above, np.maximum(aside - _REACH * self.spacing, 0.0)))


def _depths(mesh: Mesh) -> Floats:
    """One over the distance along the view, (C, size, size), 0 where there is nothing."""
    inverse = np.empty((len(_CAMERAS), _SIZE, _SIZE), dtype=np.float32)
    shade, projected = np.empty((_SIZE, _SIZE), dtype=np.float32), np.empty_like(mesh.vertices)
    for camera, view in zip(_CAMERAS, inverse, strict=True):
        draw_view(mesh.vertices, mesh.faces, camera, projected, shade, view)
    return inverse.astype(np.float64)


def _seen(samples: Samples, views: Floats) -> NDArray[np.bool_]:
    """Whether a view shows the point: nothing there is nearer to the camera by more than a pixel's slant."""
    seen = np.zeros(len(samples.points), dtype=bool)
    for camera, inverse in zip(_CAMERAS, views, strict=True):
        rows = np.flatnonzero(~seen)
        if not len(rows):
            break
        seen[rows] = _shown(samples.points[rows], samples.normals[rows], camera, inverse)
    return seen


def _shown(points: Floats, normals: Floats, camera: Floats, inverse: Floats) -> NDArray[np.bool_]:
    frame = camera[:9].reshape(3, 3)
    right, up, towards = frame @ points.T
    away = camera[9] - towards
    scale = camera[10] / away * _SIZE / 2.0
    column = np.clip((_SIZE / 2.0 + scale * right).astype(int), 0, _SIZE - 1)
    row = np.clip((_SIZE / 2.0 - scale * up).astype(int), 0, _SIZE - 1)
    towards_camera = camera[9] * frame[2] - points
    cosine = np.abs((normals * towards_camera).sum(axis=1)) / np.linalg.norm(towards_camera, axis=1)
    slant = np.sqrt(np.maximum(1.0 - cosine**2, 0.0)) / np.maximum(cosine, _STEEPEST)
    there = inverse[row, column]
    front = np.divide(1.0, there, out=np.full(len(away), np.inf), where=there > 0.0)
    return np.asarray((cosine > _STEEPEST) & (away - front < (0.25 + slant) / scale))
