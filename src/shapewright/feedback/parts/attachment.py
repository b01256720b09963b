"""Whether what belongs together hangs together: pieces on what stands, a shape's components on each other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shapewright.comparison.surfaces import area, sample
from shapewright.feedback.parts.pieces import Piece
from shapewright.feedback.surfaces.connection import connected
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.shapes import Floats, Mesh

# Where nothing else is said, chosen on seed 0 of benchmarks/suggestions.py.
_POINTS, _FEW = 1000, 300  # of what stands; of a component
_REACH = 0.05  # of the whole's largest extent: between a piece's box and what it hangs on to
_GAP = 0.02  # of the same, between components: nobody sees it, and an author closes it


def loose(pieces: Sequence[Piece], standing: Sequence[Mesh]) -> int:
    """How many of the pieces no chain of touching pieces connects to what stands.

    Where nothing stands, one piece has to hold the others. A mirrored piece counts as attached when one of its copies
    is.
    """
    if not pieces:
        return 0
    extents = [np.ptp([[p.low, p.high] for p in pieces], axis=(0, 1)), *(mesh.extent for mesh in standing)]
    reach = _REACH * float(np.max(extents))
    points = [sample(mesh, _POINTS).points for mesh in standing if area(mesh) > 0.0]
    held = {i for i, piece in enumerate(pieces) if any(_touches(piece, some, reach) for some in points)}
    if not points:
        held = {0}
    todo = list(held)
    while todo:
        piece = pieces[todo.pop()]
        more = [i for i, other in enumerate(pieces) if i not in held and _gap(piece, other) < reach]
        held |= set(more)
        todo += more
    return len(pieces) - len(held)


def separate(mesh: Mesh) -> int:
    """Into how many pieces a shape falls, where narrow gaps do not count."""
    mesh = mesh.normalised()
    parts = _components(mesh)
    if len(parts) <= 1:
        return 1
    surfaces = [VisibleSurface.roughly(part, _FEW) for part in parts]
    first, second = np.triu_indices(len(parts), 1)
    near = [_apart(parts[i], surfaces[i], parts[j], surfaces[j]) < _GAP for i, j in zip(first, second, strict=True)]
    return connected(len(parts), first[near], second[near])[0]


def _components(mesh: Mesh) -> list[Mesh]:
    """Connected pieces, by vertices that coincide."""
    _, index = np.unique(np.round(mesh.vertices, 6), axis=0, return_inverse=True)
    faces = index.reshape(-1)[mesh.faces]
    _, component = connected(len(index), faces[:, :2].ravel(), faces[:, 1:].ravel())
    of_face = component[faces[:, 0]]
    parts = [Mesh(mesh.vertices, mesh.faces[of_face == number]) for number in np.unique(of_face)]
    return [part for part in parts if area(part) > 0.0]


def _apart(a: Mesh, on_a: VisibleSurface, b: Mesh, on_b: VisibleSurface) -> float:
    corners = np.unique(a.faces), np.unique(b.faces)
    return min(float(on_b.distance(a.vertices[corners[0]]).min()), float(on_a.distance(b.vertices[corners[1]]).min()))


def _touches(piece: Piece, points: Floats, reach: float) -> bool:
    """Whether one of the piece's copies is so near to one of the points."""
    aside = [np.maximum(np.maximum(copy.low - points, points - copy.high), 0.0) for copy in piece.copies]
    return bool((np.square(aside).sum(axis=2) < reach**2).any())


def _gap(a: Piece, b: Piece) -> float:
    """Between the boxes of two pieces, the nearest of their copies."""
    pairs = [(one, other) for one in a.copies for other in b.copies]
    apart = [np.maximum(np.maximum(one.low - other.high, other.low - one.high), 0.0) for one, other in pairs]
    return float(np.linalg.norm(apart, axis=1).min())
