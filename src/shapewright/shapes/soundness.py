"""Whether a mesh is clean: closed, manifold, wound outwards, free of self-intersections and of slivers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numba import njit

from shapewright.shapes.arrays import Floats, Ints
from shapewright.shapes.intersections import crossing_pairs
from shapewright.shapes.slivers import SLIVER, heights


@dataclass(frozen=True)
class Soundness:
    """What is right and wrong with a mesh; ``sound`` says whether all is right.

    Attributes:
        closed: every edge has a face on either side.
        manifold: no edge has more than two faces, and the faces around a vertex are one fan.
        oriented: neighbouring faces are wound alike; those of a closed mesh are counter-clockwise seen from outside, so
            that its volume is positive.
        self_intersections: pairs of faces that cross or overlap.
        slivers: faces without height.
        components: parts of the surface that share no edge; a hollow counts.
        triangles: number of faces.
    """

    closed: bool
    manifold: bool
    oriented: bool
    self_intersections: int
    slivers: int
    components: int
    triangles: int

    @property
    def sound(self) -> bool:
        return self.closed and self.manifold and self.oriented and not self.self_intersections and not self.slivers

    def __str__(self) -> str:
        wrong = [name for name in ("closed", "manifold", "oriented") if not getattr(self, name)]
        faults = [f"not {name}" for name in wrong]
        counts = (self.self_intersections, "self-intersections"), (self.slivers, "slivers")
        faults += [f"{n} {what}" for n, what in counts if n]
        parts = f"{self.triangles} triangles in {self.components} component{'s' if self.components != 1 else ''}"
        return f"{', '.join(faults) or 'sound'}; {parts}"


def soundness(vertices: Floats, faces: Ints) -> Soundness:
    """Examine a mesh of any kind: vertices (V, 3), faces (F, 3).

    Lengths below a millionth of its largest extent count as nothing.

    Faces are neighbours through the vertices that they share; in a mesh that is open so, vertices at the same place
    are taken for one. Faces that meet in points and along their edges do not intersect; faces that lie on one another,
    and a face with another's edge on its inside, do.
    """
    if not len(faces):
        return Soundness(False, True, True, 0, 0, 0, 0)
    triangles = vertices[faces]
    corners = triangles.reshape(-1, 3)
    low, high = corners.min(axis=0), corners.max(axis=0)
    extent = float((high - low).max())
    closed, manifold, oriented, components = topology(faces, len(vertices))
    if not closed:
        faces = _welded(vertices, faces)
        closed, manifold, oriented, components = topology(faces, len(vertices))
    triangles = (triangles - np.stack([low, high]).mean(axis=0)) / (extent or 1.0)
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    outwards = not closed or float(np.einsum("fd,fd->", a, np.cross(b, c))) > 0.0
    return Soundness(
        closed=bool(closed),
        manifold=bool(manifold),
        oriented=bool(oriented) and outwards,
        self_intersections=len(crossing_pairs(triangles)),
        slivers=int((heights(triangles) < SLIVER).sum()),
        components=int(components),
        triangles=len(faces),
    )


def _welded(vertices: Floats, faces: Ints) -> Ints:
    """(F, 3): the faces with every vertex replaced by the first one at the same place."""
    order = np.lexsort(vertices.T)
    moved = np.any(np.diff(vertices[order], axis=0) != 0.0, axis=1)
    places = np.empty(len(order), dtype=np.int64)
    places[order] = order[np.maximum.accumulate(np.where(np.r_[True, moved], np.arange(len(order)), 0))]
    return np.asarray(places[faces])


@njit(nogil=True, cache=True)
def topology(faces: Any, vertex_count: int) -> Any:
    """Whether faces (F, 3) are closed, manifold and wound alike, and how many components they are."""
    keys, starts = np.empty(3 * len(faces), dtype=np.int64), np.empty(3 * len(faces), dtype=np.int64)
    for f in range(len(faces)):
        for k in range(3):
            a, b = faces[f, k], faces[f, (k + 1) % 3]
            keys[3 * f + k], starts[3 * f + k] = min(a, b) * vertex_count + max(a, b), a
    order = np.argsort(keys)
    closed = manifold = oriented = True
    parents, corners = np.arange(len(faces)), np.arange(3 * len(faces))
    begin = 0
    while begin < len(order):
        end, turns = begin, 0
        while end < len(order) and keys[order[end]] == keys[order[begin]]:
            turns += 1 if starts[order[end]] == starts[order[begin]] else -1
            _join(parents, order[begin] // 3, order[end] // 3)
            end += 1
        closed &= end - begin > 1
        manifold &= end - begin <= 2
        oriented &= turns == 0 or end - begin == 1
        if end - begin == 2:
            for vertex in (starts[order[begin]], faces[order[begin] // 3, (order[begin] + 1) % 3]):
                _join(corners, _corner(faces, order[begin] // 3, vertex), _corner(faces, order[begin + 1] // 3, vertex))
        begin = end
    fans, components = np.zeros(vertex_count, dtype=np.int64), 0
    for f in range(len(faces)):
        components += parents[f] == f
        for k in range(3):
            fans[faces[f, k]] += corners[3 * f + k] == 3 * f + k
    return closed, manifold and fans.max() <= 1, oriented, components


@njit(nogil=True, cache=True)
def _corner(faces: Any, face: int, vertex: int) -> int:
    for k in range(2):
        if faces[face, k] == vertex:
            return 3 * face + k
    return 3 * face + 2


@njit(nogil=True, cache=True)
def _join(parents: Any, a: int, b: int) -> None:
    """Put two members into one set of a forest in which the root of each set is its own parent."""
    while parents[a] != a:
        parents[a] = parents[parents[a]]
        a = parents[a]
    while parents[b] != b:
        parents[b] = parents[parents[b]]
        b = parents[b]
    parents[max(a, b)] = min(a, b)
