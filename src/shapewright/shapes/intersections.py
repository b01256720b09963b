"""Pairs of triangles of one mesh that cross or overlap, found with a tree of bounding boxes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from shapewright.shapes.arrays import Floats, Ints
from shapewright.shapes.slivers import SLIVER as LENGTH

_PLANE = 1e-8
"""Distance up to which a point is on a plane, of an extent of 1: a tenth of the rounding of single precision."""
_ROUNDING = 1e-15
"""Rounding of a normal in double precision, a few units in the last place (2.2e-16)."""
_LEAF = 4
"""Triangles in a leaf of the tree."""
_DEPTH = 64
"""Levels of the tree, at most."""


def crossing_pairs(triangles: Floats) -> Ints:
    """(P, 2): indices of triangles that cross or overlap, the lower first, in order.

    triangles: (F, 3, 3), the largest extent of them all about 1. Two triangles cross when they share a segment that
    lies inside at least one of them, or a part of their plane: meeting in points and along edges of both is no
    crossing, though an edge on the inside of a face is. What is shared must be longer (in a plane: wider) than LENGTH.
    Triangles that are less high than LENGTH have no plane and are left out.
    """
    if not len(triangles):
        return np.zeros((0, 2), dtype=np.int64)
    pairs = np.asarray(_pairs(np.ascontiguousarray(triangles, dtype=np.float64)))
    return pairs[np.lexsort(pairs.T[::-1])]


@njit(nogil=True, cache=True)
def _pairs(T: Any) -> Any:
    N, slack = _planes(T)
    low, high = _bounds(T)
    order = np.nonzero(slack >= 0.0)[0]
    node_low, node_high, first, last, leaf = _tree(low, high, order)
    found = np.empty((64, 2), dtype=np.int64)
    total = 0
    stack = np.empty(2 * _DEPTH, dtype=np.int64)
    for position in range(len(order)):
        i = order[position]
        stack[0], top = 0, 1
        while top:
            top -= 1
            node = stack[top]
            if last[node] <= position or not _meet(low, high, i, node_low, node_high, node):
                continue
            if not leaf[node]:
                stack[top], stack[top + 1] = first[node], first[node] + 1
                top += 2
                continue
            for k in range(max(first[node], position + 1), last[node]):
                j = order[k]
                if _meet(low, high, i, low, high, j) and _cross(T, N, slack, i, j):
                    if total == len(found):
                        larger = np.empty((2 * total, 2), dtype=np.int64)
                        larger[:total] = found
                        found = larger
                    found[total, 0], found[total, 1] = min(i, j), max(i, j)
                    total += 1
    return found[:total]


@njit(nogil=True, cache=True)
def _planes(T: Any) -> Any:
    """Unit normals, and how far from its plane a point still counts as on it: -1 for a triangle without a plane."""
    N, slack = np.zeros((len(T), 3)), np.full(len(T), -1.0)
    for i in range(len(T)):
        ux, uy, uz = T[i, 1, 0] - T[i, 0, 0], T[i, 1, 1] - T[i, 0, 1], T[i, 1, 2] - T[i, 0, 2]
        vx, vy, vz = T[i, 2, 0] - T[i, 0, 0], T[i, 2, 1] - T[i, 0, 1], T[i, 2, 2] - T[i, 0, 2]
        wx, wy, wz = ux - vx, uy - vy, uz - vz
        nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        area = np.sqrt(nx * nx + ny * ny + nz * nz)
        longest = np.sqrt(max(ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz, wx * wx + wy * wy + wz * wz))
        if longest == 0.0 or area < LENGTH * longest:
            continue
        N[i, 0], N[i, 1], N[i, 2] = nx / area, ny / area, nz / area
        slack[i] = _PLANE + _ROUNDING * longest / area  # the normal of a thin triangle is known less well
    return N, slack


@njit(nogil=True, cache=True)
def _bounds(T: Any) -> Any:
    low, high = np.empty((len(T), 3)), np.empty((len(T), 3))
    for i in range(len(T)):
        for d in range(3):
            low[i, d] = min(T[i, 0, d], T[i, 1, d], T[i, 2, d]) - _PLANE
            high[i, d] = max(T[i, 0, d], T[i, 1, d], T[i, 2, d]) + _PLANE
    return low, high


@njit(nogil=True, cache=True)
def _meet(low: Any, high: Any, i: int, other_low: Any, other_high: Any, j: int) -> bool:
    return bool(
        low[i, 0] <= other_high[j, 0]
        and other_low[j, 0] <= high[i, 0]
        and low[i, 1] <= other_high[j, 1]
        and other_low[j, 1] <= high[i, 1]
        and low[i, 2] <= other_high[j, 2]
        and other_low[j, 2] <= high[i, 2]
    )


@njit(nogil=True, cache=True)
def _tree(low: Any, high: Any, order: Any) -> Any:
    """Bounding boxes over ``order``, which is sorted in place.

    A leaf holds order[first:last]; the children of another node are ``first`` and ``first + 1``.
    """
    room = max(2 * len(order), 1)
    node_low, node_high = np.full((room, 3), np.inf), np.full((room, 3), -np.inf)
    first, last, level = np.zeros((3, room), dtype=np.int64)
    leaf = np.ones(room, dtype=np.bool_)
    last[0], nodes = len(order), 1
    for node in range(room):
        if node >= nodes:
            break
        start, end = first[node], last[node]
        for k in range(start, end):
            for d in range(3):
                node_low[node, d] = min(node_low[node, d], low[order[k], d])
                node_high[node, d] = max(node_high[node, d], high[order[k], d])
        if end - start <= _LEAF or level[node] == _DEPTH - 1:
            continue
        middle = _halve(low, high, order, start, end)
        first[nodes], last[nodes], first[nodes + 1], last[nodes + 1] = start, middle, middle, end
        level[nodes] = level[nodes + 1] = level[node] + 1
        first[node], leaf[node] = nodes, False
        nodes += 2
    return node_low, node_high, first, last, leaf


@njit(nogil=True, cache=True)
def _halve(low: Any, high: Any, order: Any, start: int, end: int) -> int:
    """Put the triangles on the near side of the middle of their widest axis first; returns where the others begin."""
    widest, axis, middle = -1.0, 0, 0.0
    for d in range(3):
        least, greatest = np.inf, -np.inf
        for k in range(start, end):
            doubled = low[order[k], d] + high[order[k], d]
            least, greatest = min(least, doubled), max(greatest, doubled)
        if greatest - least > widest:
            widest, axis, middle = greatest - least, d, (least + greatest) / 2.0
    boundary = start
    for k in range(start, end):
        i = order[k]
        if low[i, axis] + high[i, axis] < middle:
            order[k], order[boundary] = order[boundary], i
            boundary += 1
    return boundary if start < boundary < end else (start + end) // 2


@njit(nogil=True, cache=True)
def _cross(T: Any, N: Any, slack: Any, i: int, j: int) -> bool:
    p0, p1, p2 = _height(T, N, slack, i, j, 0), _height(T, N, slack, i, j, 1), _height(T, N, slack, i, j, 2)
    if (p0 > 0.0 and p1 > 0.0 and p2 > 0.0) or (p0 < 0.0 and p1 < 0.0 and p2 < 0.0):
        return False
    q0, q1, q2 = _height(T, N, slack, j, i, 0), _height(T, N, slack, j, i, 1), _height(T, N, slack, j, i, 2)
    if (q0 > 0.0 and q1 > 0.0 and q2 > 0.0) or (q0 < 0.0 and q1 < 0.0 and q2 < 0.0):
        return False
    if p0 == p1 == p2 == 0.0:
        return _overlap(T, N, i, j)
    if q0 == q1 == q2 == 0.0:
        return _overlap(T, N, j, i)
    # Where neither reaches through the other's plane they touch, and at most an edge of the one lies on the other's.
    if not (min(p0, p1, p2) < 0.0 < max(p0, p1, p2) or min(q0, q1, q2) < 0.0 < max(q0, q1, q2)):
        return False
    dx = N[i, 1] * N[j, 2] - N[i, 2] * N[j, 1]
    dy = N[i, 2] * N[j, 0] - N[i, 0] * N[j, 2]
    dz = N[i, 0] * N[j, 1] - N[i, 1] * N[j, 0]
    length = np.sqrt(dx * dx + dy * dy + dz * dz)
    if length == 0.0:
        return False
    dx, dy, dz = dx / length, dy / length, dz / length
    p_low, p_high = _interval(T, j, p0, p1, p2, dx, dy, dz)
    q_low, q_high = _interval(T, i, q0, q1, q2, dx, dy, dz)
    return bool(min(p_high, q_high) - max(p_low, q_low) > LENGTH)


@njit(nogil=True, cache=True)
def _height(T: Any, N: Any, slack: Any, i: int, j: int, k: int) -> float:
    """How far corner k of triangle j is above the plane of i; 0 within its slack."""
    x, y, z = T[j, k, 0] - T[i, 0, 0], T[j, k, 1] - T[i, 0, 1], T[j, k, 2] - T[i, 0, 2]
    height = N[i, 0] * x + N[i, 1] * y + N[i, 2] * z
    return height if abs(height) > slack[i] else 0.0


@njit(nogil=True, cache=True)
def _interval(T: Any, i: int, h0: float, h1: float, h2: float, dx: float, dy: float, dz: float) -> Any:
    """Where a triangle, its corners at these heights, meets height 0: its reach along the direction (dx, dy, dz)."""
    low, high = np.inf, -np.inf
    a, at_a = 2, h2
    for b in range(3):
        at_b = h0 if b == 0 else h1 if b == 1 else h2
        along_b = dx * T[i, b, 0] + dy * T[i, b, 1] + dz * T[i, b, 2]
        if at_b == 0.0:
            low, high = min(low, along_b), max(high, along_b)
        if at_a * at_b < 0.0:
            along_a = dx * T[i, a, 0] + dy * T[i, a, 1] + dz * T[i, a, 2]
            meeting = along_a + (along_b - along_a) * at_a / (at_a - at_b)
            low, high = min(low, meeting), max(high, meeting)
        a, at_a = b, at_b
    return low, high


@njit(nogil=True, cache=True)
def _overlap(T: Any, N: Any, i: int, j: int) -> bool:
    """Whether two triangles in the plane of i overlap: no edge of either has the other beyond it."""
    return not (_beyond_an_edge(T, N, i, i, j) or _beyond_an_edge(T, N, i, j, i))


@njit(nogil=True, cache=True)
def _beyond_an_edge(T: Any, N: Any, plane: int, i: int, j: int) -> bool:
    for a in range(3):
        b, c = (a + 1) % 3, (a + 2) % 3
        ex, ey, ez = T[i, b, 0] - T[i, a, 0], T[i, b, 1] - T[i, a, 1], T[i, b, 2] - T[i, a, 2]
        nx = N[plane, 1] * ez - N[plane, 2] * ey
        ny = N[plane, 2] * ex - N[plane, 0] * ez
        nz = N[plane, 0] * ey - N[plane, 1] * ex
        length = np.sqrt(nx * nx + ny * ny + nz * nz)
        own = nx * (T[i, c, 0] - T[i, a, 0]) + ny * (T[i, c, 1] - T[i, a, 1]) + nz * (T[i, c, 2] - T[i, a, 2])
        scale = 1.0 / length if own > 0.0 else -1.0 / length
        inwards = -np.inf
        for k in range(3):
            x, y, z = T[j, k, 0] - T[i, a, 0], T[j, k, 1] - T[i, a, 1], T[j, k, 2] - T[i, a, 2]
            inwards = max(inwards, (nx * x + ny * y + nz * z) * scale)
        if inwards <= LENGTH:
            return True
    return False
