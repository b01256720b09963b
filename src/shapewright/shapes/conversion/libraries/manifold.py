"""manifold3d's solids, their meshes, and its cross-sections."""

from __future__ import annotations

from typing import Any

import numpy as np

from shapewright.shapes.conversion.naming import refusal
from shapewright.shapes.conversion.polygons import rings
from shapewright.shapes.conversion.tables import mesh_of


def convert(value: Any) -> Any:
    """The mesh of a Manifold or Mesh, the drawing of a CrossSection."""
    if callable(getattr(value, "to_polygons", None)):
        return rings(value.to_polygons())
    mesh = value.to_mesh() if callable(getattr(value, "to_mesh", None)) else value
    if not hasattr(mesh, "vert_properties"):
        raise refusal(value)
    return mesh_of(np.asarray(mesh.vert_properties)[:, :3], mesh.tri_verts)
