"""Solids made ready for a boolean: what all but coincides is made to coincide, or to overlap.

Two parts that an author means to touch differ by rounding: 0.7 - 0.05 / 2 - 0.05 / 2 is not 0.65. Booleans take them at
their word, and leave a gap without width or a fold without thickness. So coordinates nearer to each other than rounding
brings about are made equal first: planes along the axes then coincide exactly. Slanted planes cannot; one of two that
meet is moved into the other by next to nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate, combinations, pairwise

import numpy as np
from manifold3d import Manifold, Mesh64

from shapewright.modelling.solid.originals import with_points
from shapewright.shapes import Floats

CLOSE, _OVERLAP = 1e-9, 1e-8
"""How near two coordinates are that are made one, and how much slanted planes are made to overlap: parts of the largest
extent."""
_GRID = 1e7
_KEYS = np.array(
    [0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0xD6E8FEB86659FD93], dtype=np.uint64
).astype(np.int64)


def aligned(manifolds: Sequence[Manifold], facing: int = -1, ids: bool = False) -> list[Manifold]:
    """The same solids, moved by less than about 1e-8 of their extent; those that are exact already as they are.

    facing: -1 where planes that face each other are to overlap, as in a union; 1 where those that face the same way
    are, as when the others are cut out of the first. ids: whether faces were given ids, which are to be kept.
    """
    result = list(manifolds)
    boxes = [manifold.bounding_box() for manifold in manifolds]
    extent = max(max(box[d + 3] for box in boxes) - min(box[d] for box in boxes) for d in range(3))
    touching = _touching(boxes, CLOSE * extent)
    if not touching:
        return result
    meshes = [manifolds[i].to_mesh64() for i in touching]
    ends = [0, *accumulate(len(mesh.vert_properties) for mesh in meshes)]
    points = np.concatenate([mesh.vert_properties for mesh in meshes])[:, :3]
    moved = _overlapping(_merged(points, CLOSE * extent), meshes, ends, facing, extent)
    if moved is points:
        return result
    for i, mesh, (start, end) in zip(touching, meshes, pairwise(ends), strict=True):
        if (moved[start:end] != points[start:end]).any():
            result[i] = with_points(mesh, moved[start:end], ids)
    return result


def _touching(boxes: Sequence[Sequence[float]], least: float) -> list[int]:
    """Indices of bounding boxes (x, y, z, x, y, z) that are nearer than ``least`` to another one."""
    found: set[int] = set()
    for (i, a), (j, b) in combinations(enumerate(boxes), 2):
        if all(a[d] <= b[d + 3] + least and b[d] <= a[d + 3] + least for d in range(3)):
            found |= {i, j}
    return sorted(found)


def _merged(points: Floats, least: float) -> Floats:
    """The points, of coordinates with gaps less than ``least`` between them all replaced by that of the first point."""
    columns = np.ascontiguousarray(points.T)
    ordered = np.sort(columns, axis=1)
    gaps = ordered[:, 1:] - ordered[:, :-1]
    todo = ((gaps > 0.0) & (gaps <= least)).any(axis=1)
    if not todo.any():
        return points
    for d in np.nonzero(todo)[0]:
        order = np.argsort(columns[d], kind="stable")
        starts = np.concatenate([[0], np.nonzero(gaps[d] > least)[0] + 1])
        first = np.minimum.reduceat(order, starts)
        columns[d, order] = np.repeat(columns[d, first], np.diff(starts, append=len(order)))
    return columns.T


def _overlapping(points: Floats, meshes: Sequence[Mesh64], ends: Sequence[int], facing: int, extent: float) -> Floats:
    """The points, with slanted planes of later meshes that meet a plane of an earlier one pushed out a little."""
    faces = np.concatenate([mesh.tri_verts.astype(np.int64) + start for mesh, start in zip(meshes, ends, strict=False)])
    a, b, c = np.ascontiguousarray(points.T)[:, faces.T].transpose(1, 0, 2)
    slanted = np.nonzero(~((a == b) & (a == c)).any(axis=0))[0]
    owners = np.searchsorted(ends, faces[slanted, 0], side="right")
    if not len(slanted) or owners[0] == owners[-1]:
        return points
    a = a[:, slanted]
    u, v = b[:, slanted] - a, c[:, slanted] - a
    normals = np.stack([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])
    normals /= np.maximum(np.sqrt((normals * normals).sum(axis=0)), np.finfo(np.float64).tiny)
    planes = np.concatenate([normals, (normals * a).sum(axis=0)[None] / extent])
    keys = _KEYS @ np.round(planes * _GRID).astype(np.int64)  # linear: the key of the other side is the negative
    order = np.argsort(keys, kind="stable")  # of one plane the first mesh's faces come first
    keys, owners = keys[order], owners[order]
    other = np.minimum(np.searchsorted(keys, facing * keys), len(keys) - 1)
    meets = (keys[other] == facing * keys) & (owners[other] < owners)
    if not meets.any():
        return points
    moved = points.copy()
    met, first = np.unique(np.stack([keys[meets], owners[meets]]), axis=1, return_inverse=True)
    for i in range(met.shape[1]):
        side = order[meets][first.ravel() == i]
        moved[np.unique(faces[slanted[side]])] += _OVERLAP * extent * normals[:, side[0]]
    return moved
