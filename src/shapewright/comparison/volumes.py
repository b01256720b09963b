"""How much of the volumes of two meshes is the same; soups have one too, where most rays that go in come out again."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from shapewright.shapes import Floats, Ints, Mesh

RAYS = 64
"""Squared, the rays along each axis. With them the IoU is within .01 of that of 256 squared (docs/architecture.md)."""
CLOSED = 0.75
"""Least share of the rays along an axis that leave as often as they enter, of those that hit. Of a sofa without its
underside those along two axes do; with 5 % of the faces missing 90 % of the rays do."""
_SHUT = 1e-3  # of its area, least sum of the area vectors of an open part
_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0  # rays are shifted by multiples: no two rows of them hit the same edge
_NO_VOLUME = 1e-9  # of the cube
_EITHER = 2  # the turn of a face whose front may be on either side

Bools = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Volume:
    """The chords that a normalised mesh cuts out of rays along x, y and z.

    chords: (K, 2), where each starts and ends.
    starts: (3 * R + 1,), the first chord of each of R rays along each axis.
    closed: (3 * R,), whether the ray leaves the mesh as often as it enters.
    axes: (3,), whether at least CLOSED of the rays along it that hit the mesh are closed.
    """

    chords: Floats
    starts: Ints
    closed: Bools
    axes: Bools

    @classmethod
    def of(cls, mesh: Mesh, rays: int = RAYS) -> Volume:
        """Inside is where the winding number along a ray is not 0; rays: squared, along each axis.

        A part that is wound inside out is turned. A face that lies twice counts once. A closed part whose faces are
        wound without order, or lie twice with either side in front, is entered and left by turns.
        """
        triangles = mesh.normalised().triangles
        starts, depths, turns = _cast(triangles, _turns(triangles), rays)
        chords, first, closed = _chords(starts, depths, turns)
        hit = np.diff(starts).reshape(3, -1) > 0
        share = (closed.reshape(3, -1) & hit).sum(axis=1) / np.maximum(hit.sum(axis=1), 1)
        return cls(chords, first, closed, share >= CLOSED)

    @property
    def share(self) -> float:
        """The volume, of that of a cube as long as the largest extent; NaN for a mesh that encloses none."""
        return float(_overlap(self, self)[0])


def intersection_over_union(first: Volume, second: Volume) -> float:
    """IoU of the volumes of two meshes, each normalised: 0 to 1; NaN where one of them encloses no volume.

    A mesh encloses a volume if its rays are closed along two axes or three. Lengths in common along these, over lengths
    of both, go by rays that are closed in both.
    """
    common, union = _overlap(first, second)
    return common / union if union > 0.0 else math.nan


def _overlap(first: Volume, second: Volume) -> tuple[float, float]:
    """Volumes in common and of both, NaN where one of the two encloses none. An axis counts by its chords."""
    axes = first.axes & second.axes
    if min(first.axes.sum(), second.axes.sum()) < 2:
        return math.nan, math.nan
    lengths = _lengths(first.chords, first.starts, second.chords, second.starts, first.closed & second.closed)
    weights = axes * lengths[:, 3] / max((axes * lengths[:, 3]).sum(), 1.0)
    common, one, other = weights @ lengths[:, :3] * 3.0 / len(first.closed)
    if min(one, other) <= _NO_VOLUME:
        return math.nan, math.nan
    return float(common), float(one + other - common)


def _turns(triangles: Floats) -> Ints:
    """(F,): how often a ray enters at the front of each face: 1, -1 for inverted, 0 for left out, or _EITHER."""
    corners = _corners(triangles)
    low, middle, high = np.sort(corners, axis=1).T
    face = (low << 42) | (middle << 21) | high
    a, b, c = corners.T
    forward = ((a < b) & (b < c)) | ((b < c) & (c < a)) | ((c < a) & (a < b))
    used = (low < middle) & (middle < high)
    turns = _firsts(face * 2 + forward, used)
    single = _firsts(face, used)
    plain = turns & ~np.isin(face, face[turns & ~single])
    parts = _Parts.of(triangles, corners)
    # Of walls between two boxes both faces go; where the rest is open without them, somebody doubled faces.
    doubled = parts.any(turns & ~plain) & ~(parts.any(plain) & parts.shut(plain))
    alone = np.where(doubled[parts.of_face], single, turns)
    shut = parts.shut(alone)
    unordered = ~shut & parts.any(alone) & parts.even(alone)
    signs = np.where(unordered, _EITHER, np.where(shut & (parts.volumes(alone) < 0.0), -1, 1))
    return np.where((shut | unordered)[parts.of_face], alone, turns) * signs[parts.of_face]


@dataclass(frozen=True, eq=False)
class _Parts:
    """Faces that hang together at their corners."""

    corners: Ints  # (F, 3)
    places: Floats  # (F, 3), of the first corner, about the middle of the part
    areas: Floats  # (F, 3), twice the area vectors
    of_face: Ints  # (F,)
    count: int

    @classmethod
    def of(cls, triangles: Floats, corners: Ints) -> _Parts:
        a, b, c = corners.T
        edges = coo_array((np.ones(2 * len(a)), (np.r_[a, b], np.r_[b, c])), shape=(corners.max() + 1,) * 2)
        count, part = connected_components(edges, directed=False)
        first, second, third = triangles.transpose(1, 0, 2)
        parts = cls(corners, first, np.cross(second - first, third - first), part[a], int(count))
        middles = parts._sums(first) / parts._sums(np.ones((len(a), 1)))
        return replace(parts, places=first - middles[parts.of_face])

    def any(self, faces: Bools) -> Bools:
        """Whether a part has some of the faces."""
        return np.asarray(np.bincount(self.of_face, faces, self.count) > 0)

    def shut(self, faces: Bools) -> Bools:
        """Whether the area vectors of a part's faces sum up to nothing: it is closed, and wound one way."""
        areas = self.areas * faces[:, None]
        whole = self._sums(np.linalg.norm(areas, axis=1)[:, None])[:, 0]
        return np.asarray(np.linalg.norm(self._sums(areas), axis=1) <= _SHUT * whole)

    def volumes(self, faces: Bools) -> Floats:
        """Six times the volume inside a part's faces, negative where these are wound inside out."""
        cones = (self.areas * self.places).sum(axis=1) * faces
        return self._sums(cones[:, None])[:, 0]

    def even(self, faces: Bools) -> Bools:
        """Whether every edge of a part has an even number of the faces."""
        some = self.corners[faces]
        pairs = np.concatenate([some[:, [0, 1]], some[:, [1, 2]], some[:, [2, 0]]])
        edges = (pairs.min(axis=1) << 32) | pairs.max(axis=1)
        _, first, times = np.unique(edges, return_index=True, return_counts=True)
        return np.asarray(np.bincount(np.tile(self.of_face[faces], 3)[first], times % 2, self.count) == 0)

    def _sums(self, values: Floats) -> Floats:
        """(count, D): of values (F, D) over each part."""
        return np.stack([np.bincount(self.of_face, column, self.count) for column in values.T], axis=1)


