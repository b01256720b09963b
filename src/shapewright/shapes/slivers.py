"""Slivers: triangles without height, and their removal."""

from __future__ import annotations

import numpy as np

from shapewright.shapes.arrays import Floats, Ints

SLIVER = 1e-6
"""The height below which a triangle is a sliver, as a part of its mesh's largest extent: a file of single precision
hardly tells its corners from a line, and its normal not at all."""

_PASSES = 12
"""Times that all slivers are tried, at most."""
_NEIGHBOURS = 5
"""Thin neighbours that are flipped first, at most."""


def heights(triangles: Floats) -> Floats:
    """(F,): the least height of each triangle of (F, 3, 3)."""
    a, b, c = np.ascontiguousarray(triangles.transpose(1, 2, 0))
    u, v, w = b - a, c - b, a - c
    squares = np.maximum(np.maximum((u * u).sum(axis=0), (v * v).sum(axis=0)), (w * w).sum(axis=0))
    doubled = (u[1] * v[2] - u[2] * v[1]) ** 2 + (u[2] * v[0] - u[0] * v[2]) ** 2 + (u[0] * v[1] - u[1] * v[0]) ** 2
    return np.asarray(np.sqrt(np.divide(doubled, squares, out=np.zeros(len(triangles)), where=squares > 0.0)))


def has_slivers(triangles: Floats, least: float) -> bool:
    """Whether any of (F, 3, 3) is less high than ``least``, or by rounding nearly so: in a third of the time."""
    a, b, c = np.ascontiguousarray(triangles.transpose(1, 2, 0))
    u, v, w = b - a, c - a, c - b
    uu, vv, ww, uv = (u * u).sum(axis=0), (v * v).sum(axis=0), (w * w).sum(axis=0), (u * v).sum(axis=0)
    return bool((uu * vv - uv * uv < (1.1 * least) ** 2 * np.maximum(np.maximum(uu, vv), ww)).any())


def without_slivers(vertices: Floats, faces: Ints, owners: Ints, least: float) -> tuple[Floats, Ints, Ints]:
    """Vertices, faces and the owners of faces, with as few faces less high than ``least`` as possible.

    The corner of a flat face all but lies on its longest edge: the neighbour there is divided at that corner instead;
    where that does not help, the shortest edge is closed. The surface moves by about ``least`` at most.
    """
    if not (heights(vertices[faces]) < least).any():
        return vertices, faces, owners
    mesh = _Faces(vertices, faces.copy(), owners.copy(), least)
    for _ in range(_PASSES):
        if not mesh.improve():
            break
    used, kept = np.unique(mesh.faces[mesh.alive], return_inverse=True)
    return vertices[used], kept.reshape(-1, 3), mesh.owners[mesh.alive]


class _Faces:
    """The faces of a closed mesh while they are repaired."""

    def __init__(self, vertices: Floats, faces: Ints, owners: Ints, least: float) -> None:
        self.vertices, self.faces, self.owners, self.least = vertices, faces, owners, least
        self.alive = np.ones(len(faces), dtype=bool)

    def improve(self) -> bool:
        """Try once to remove each sliver, the flattest first; returns whether any was removed."""
        low = np.where(self.alive, heights(self.vertices[self.faces]), np.inf)
        helped = False
        for i in np.argsort(low)[: int((low < self.least).sum())].tolist():
            if self.alive[i] and heights(self.vertices[self.faces[[i]]])[0] < self.least:
                helped |= self.flip(i, _NEIGHBOURS) or self.close(i)
        return helped

    def around(self, *corners: int) -> list[int]:
        """Faces that have all these corners."""
        found = self.alive.copy()
        for corner in corners:
            found &= (self.faces == corner).any(axis=1)
        return [int(i) for i in np.nonzero(found)[0]]

    def flip(self, i: int, further: int) -> bool:
        """Divide the neighbour at the longest edge of face i at the corner across; returns whether it was done.

        Where it does not help because the neighbour is thin too, that one is flipped first, ``further`` times.
        """
        a, b, c = self._turned(i, longest=True)
        beside = [j for j in self.around(a, b) if j != i]
        if len(beside) != 1:
            return False
        j = beside[0]
        d = int(self.faces[j].sum()) - a - b
        pair = np.array([[a, d, c], [d, b, c]])
        old, new = heights(self.vertices[self.faces[[i, j]]]), heights(self.vertices[pair])
        if new.min() <= 1.001 * old.min() or self.around(c, d):
            mutual = {a, b} == set(self._turned(j, longest=True)[:2])
            return not mutual and further > 0 and self.flip(j, further - 1) and self.flip(i, further - 1)
        normal = self._normals(self.vertices[self.faces[[j if old[1] > old[0] else i]]])[0]
        off = np.abs((self.vertices[[c, d]] - self.vertices[a]) @ normal).max()
        if off > self.least or (self._normals(self.vertices[pair]) @ normal).min() <= 0.0:
            return False
        self.faces[[i, j]] = pair
        self.owners[[i, j]] = self.owners[j if old[1] > old[0] else i]
        return True

    def close(self, i: int) -> bool:
        """Move one end of the shortest edge of face i onto the other, if the surface stays; returns whether it did."""
        a, b, _ = self._turned(i, longest=False)
        for gone, kept in ((a, b), (b, a)):
            moved = [j for j in self.around(gone) if kept not in self.faces[j]]
            shared = set(self.faces[self.around(gone)].flat) & set(self.faces[self.around(kept)].flat) - {gone, kept}
            if len(shared) != 2 or min(len(self.around(int(corner))) for corner in shared) < 4:
                continue  # it would join what is not joined, or fold the surface flat
            before = self.vertices[self.faces[moved]]
            before = before[heights(before) >= self.least]
            after = np.where((before == self.vertices[gone]).all(axis=2)[..., None], self.vertices[kept], before)
            normals = self._normals(before)
            off = np.abs(((self.vertices[kept] - before[:, 0]) * normals).sum(axis=1)).max(initial=0.0)
            upright = ((self._normals(after) * normals).sum(axis=1) > 0.0).all()
            if off <= self.least and upright and heights(after).min(initial=np.inf) >= self.least:
                self.alive[self.around(gone, kept)] = False
                self.faces[self.faces == gone] = kept
                return True
        return False

    def _normals(self, triangles: Floats) -> Floats:
        """(F, 3): unit normals, or zeros."""
        normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1), np.finfo(np.float64).tiny)[:, None])

    def _turned(self, i: int, longest: bool) -> tuple[int, int, int]:
        """The corners of face i, from its longest or shortest edge on."""
        face = self.faces[i]
        lengths = np.linalg.norm(np.roll(self.vertices[face], -1, axis=0) - self.vertices[face], axis=1)
        a, b, c = np.roll(face, -int(lengths.argmax() if longest else lengths.argmin()))
        return int(a), int(b), int(c)
