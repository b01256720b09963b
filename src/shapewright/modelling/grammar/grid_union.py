"""The union of boxes along the axes, without booleans: on the grid of their own coordinates, stitched exactly."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from shapewright.shapes import Floats, Ints
from shapewright.shapes.slivers import SLIVER, has_slivers, without_slivers
from shapewright.shapes.soundness import topology

_MOST_CELLS = 500_000  # of a grid that is filled box by box: 4 MB; finer ones are left to booleans


def unite(low: Floats, high: Floats, owners: Ints) -> tuple[Floats, Ints, Ints] | None:
    """The surface of the union: points (V, 3), faces (F, 3), wound outwards, and the box that each comes from (F,).

    low, high: (B, 3), corners of boxes. owners: (B,), numbers from 0 up; where boxes overlap the first one counts. Of
    boxes with the same owner what is flat is one face, which comes from one of them.
    Coordinates nearer to each other than a millionth of the extent are made one. None when the union is no manifold,
    because boxes meet in an edge or a corner only, and when there are too many coordinates for a grid.
    """
    least = SLIVER * float((high.max(axis=0) - low.min(axis=0)).max())
    (xs, x0, x1), (ys, y0, y1), (zs, z0, z1) = (_grid_lines(low[:, d], high[:, d], least) for d in range(3))
    if min(len(xs), len(ys), len(zs)) < 2 or len(xs) * len(ys) * len(zs) > _MOST_CELLS:
        return None
    points, faces, origins = _stitched(x0, x1, y0, y1, z0, z1, owners, xs, ys, zs)
    closed, manifold, _, _ = topology(faces, len(points))
    if not (closed and manifold):
        return None
    if has_slivers(points[faces], least):  # on a ledge as narrow as a thousandth of its length
        return without_slivers(points, faces, origins, least)
    return points, faces, origins


@njit(nogil=True, cache=True)
def _grid_lines(low: Any, high: Any, least: float) -> Any:
    """Coordinates, sorted, each over ``least`` above the one before, and the places of the ends (B,) among them."""
    values = np.sort(np.concatenate((low, high)))
    count = 1
    for value in values:
        if value - values[count - 1] > least:
            values[count] = value
            count += 1
    lines = values[:count].copy()
    first = np.searchsorted(lines, low, side="right") - 1
    return lines, first, np.searchsorted(lines, high, side="right") - 1


@njit(nogil=True, cache=True)
def _stitched(x0: Any, x1: Any, y0: Any, y1: Any, z0: Any, z1: Any, owners: Any, xs: Any, ys: Any, zs: Any) -> Any:
    """Points (V, 3), in the order of the grid of these coordinates, triangles (F, 3) and the box of each.

    x0 to z1: (B,), where in xs, ys and zs the boxes begin and end.
    """
    shape = np.array([len(xs), len(ys), len(zs)])
    stride = np.array([shape[1] * shape[2], shape[2], 1])
    cells = np.full(shape[0] * shape[1] * shape[2], -1, dtype=np.int64)
    for b in range(len(owners) - 1, -1, -1):
        for x in range(x0[b], x1[b]):
            for y in range(y0[b], y1[b]):
                start = x * stride[0] + y * stride[1]
                cells[start + z0[b] : start + z1[b]] = b
    rectangles = _rectangles(cells, owners, shape, stride)
    corner = np.zeros(len(cells), dtype=np.bool_)
    most = 0
    for d, at, _, _, u0, u1, v0, v1 in rectangles:
        u, v = stride[(d + 1) % 3], stride[(d + 2) % 3]
        for i in (u0, u1):
            for j in (v0, v1):
                corner[at * stride[d] + i * u + j * v] = True
        most += 2 * (u1 - u0 + v1 - v0)
    faces, origins = np.empty((most, 3), dtype=np.int64), np.empty(most, dtype=np.int64)
    total = 0
    for rectangle in rectangles:
        before = total
        total = _fill(rectangle, corner, stride, faces, total)
        origins[before:total] = rectangle[3]
    points, faces = _numbered(faces[:total], stride, xs, ys, zs)
    return points, faces, origins[:total]


@njit(nogil=True, cache=True)
def _numbered(faces: Any, stride: Any, xs: Any, ys: Any, zs: Any) -> Any:
    """Points (V, 3) of the grid that faces use, and the faces, which point at these."""
    corners = faces.ravel()
    used = np.zeros(len(xs) * stride[0], dtype=np.int64)
    used[corners] = 1
    places = np.flatnonzero(used)
    points = np.stack((xs[places // stride[0]], ys[places % stride[0] // stride[1]], zs[places % stride[1]]), axis=1)
    return points, (np.cumsum(used) - 1)[corners].reshape(-1, 3)


@njit(nogil=True, cache=True)
def _rectangles(cells: Any, owners: Any, shape: Any, stride: Any) -> Any:
    """Of each: axis, place along it, 1 or -1 for the way that it faces, a box, and the extent along the other axes."""
    found = []
    for d in range(3):
        u, v = (d + 1) % 3, (d + 2) % 3
        open_ = np.empty((shape[u], shape[v]), dtype=np.int64)
        for at in range(shape[d]):
            for sign in (-1, 1):
                inside, outside = (at - 1, at) if sign > 0 else (at, at - 1)
                if inside < 0 or inside >= shape[d] - 1:
                    continue
                any_ = False
                for i in range(shape[u] - 1):
                    for j in range(shape[v] - 1):
                        place = i * stride[u] + j * stride[v]
                        beyond = -1 if outside < 0 or outside >= shape[d] - 1 else cells[place + outside * stride[d]]
                        open_[i, j] = cells[place + inside * stride[d]] if beyond < 0 else -1
                        any_ |= open_[i, j] >= 0
                if not any_:
                    continue
                for i in range(shape[u] - 1):
                    for j in range(shape[v] - 1):
                        if open_[i, j] >= 0:
                            box = open_[i, j]
                            end_i, end_j = _grow(open_, owners, i, j, shape[u] - 1, shape[v] - 1)
                            found.append((d, at, sign, box, i, end_i, j, end_j))
    return found


@njit(nogil=True, cache=True)
def _grow(open_: Any, owners: Any, i: int, j: int, most_i: int, most_j: int) -> Any:
    """The ends of a rectangle of cells of one owner from (i, j) on, which are closed."""
    owner = owners[open_[i, j]]
    end_j = j + 1
    while end_j < most_j and open_[i, end_j] >= 0 and owners[open_[i, end_j]] == owner:
        end_j += 1
    end_i = i + 1
    while end_i < most_i:
        for k in range(j, end_j):
            if open_[end_i, k] < 0 or owners[open_[end_i, k]] != owner:
                open_[i:end_i, j:end_j] = -1
                return end_i, end_j
        end_i += 1
    open_[i:end_i, j:end_j] = -1
    return end_i, end_j


@njit(nogil=True, cache=True)
def _fill(rectangle: Any, corner: Any, stride: Any, faces: Any, total: int) -> int:
    """Triangles of a rectangle whose sides pass through corners of others, which become theirs too."""
    d, at, sign, _, u0, u1, v0, v1 = rectangle
    u, v = stride[(d + 1) % 3], stride[(d + 2) % 3]
    origin = at * stride[d]
    bottom, top = _side(corner, origin + v0 * v, u, u0, u1), _side(corner, origin + v1 * v, u, u0, u1)
    left, right = _side(corner, origin + u0 * u, v, v0, v1), _side(corner, origin + u1 * u, v, v0, v1)
    # The left side is seen from the second point below, the right side from the last but one above; what remains has
    # points on two parallel lines only: no triangle has its corners on one line.
    for k in range(len(left) - 1):
        total = _face(faces, total, left[k], bottom[1], left[k + 1], sign)
    for k in range(len(right) - 1):
        total = _face(faces, total, right[k], right[k + 1], top[len(top) - 2], sign)
    i, j = 1, 0
    while i < len(bottom) - 1 or j < len(top) - 2:
        here, there = (bottom[i] - v0 * v) // u, (top[j] - v1 * v) // u
        if j == len(top) - 2 or (i < len(bottom) - 1 and here <= there):
            total = _face(faces, total, bottom[i], bottom[i + 1], top[j], sign)
            i += 1
        else:
            total = _face(faces, total, bottom[i], top[j + 1], top[j], sign)
            j += 1
    return total


@njit(nogil=True, cache=True)
def _side(corner: Any, origin: int, step: int, start: int, end: int) -> Any:
    """Grid points at the ends of a side, and corners on it."""
    points = np.empty(end - start + 1, dtype=np.int64)
    count = 0
    for k in range(start, end + 1):
        if k in (start, end) or corner[origin + k * step]:
            points[count] = origin + k * step
            count += 1
    return points[:count]


@njit(nogil=True, cache=True)
def _face(faces: Any, total: int, a: int, b: int, c: int, sign: int) -> int:
    faces[total, 0] = a
    faces[total, 1], faces[total, 2] = (b, c) if sign > 0 else (c, b)
    return total + 1
