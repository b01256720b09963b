"""Vertices and faces as arrays, lists or tensors; faces of any number of corners."""

from __future__ import annotations

from collections.abc import Sequence
from numbers import Real
from typing import Any

import numpy as np

from shapewright.shapes.arrays import Floats, Ints
from shapewright.shapes.mesh import Mesh


def is_table(item: Any) -> bool:
    """Whether it can be vertices or faces: an array or tensor of two dimensions, or a list of rows of numbers."""
    if hasattr(item, "__array__"):
        return getattr(item, "ndim", 0) == 2 or getattr(item, "size", 1) == 0
    return isinstance(item, list | tuple) and all(_is_row(row) for row in item)


def coordinates(items: Any) -> list[tuple[float, ...]]:
    """Of a list of vectors of CadQuery or build123d, as ``tessellate`` gives them; empty for anything else."""
    if not isinstance(items, list) or not all(hasattr(v, "toTuple") or hasattr(v, "X") for v in items):
        return []
    return [v.toTuple() if hasattr(v, "toTuple") else (v.X, v.Y, v.Z) for v in items]


def array(item: Any) -> np.ndarray[Any, Any]:
    """An array of an array, list, or tensor wherever that is kept."""
    return np.asarray(item.detach().cpu() if hasattr(item, "detach") else item)


def mesh_of(vertices: Any, faces: Any) -> Mesh:
    """The mesh of vertices (V, 3) and of faces (F, 3), (F, 4), (F, N), or a list of rows of 3 and more corners.

    Raises ValueError for tables of another form.
    """
    points = array(vertices)
    if np.iscomplexobj(points):
        raise ValueError("the vertices are complex numbers")
    points = np.asarray(points, dtype=np.float64)
    rows = faces if isinstance(faces, list | tuple) and len({len(row) for row in faces}) > 1 else array(faces)
    if len(rows) == 0 or getattr(rows, "size", 1) == 0:
        raise ValueError("the shape is empty: it has no faces")
    if isinstance(rows, np.ndarray):
        corners = _whole(rows)
        if corners.ndim == 2 and corners.shape[1] > 3 and points.ndim == 2 and points.shape[1] == 3:
            _check(corners, len(points))
            corners = _quads(points, corners) if corners.shape[1] == 4 else _polygons(points, corners)
        return Mesh(points, corners)
    polygons = [_whole(np.asarray(row)) for row in rows]
    for number, polygon in enumerate(polygons):
        if len(polygon) < 3:
            raise ValueError(f"face {number} has {len(polygon)} corners; a face has 3 or more")
        _check(polygon, len(points))
    return Mesh(points, _polygons(points, polygons))


def soup(triangles: Any) -> Mesh:
    """The mesh of triangles (F, 3, 3), corner by corner; equal corners become one vertex."""
    corners = array(triangles).astype(np.float64)
    vertices, index = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    return Mesh(vertices, index.reshape(-1, 3))


def _is_row(row: Any) -> bool:
    if isinstance(row, list | tuple):
        return bool(row) and all(isinstance(number, Real) for number in row)
    return isinstance(row, np.ndarray) and row.ndim == 1 and row.dtype.kind in "fiu"


def _whole(faces: np.ndarray[Any, Any]) -> Ints:
    if np.iscomplexobj(faces):
        raise ValueError("the faces are complex numbers")
    numbers = np.asarray(faces, dtype=np.float64) if faces.dtype.kind not in "iub" else faces
    whole = numbers.astype(np.int64)
    if not np.array_equal(whole, numbers):
        raise ValueError("faces hold fractions; they are indices of vertices, from 0")
    return whole


def _check(corners: Ints, count: int) -> None:
    if corners.min() < 0 or corners.max() >= count:
        raise ValueError(f"faces point outside the {count} vertices")


def _quads(points: Floats, quads: Ints) -> Ints:
    """Two triangles of each; those of quads that fold along the one diagonal are cut along the other."""
    first, second = quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]
    folded = (_normals(points, first) * _normals(points, second)).sum(axis=1) < 0.0
    first = np.where(folded[:, None], quads[:, [0, 1, 3]], first)
    second = np.where(folded[:, None], quads[:, [1, 2, 3]], second)
    return np.concatenate([first, second])


def _normals(points: Floats, triangles: Ints) -> Floats:
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.asarray(np.cross(b - a, c - a))


def _polygons(points: Floats, polygons: Sequence[Ints] | Ints) -> Ints:
    """The triangles of each polygon after the other."""
    return np.concatenate([_triangles(points, np.asarray(polygon)) for polygon in polygons])


def _triangles(points: Floats, polygon: Ints) -> Ints:
    if len(polygon) == 3:
        return polygon[None]
    fan = np.stack([np.full(len(polygon) - 2, polygon[0]), polygon[1:-1], polygon[2:]], axis=1)
    normals = _normals(points, fan)
    if (normals @ normals.sum(axis=0) >= 0.0).all():  # convex, or seen from its first corner as if it were
        return fan
    import manifold3d

    right, up, _ = np.linalg.svd(points[polygon] - points[polygon].mean(axis=0))[2]
    if np.cross(right, up) @ normals.sum(axis=0) < 0.0:
        right = -right
    flat = points[polygon] @ np.stack([right, up], axis=1)
    cut = np.asarray(manifold3d.triangulate([flat]), dtype=np.int64)
    return polygon[cut] if len(cut) else fan
