"""trimesh's meshes, scenes, paths and voxels."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from shapewright.shapes.arrays import Bytes
from shapewright.shapes.conversion.naming import refusal
from shapewright.shapes.conversion.parts import Part
from shapewright.shapes.conversion.polygons import rings
from shapewright.shapes.conversion.tables import mesh_of
from shapewright.shapes.mesh import Mesh

_NO_NAME = re.compile(r"geometry_\d+(_\d+)*")
"""Names that trimesh gives to what has none."""
_COLOURS = 64
"""Most different colours of one mesh that are kept face by face; more are a picture, of which the commonest stays."""


def convert(value: Any) -> Any:
    """A mesh with its name and colours, the parts of a scene by names of nodes, the drawing of closed paths."""
    if hasattr(value, "graph") and hasattr(value, "geometry"):
        return _parts_of(value)
    if hasattr(value, "faces") and hasattr(value, "vertices"):
        return Part(_mesh(value), named(value.metadata.get("name")))
    if hasattr(value, "polygons_closed"):
        if not len(closed := [each for each in value.polygons_closed if each is not None]):
            raise refusal(value, "none of its outlines is closed; close them, or draw lines with a width")
        return rings(np.asarray(polygon.exterior.coords) for polygon in closed)
    if callable(getattr(value, "as_boxes", None)):
        return value.as_boxes()
    raise refusal(value)


def _parts_of(scene: Any) -> list[Part]:
    parts = list(_nodes(scene))
    if not parts:
        raise ValueError("the shape is empty: the scene holds no meshes")
    return parts


def _nodes(scene: Any) -> Iterator[Part]:
    for node in scene.graph.nodes_geometry:
        matrix, name = scene.graph[node]
        geometry = scene.geometry[name]
        if not hasattr(geometry, "faces"):
            continue
        mesh = _mesh(geometry).transformed(matrix)
        if np.linalg.det(matrix[:3, :3]) < 0.0:
            mesh = replace(mesh, faces=mesh.faces[:, ::-1])
        yield Part(mesh, named(str(node)))


def named(name: Any) -> str | None:
    """The name of a part; None where trimesh made it up."""
    return name if isinstance(name, str) and name and not _NO_NAME.fullmatch(name) else None


def _mesh(value: Any) -> Mesh:
    mesh = mesh_of(value.vertices, value.faces)
    return replace(mesh, face_colours=_colours(value.visual, len(mesh.faces)))


def _colours(visual: Any, count: int) -> Bytes | None:
    """(F, 4) uint8; None of a mesh without colours."""
    if visual is None or not visual.defined:
        return None
    if visual.kind == "face" and len(visual.face_colors) == count:
        rows = np.asarray(visual.face_colors, dtype=np.uint8)
        if len(np.unique(rows, axis=0)) <= _COLOURS:
            return rows
    main = visual.main_color if hasattr(visual, "main_color") else visual.material.main_color
    return np.tile(np.asarray(main, dtype=np.uint8), (count, 1))