def _corners(triangles: Floats) -> Ints:
    """(F, 3): a number for each place, rounded to 2e-6 of the largest extent."""
    places = np.round((triangles + 1.0) * 2.0**19).astype(np.int64)
    keys = (places[..., 0] << 42) | (places[..., 1] << 21) | places[..., 2]
    return np.asarray(np.unique(keys, return_inverse=True)[1].reshape(-1, 3))


def _firsts(keys: Ints, used: Bools) -> Bools:
    """(N,): the first of every key, of those that are used."""
    firsts = np.zeros(len(keys), dtype=bool)
    rows = np.flatnonzero(used)
    firsts[rows[np.unique(keys[rows], return_index=True)[1]]] = True
    return firsts


@njit(nogil=True, cache=True)
def _cast(triangles: Floats, turns: Ints, rays: int) -> tuple[Ints, Floats, Ints]:
    """Where rays hit: the first hit of each ray (3 * R + 1,); by ray and depth, depths and turns of the faces (K,)."""
    starts = np.zeros(3 * rays * rays + 1, np.int64)
    free, depths, found = starts, np.empty(0), np.empty(0, np.int64)
    for fill in (False, True):
        for f in range(len(triangles)):
            for axis in range(3 if turns[f] != 0 else 0):
                u, v = (axis + 1) % 3, (axis + 2) % 3
                ax, ay = (triangles[f, 0, u] + 0.5) * rays, (triangles[f, 0, v] + 0.5) * rays
                bx, by = (triangles[f, 1, u] + 0.5) * rays, (triangles[f, 1, v] + 0.5) * rays
                cx, cy = (triangles[f, 2, u] + 0.5) * rays, (triangles[f, 2, v] + 0.5) * rays
                area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
                if area == 0.0:
                    continue
                side = 1.0 if area > 0.0 else -1.0
                for i in range(max(int(min(ax, bx, cx)), 0), min(int(max(ax, bx, cx)), rays - 1) + 1):
                    for j in range(max(int(min(ay, by, cy)), 0), min(int(max(ay, by, cy)), rays - 1) + 1):
                        x, y = i + (j * _GOLDEN) % 1.0, j + (i * _GOLDEN) % 1.0
                        at_a = (bx - x) * (cy - y) - (by - y) * (cx - x)
                        at_b = (cx - x) * (ay - y) - (cy - y) * (ax - x)
                        at_c = (ax - x) * (by - y) - (ay - y) * (bx - x)
                        if at_a * side <= 0.0 or at_b * side <= 0.0 or at_c * side <= 0.0:
                            continue
                        ray = (axis * rays + i) * rays + j
                        if not fill:
                            starts[ray + 1] += 1
                            continue
                        depth = (
                            at_a * triangles[f, 0, axis] + at_b * triangles[f, 1, axis] + at_c * triangles[f, 2, axis]
                        )
                        at = free[ray]
                        while at > starts[ray] and depths[at - 1] > depth / area:
                            depths[at], found[at] = depths[at - 1], found[at - 1]
                            at -= 1
                        depths[at] = depth / area
                        found[at] = _EITHER if turns[f] == _EITHER else (-turns[f] if area > 0.0 else turns[f])
                        free[ray] += 1
        if not fill:
            starts = np.cumsum(starts)
            free, depths, found = starts.copy(), np.empty(starts[-1]), np.empty(starts[-1], np.int64)
    return starts, depths, found


