"""The pieces that a mesh consists of: faces that hang together by places they share, and have one label."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from shapewright.shapes import Floats, Ints, Mesh

_CELLS = 2**20
"""Cells along a normalised mesh: corners in one cell, a millionth of its extent, stand at one place."""
_MOST = 3000
"""Pieces that are looked at one by one; a mesh of more, such as a tree of loose leaves, is one piece."""
_NEAR_CELLS = 2.0
"""Distance of cells that count as near, along their grid: at least one empty cell lies between others."""


@dataclass(frozen=True, eq=False)
class Pieces:
    """A mesh in pieces.

    Attributes:
        mesh: the whole, normalised.
        of_faces: (F,), the piece of each face.
        low: (P, 3), the least corner of each piece.
        high: (P, 3), the greatest.
        components: how many there are whatever their labels.
        closed: whether every edge has a face on either side.
    """

    mesh: Mesh
    of_faces: Ints
    low: Floats
    high: Floats
    components: int
    closed: bool

    def __len__(self) -> int:
        return len(self.low)

    @classmethod
    def of(cls, mesh: Mesh) -> Pieces:
        """mesh: normalised."""
        corners = np.unique(_keys(mesh.vertices, 1.0 / _CELLS), return_inverse=True)[1][mesh.faces]
        count, component = _connected(int(corners.max()) + 1, corners[:, [0, 0]].ravel(), corners[:, 1:].ravel())
        of_faces = component[corners[:, 0]]
        components = len(np.unique(of_faces))
        if mesh.face_labels is not None:
            of_faces = of_faces + count * (mesh.face_labels + 1)
        of_faces = np.unique(of_faces, return_inverse=True)[1].reshape(-1)
        if of_faces.max() >= _MOST:
            of_faces = np.zeros_like(of_faces)
        low, high = (np.full((int(of_faces.max()) + 1, 3), side) for side in (np.inf, -np.inf))
        np.minimum.at(low, of_faces, mesh.triangles.min(axis=1))
        np.maximum.at(high, of_faces, mesh.triangles.max(axis=1))
        return cls(mesh, of_faces, low, high, components, _is_closed(corners))

    def faces(self, pieces: Sequence[int] | Ints) -> Ints:
        """The faces of some pieces, as indices."""
        order, starts = self._by_piece
        return np.concatenate([np.empty(0, np.int64), *(order[starts[i] : starts[i + 1]] for i in pieces)])

    @cached_property
    def counts(self) -> Ints:
        """(P,): the number of faces of each piece."""
        return np.bincount(self.of_faces, minlength=len(self))

    @cached_property
    def _by_piece(self) -> tuple[Ints, Ints]:
        """The faces, piece by piece, and where each piece begins among them."""
        return np.argsort(self.of_faces, kind="stable"), np.concatenate([[0], np.cumsum(self.counts)])

    def bounds(self, pieces: Sequence[int] | Ints) -> Floats:
        """(2, 3): around some pieces, at least one."""
        rows = np.asarray(pieces)
        return np.stack([self.low[rows].min(axis=0), self.high[rows].max(axis=0)])

    def names(self, pieces: Sequence[int] | Ints) -> tuple[str, ...]:
        """The labels of some pieces, each once."""
        labels = self.mesh.face_labels
        if labels is None:
            return ()
        found = np.unique(labels[self.faces(pieces)])
        return tuple(self.mesh.label_names[i] for i in found if i >= 0)

    def clusters(self, pieces: Ints, gap: float) -> list[Ints]:
        """Pieces that are nearer to one another than a gap, in units of the largest extent, together; largest first.

        It goes by cells of half a gap: pieces that are .5 to 1.5 gaps apart may count as near or not.
        """
        points, owner = self._points(pieces, gap / 2.0)
        keys, cell = np.unique(_keys(points, gap / 2.0), return_inverse=True)
        places = np.column_stack(np.unravel_index(keys, (_CELLS,) * 3))
        near = cKDTree(places).query_pairs(_NEAR_CELLS, output_type="ndarray") + len(pieces)
        links = np.concatenate([np.column_stack([owner, cell + len(pieces)]), near])
        _, cluster = _connected(len(pieces) + len(places), links[:, 0], links[:, 1])
        number = np.unique(cluster[: len(pieces)], return_inverse=True)[1].reshape(-1)
        found = [pieces[number == n] for n in range(int(number.max()) + 1)]
        return sorted(found, key=lambda some: -float(np.ptp(self.bounds(some), axis=0).max()))

    def _points(self, pieces: Ints, spacing: float) -> tuple[Floats, Ints]:
        """Points on some pieces, no further apart than a spacing, and the index of the piece of each."""
        chosen = np.isin(self.of_faces, pieces)
        triangles, owner = self.mesh.triangles[chosen], np.searchsorted(pieces, self.of_faces[chosen])
        found, owners = [triangles.reshape(-1, 3)], [np.repeat(owner, 3)]
        while len(triangles):
            sides = np.linalg.norm(triangles - np.roll(triangles, -1, axis=1), axis=2)
            large = sides.max(axis=1) > spacing
            triangles, owner, sides = triangles[large], owner[large], sides[large]
            if not len(triangles):
                break
            longest = sides.argmax(axis=1)
            rows = np.arange(len(triangles))
            a, b, c = (triangles[rows, (longest + k) % 3] for k in range(3))
            middle = (a + b) / 2.0
            found.append(middle)
            owners.append(owner)
            triangles = np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])
            owner = np.concatenate([owner, owner])
        return np.concatenate(found), np.concatenate(owners)


def _is_closed(corners: Ints) -> bool:
    """Whether faces (F, 3) of places share each edge; those with an edge of no length count by the others."""
    ends = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    edges = ends[ends[:, 0] != ends[:, 1]]
    counts = np.unique(edges[:, 0] * (int(corners.max()) + 1) + edges[:, 1], return_counts=True)[1]
    return bool((counts > 1).all())


def _keys(points: Floats, side: float) -> Ints:
    """A number for the cell of each point (N, 3) of a normalised mesh, (N,). side: of a cell."""
    cells = np.clip((points + 0.5) / side, 0, _CELLS - 1).astype(np.int64)
    return np.asarray((cells[:, 0] * _CELLS + cells[:, 1]) * _CELLS + cells[:, 2])


def _connected(count: int, first: Ints, second: Ints) -> tuple[int, Ints]:
    links = coo_matrix((np.ones(len(first), dtype=np.int8), (first, second)), shape=(count, count))
    number, component = connected_components(links, directed=False)
    return int(number), component.astype(np.int64)
