"""The part of a mesh that can be seen from outside, as points spread evenly over it.

References are triangle soups with faces inside them that nobody sees; only what some view shows is judged.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from shapewright.comparison.surfaces import sample
from shapewright.feedback.surfaces.point_grid import Cells
from shapewright.rendering.visibility import AllRound
from shapewright.shapes import Floats, Ints, Mesh, Transform

SAMPLES = 4000
"""Points of a surface, at least."""
_SIZE, _RADIUS = 160, 0.87
"""Pixels of the views that show what is visible, and the radius of what they show: of all of a normalised mesh."""
_INNER_SIZE, _INNER_RADIUS = 128, 0.88
"""The same of the views that show what lies inside."""
_ROUNDS = 3  # of drawing more points, until half of those asked for can be seen
_NEARBY = 0.05  # up to which distance is measured by cells, which are quicker than a tree
_REACH = 1.0  # spacings around a point within which its tangent plane stands for the surface


@dataclass(frozen=True, eq=False)
class VisibleSurface:
    """Points spread evenly over a mesh's surface. Units are those of the mesh."""

    points: Floats  # (N, 3)
    normals: Floats  # (N, 3), of either orientation
    faces: Ints  # (N,), the face that each point lies on
    visible: NDArray[np.bool_]  # (N,), whether some view from outside shows it
    area: float  # of the surface that can be seen

    @classmethod
    def of(cls, mesh: Mesh, count: int = SAMPLES, seed: int = 0) -> VisibleSurface:
        """At least ``count`` points, more where much of the surface is hidden, at most three times as many.

        mesh: normalised. Raises ValueError for a mesh without area, or one that no view shows.
        """
        drawn, shown = [], []
        views = AllRound.of(mesh, _SIZE, _RADIUS)
        for number in range(_ROUNDS):
            more = sample(mesh, count, seed + number)
            drawn.append(more)
            shown.append(views.shows(more.points, more.normals))
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
    def roughly(cls, mesh: Mesh, count: int = 1000, seed: int = 0) -> VisibleSurface:
        """``count`` points of the whole surface, all taken to be visible, as they are where nothing lies inside."""
        drawn = sample(mesh, count, seed)
        return cls(drawn.points, drawn.normals, drawn.faces, np.ones(count, dtype=bool), drawn.area)

    @cached_property
    def tree(self) -> cKDTree:
        """Of all points, hidden ones too."""
        return cKDTree(self.points)

    @cached_property
    def cells(self) -> Cells:
        """All points, sorted into cells."""
        return Cells.of(self.points, self.normals)

    @cached_property
    def spacing(self) -> float:
        """Side of the square that each point stands for."""
        return math.sqrt(self.area / max(int(self.visible.sum()), 1))

    def moved(self, transform: Transform) -> VisibleSurface:
        """The same points elsewhere."""
        return replace(self, points=transform.apply(self.points), area=self.area * transform.scale**2)

    def distance(self, points: Floats) -> Floats:
        """Distance (M,) of points (M, 3) to the surface: to the tangent plane of the nearest point, near to it."""
        away = self.nearness(points, _NEARBY)
        far = np.flatnonzero(away >= _NEARBY)
        straight, nearest = self.tree.query(points[far])
        above = np.abs(((points[far] - self.points[nearest]) * self.normals[nearest]).sum(axis=1))
        aside = np.sqrt(np.maximum(straight**2 - above**2, 0.0))
        away[far] = np.hypot(above, np.maximum(aside - _REACH * self.spacing, 0.0))
        return away

    def nearness(self, points: Floats, most: float) -> Floats:
        """The same, ``most`` where it is more: at a tenth of the time."""
        return self.cells.distance(points, _REACH * self.spacing, most)


def filled(mesh: Mesh, points: Floats, seed: int = 0) -> Floats:
    """The points (N, 3) on a mesh's surface, and as many between pairs of them as lie inside it.

    They tell a post from a ring, in triangle soups too.
    """
    if len(points) < 2:
        return points
    rng = np.random.default_rng(seed)
    first, second = rng.integers(len(points), size=(2, len(points)))
    part = rng.random((len(points), 1))
    between = points[first] * part + points[second] * (1.0 - part)
    return np.concatenate([points, between[AllRound.of(mesh, _INNER_SIZE, _INNER_RADIUS).encloses(between)]])
