"""A mesh in small pictures from fourteen sides, without perspective: what can be seen of it, and where that lies.

The sides are the faces and corners of a cube, so a shape that is turned by quarter turns, mirrored or laid on its head
has the same pictures in another order: other poses cost no drawing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numba import njit

from shapewright.rendering.cameras import Camera
from shapewright.shapes import Floats, Ints, Mesh

SIZE = 64
"""Pixels along the side of a picture: a sixtieth of the largest extent. 96 told hardly more, see docs/benchmarks.md."""
EMPTY = -9.0  # nearness where there is nothing
_CORNER = math.degrees(math.atan(math.sqrt(0.5)))  # elevation of a cube's corner
VIEWS = (
    *(Camera(azimuth, 0.0) for azimuth in (0.0, 90.0, 180.0, 270.0)),
    *(Camera(0.0, elevation) for elevation in (90.0, -90.0)),
    *(Camera(azimuth, e) for e in (_CORNER, -_CORNER) for azimuth in (45.0, 135.0, 225.0, 315.0)),
)
"""Four sides, above, below, four corners above and four below. Only the directions count."""
BELOW = 5  # of the views
AXES = np.array([camera.frame() for camera in VIEWS])
"""(14, 3, 3): right, up and towards the viewer."""
_REACH = np.array([0.52] * 6 + [0.78] * 8)  # half a picture in units of the largest extent: holds a cube, its corners
_STEEPEST = 0.3  # cosine between a face and the view below which a pixel counts no more surface
PIXELS = 2.0 * _REACH / SIZE
"""(14,): the side of a pixel, in units of the largest extent."""


@dataclass(frozen=True, eq=False)
class Surround:
    """A normalised mesh from all VIEWS."""

    nearness: Any  # (14, SIZE, SIZE) float32: how far towards the viewer the surface lies, from the middle; or EMPTY
    area: Any  # (14, SIZE, SIZE) float32: of the surface in a pixel, in squares of the largest extent; 0 where empty

    @classmethod
    def of(cls, mesh: Mesh, views: slice = slice(None)) -> Surround:
        """The mesh has to be normalised. views: those of VIEWS that are drawn, (V,) instead of 14."""
        nearness, area = np.empty((2, len(AXES[views]), SIZE, SIZE), dtype=np.float32)
        _draw(mesh.vertices, mesh.faces, AXES[views], _REACH[views], nearness, area)
        return cls(nearness, area)

    def edges(self, jump: float) -> Any:
        """Where the surface ends or steps back by more than ``jump``: (14, SIZE) uint64, a row in the bits of each."""
        marks = np.empty(self.nearness.shape, dtype=np.bool_)
        _mark_edges(self.nearness, jump, marks)
        return np.packbits(marks, axis=2, bitorder="little").view(np.uint64)[..., 0]


POSES: tuple[tuple[int, bool, bool], ...] = tuple(product(range(4), (False, True), (False, True)))
"""Quarter turns about the up axis after it is mirrored (left for right), after it is laid on its head; the first is as
it stands."""


def pose_matrix(quarters: int, on_its_head: bool, mirrored: bool) -> Floats:
    """(3, 3): takes a shape to one of POSES."""
    turn = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    over = np.diag([-1.0, -1.0, 1.0]) if on_its_head else np.eye(3)
    return np.asarray(np.linalg.matrix_power(turn, quarters) @ np.diag([-1.0 if mirrored else 1.0, 1.0, 1.0]) @ over)


def _order(pose: tuple[int, bool, bool], axes: Floats) -> tuple[int, Ints]:
    seen = axes @ pose_matrix(*pose)  # the axes in the frame of the shape as it was
    view = int(np.argmax(AXES[:, 2] @ seen[2]))
    return view, np.rint(seen[:2] @ AXES[view, :2].T).astype(np.int64).ravel()


_SOURCES = [[_order(pose, axes) for axes in AXES] for pose in POSES]
ORDERS = (
    np.array([[view for view, _ in row] for row in _SOURCES]),
    np.array([[turn for _, turn in row] for row in _SOURCES]),
)
"""For each pose and view: the view of the shape as it was that shows it, (16, 14), and right and up in the new picture
in terms of right and up in the old one, (16, 14, 4)."""


@njit(nogil=True, cache=True)
def _draw(vertices: Any, faces: Any, axes: Any, reach: Any, nearness: Any, area: Any) -> None:
    side = nearness.shape[1]
    flat = np.empty((len(vertices), 3))
    for c in range(len(axes)):
        scale = side / 2.0 / reach[c]
        for v in range(len(vertices)):
            x, y, z = vertices[v, 0], vertices[v, 1], vertices[v, 2]
            flat[v, 0] = side / 2.0 + scale * (axes[c, 0, 0] * x + axes[c, 0, 1] * y + axes[c, 0, 2] * z)
            flat[v, 1] = side / 2.0 - scale * (axes[c, 1, 0] * x + axes[c, 1, 1] * y + axes[c, 1, 2] * z)
            flat[v, 2] = axes[c, 2, 0] * x + axes[c, 2, 1] * y + axes[c, 2, 2] * z
        nearness[c] = EMPTY
        area[c] = 0.0
        for f in range(len(faces)):
            i, j, k = np.uint64(faces[f, 0]), np.uint64(faces[f, 1]), np.uint64(faces[f, 2])  # nothing to wrap around
            left = max(0, math.ceil(min(flat[i, 0], flat[j, 0], flat[k, 0]) - 0.5))
            right = min(side - 1, math.floor(max(flat[i, 0], flat[j, 0], flat[k, 0]) - 0.5))
            top = max(0, math.ceil(min(flat[i, 1], flat[j, 1], flat[k, 1]) - 0.5))
            bottom = min(side - 1, math.floor(max(flat[i, 1], flat[j, 1], flat[k, 1]) - 0.5))
            if left <= right and top <= bottom:
                box = left, right, top, bottom
                _triangle(flat[i], flat[j], flat[k], scale, box, nearness[c], area[c])


@njit(nogil=True, cache=True)
def _triangle(a: Any, b: Any, c: Any, scale: float, box: tuple[int, int, int, int], nearness: Any, area: Any) -> None:
    left, right, top, bottom = box
    bx, by, bz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    cx, cy, cz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    double = bx * cy - by * cx
    if abs(double) < 1e-12:
        return
    surface = 0.0  # of a pixel, once one is seen
    step_b, step_c = cy / double, -by / double
    step = step_b * bz + step_c * cz
    for row in range(top, bottom + 1):
        px, py = left + 0.5 - a[0], row + 0.5 - a[1]
        weight_b, weight_c = (px * cy - py * cx) / double, (py * bx - px * by) / double
        z = a[2] + weight_b * bz + weight_c * cz
        entered = False
        for column in range(left, right + 1):
            if weight_b >= 0.0 and weight_c >= 0.0 and weight_b + weight_c <= 1.0:
                entered = True
                if z > nearness[row, column]:
                    if surface == 0.0:
                        nx, ny = (by * cz - bz * cy) * scale, (bz * cx - bx * cz) * scale
                        cosine = abs(double) / math.sqrt(nx * nx + ny * ny + double * double)
                        surface = 1.0 / (scale * scale * max(cosine, _STEEPEST))
                    nearness[row, column] = z
                    area[row, column] = surface
            elif entered:
                break
            weight_b += step_b
            weight_c += step_c
            z += step


@njit(nogil=True, cache=True)
def _mark_edges(nearness: Any, jump: float, edges: Any) -> None:
    views, side, _ = nearness.shape
    wide = np.full((side + 2, side + 2), np.float32(EMPTY))
    for c in range(views):
        wide[1:-1, 1:-1] = nearness[c]
        for row in range(side):
            z, above, below = wide[row + 1, 1:-1], wide[row, 1:-1], wide[row + 2, 1:-1]
            left, right = wide[row + 1, :-2], wide[row + 1, 2:]
            for column in range(side):
                lowest = min(min(above[column], below[column]), min(left[column], right[column]))
                edges[c, row, column] = (z[column] > EMPTY) & (z[column] - lowest > jump)
