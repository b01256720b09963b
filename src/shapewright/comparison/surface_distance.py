"""Distance of points to a surface: exact, by a tree of boxes around its triangles."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from numba import njit

from shapewright.shapes import Floats, Mesh

_LEAF = 4
_ALIKE = 1e-6


class NearSurface:
    """A mesh that distances are measured to, but for triangles without area; raises ValueError when none is left."""

    def __init__(self, mesh: Mesh) -> None:
        corners = mesh.triangles
        crosses = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        doubled = np.linalg.norm(crosses, axis=1)
        solid = doubled > 1e-14
        if not solid.any():
            raise ValueError("the surface has no area")
        self._mesh = mesh
        order, self._nodes, self._boxes = _tree(corners[solid])
        self._corners = np.ascontiguousarray(corners[solid][order])
        self._normals = np.ascontiguousarray((crosses[solid] / doubled[solid, None])[order])

    @cached_property
    def closed(self) -> bool:
        """Whether every edge has as many faces on either side, wound oppositely, so that there is an inside."""
        places, inverse = np.unique(np.round(self._mesh.vertices, 7), axis=0, return_inverse=True)
        faces = inverse.ravel()[self._mesh.faces]
        edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
        edges = edges[edges[:, 0] != edges[:, 1]]
        turns = np.where(edges[:, 0] < edges[:, 1], 1, -1)
        _, which = np.unique(edges.min(axis=1) * len(places) + edges.max(axis=1), return_inverse=True)
        volume = np.einsum("fd,fd->", self._corners[:, 0], np.cross(self._corners[:, 1], self._corners[:, 2]))
        return bool(not np.bincount(which, weights=turns).any() and volume > 0.0)

    def distances(self, points: Floats) -> Floats:
        """(N,) for points (N, 3): positive outside, negative inside where the surface is closed, else not negative."""
        return self._measured(points, self.closed)

    def lengths(self, points: Floats) -> Floats:
        """(N,) for points (N, 3): the distances without a sign."""
        return self._measured(points, False)

    def _measured(self, points: Floats, signed: bool) -> Floats:
        distances = np.empty(len(points))
        points = np.ascontiguousarray(points, dtype=np.float64)
        _measure(points, self._corners, self._normals, self._nodes, self._boxes, signed, distances)
        return distances


@njit(nogil=True, cache=True)
def _tree(corners: Any) -> Any:
    """Boxes of boxes around triangles (F, 3, 3), each with half as many triangles as the one around it.

    Returns the order of the triangles; per node the first and the end of its triangles and its first child, which the
    second follows, -1 for a leaf (M, 3); and its box (M, 6).
    """
    count = len(corners)
    order = np.arange(count)
    middles = np.empty((count, 3))
    for f in range(count):
        for d in range(3):
            middles[f, d] = (corners[f, 0, d] + corners[f, 1, d] + corners[f, 2, d]) / 3.0
    nodes = np.empty((2 * count, 3), dtype=np.int64)
    boxes = np.empty((2 * count, 6))
    nodes[0] = (0, count, -1)
    made, n = 1, 0
    while n < made:
        start, end = nodes[n, 0], nodes[n, 1]
        axis, widest = 0, -1.0
        for d in range(3):
            low, high, first, last = np.inf, -np.inf, np.inf, -np.inf
            for i in range(start, end):
                for k in range(3):
                    low, high = min(low, corners[order[i], k, d]), max(high, corners[order[i], k, d])
                first, last = min(first, middles[order[i], d]), max(last, middles[order[i], d])
            boxes[n, d], boxes[n, 3 + d] = low, high
            if last - first > widest:
                axis, widest = d, last - first
        if end - start > _LEAF:
            order[start:end] = order[start:end][np.argsort(middles[order[start:end], axis])]
            half = (start + end) // 2
            nodes[n, 2] = made
            nodes[made] = (start, half, -1)
            nodes[made + 1] = (half, end, -1)
            made += 2
        n += 1
    return order, nodes[:made].copy(), boxes[:made].copy()


@njit(nogil=True, cache=True)
def _measure(points: Any, corners: Any, normals: Any, nodes: Any, boxes: Any, signed: bool, distances: Any) -> None:
    stack = np.empty(128, dtype=np.int64)
    for n in range(len(points)):
        p = points[n]
        least, squarest, side = np.inf, -1.0, 1.0
        stack[0], depth = 0, 1
        while depth:
            depth -= 1
            node = stack[depth]
            if _to_box(p, boxes[node]) > least + _ALIKE * _ALIKE:
                continue
            child = nodes[node, 2]
            if child >= 0:
                nearer = child if _to_box(p, boxes[child]) < _to_box(p, boxes[child + 1]) else child + 1
                stack[depth], stack[depth + 1] = 2 * child + 1 - nearer, nearer
                depth += 2
                continue
            for f in range(nodes[node, 0], nodes[node, 1]):
                squared, height = _to_triangle(p, corners[f], normals[f])
                # On an edge two faces are equally near: that which the point is squarely before knows the side.
                if squared < least - _ALIKE * _ALIKE or (squared <= least + _ALIKE * _ALIKE and abs(height) > squarest):
                    squarest, side = abs(height), height
                least = min(least, squared)
        distances[n] = -np.sqrt(least) if signed and side < 0.0 else np.sqrt(least)


@njit(nogil=True, cache=True)
def _to_box(p: Any, box: Any) -> float:
    total = 0.0
    for d in range(3):
        outside = max(box[d] - p[d], p[d] - box[3 + d], 0.0)
        total += outside * outside
    return total


@njit(nogil=True, cache=True)
def _to_triangle(p: Any, corners: Any, normal: Any) -> Any:
    """Squared distance to a triangle, and height over its plane."""
    height, inside, least = 0.0, True, np.inf
    for d in range(3):
        height += (p[d] - corners[0, d]) * normal[d]
    for k in range(3):
        a, b = corners[k], corners[(k + 1) % 3]
        length = along = 0.0
        for d in range(3):
            length += (b[d] - a[d]) * (b[d] - a[d])
            along += (p[d] - a[d]) * (b[d] - a[d])
        share = min(max(along / length, 0.0), 1.0) if length > 0.0 else 0.0
        squared = 0.0
        for d in range(3):
            step = p[d] - a[d] - share * (b[d] - a[d])
            squared += step * step
        least = min(least, squared)
        # The side of the edge: (b - a) x (p - a), along the normal.
        across = (
            ((b[1] - a[1]) * (p[2] - a[2]) - (b[2] - a[2]) * (p[1] - a[1])) * normal[0]
            + ((b[2] - a[2]) * (p[0] - a[0]) - (b[0] - a[0]) * (p[2] - a[2])) * normal[1]
            + ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) * normal[2]
        )
        inside &= across >= 0.0
    return (height * height if inside else least), height
