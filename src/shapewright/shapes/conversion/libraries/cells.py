"""meshio's meshes, as pygmsh makes them: faces, or volumes whose outer faces count."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from shapewright.shapes.arrays import Ints
from shapewright.shapes.conversion.tables import mesh_of

_FACES = ("triangle", "quad", "polygon")
_OF_VOLUMES = {
    "tetra": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)),
    "hexahedron": ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
    "wedge": ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    "pyramid": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
}
"""Corners of the faces of each kind of cell, seen from outside (the VTK file format, "Cell types")."""


def convert(value: Any) -> Any:
    """The mesh of its faces; where it has volumes, of their faces that belong to one volume alone."""
    volumes = [face for block in value.cells if block.type in _OF_VOLUMES for face in _faces(block)]
    if volumes:
        seen: dict[tuple[int, ...], list[int]] = {}
        for face in volumes:
            key = tuple(sorted(face))
            seen[key] = [] if key in seen else face
        return mesh_of(value.points, [face for face in seen.values() if face])
    faces = [list(map(int, row)) for block in value.cells if block.type in _FACES for row in block.data]
    if not faces:
        kinds = ", ".join(block.type for block in value.cells) or "none"
        raise ValueError(f"the mesh has no faces that are read, of cells it has {kinds}; make triangles or quads")
    points = np.asarray(value.points, dtype=np.float64)
    return mesh_of(np.pad(points, ((0, 0), (0, 3 - points.shape[1]))), faces)


def _faces(block: Any) -> Iterator[list[int]]:
    cells: Ints = np.asarray(block.data)
    for cell in cells:
        for corners in _OF_VOLUMES[block.type]:
            yield [int(cell[corner]) for corner in corners]
