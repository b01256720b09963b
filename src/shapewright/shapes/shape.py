"""A shape is a mesh or a drawing."""

from __future__ import annotations

from shapewright.shapes.drawing import Drawing
from shapewright.shapes.mesh import Mesh, mesh_digest

Shape = Mesh | Drawing


def shape_digest(shape: Shape) -> str:
    """A key for the geometry alone, of a mesh or a drawing."""
    import hashlib

    if isinstance(shape, Mesh):
        return mesh_digest(shape)
    return hashlib.blake2b(shape.geometry.wkb, digest_size=16).hexdigest()