@njit(nogil=True, cache=True)
def _chords(starts: Ints, depths: Floats, turns: Ints) -> tuple[Floats, Ints, Bools]:
    """See ``Volume``: chords, the first of each ray, and which rays are closed."""
    rays, made = len(starts) - 1, 0
    chords, first, closed = np.empty((len(depths) // 2 + 1, 2)), np.empty(rays + 1, np.int64), np.empty(rays, np.bool_)
    for ray in range(rays):
        first[ray] = made
        winding, odd = 0, False
        for hit in range(starts[ray], starts[ray + 1]):
            outside = winding == 0 and not odd
            if turns[hit] == _EITHER:
                odd = not odd
            else:
                winding += turns[hit]
            if outside:
                chords[made, 0] = depths[hit]
            elif winding == 0 and not odd:
                chords[made, 1] = depths[hit]
                made += 1
        closed[ray] = winding == 0 and not odd
        if not closed[ray]:
            made = first[ray]
    first[rays] = made
    return chords[:made].copy(), first, closed


@njit(nogil=True, cache=True)
def _lengths(chords: Floats, starts: Ints, others: Floats, firsts: Ints, closed: Bools) -> Floats:
    """(3, 4): along each axis the lengths in common, of chords and of others, and their number; on closed rays."""
    lengths, rays = np.zeros((3, 4)), len(closed) // 3
    for ray in range(len(closed)):
        if not closed[ray]:
            continue
        total = lengths[ray // rays]
        total[3] += starts[ray + 1] - starts[ray] + firsts[ray + 1] - firsts[ray]
        for i in range(starts[ray], starts[ray + 1]):
            total[1] += chords[i, 1] - chords[i, 0]
            for j in range(firsts[ray], firsts[ray + 1]):
                total[0] += max(min(chords[i, 1], others[j, 1]) - max(chords[i, 0], others[j, 0]), 0.0)
        for j in range(firsts[ray], firsts[ray + 1]):
            total[2] += others[j, 1] - others[j, 0]
    return lengths
