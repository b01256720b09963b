"""A shape is a mesh or a drawing; a reference may be points, or views of an object."""

from __future__ import annotations

import hashlib

import numpy as np

from shapewright.shapes.drawing import Drawing
from shapewright.shapes.mesh import Mesh
from shapewright.shapes.points import Points
from shapewright.shapes.views import Views

Shape = Mesh | Drawing
"""What procedures make."""
ReferenceShape = Mesh | Drawing | Points | Views
"""What references are."""


def extent_of(shape: ReferenceShape) -> float:
    """The longest side of its bounding box."""
    return float((shape.bounds[1] - shape.bounds[0]).max())


def shape_digest(shape: ReferenceShape) -> str:
    """A key for the geometry alone: of vertices and faces, drawing, points with what is known of each, or masks."""
    if isinstance(shape, Drawing):
        content = shape.geometry.wkb
    elif isinstance(shape, Points):
        tables = {"normals": shape.normals, "seen from": shape.seen_from}
        known = b"".join(name.encode() + rows.tobytes() for name, rows in tables.items() if rows is not None)
        content = b"points" + shape.positions.tobytes() + known
    elif isinstance(shape, Views):
        content = b"views" + b"".join(view.mask.tobytes() for view in shape.views)
    else:
        content = np.int64(len(shape.vertices)).tobytes() + shape.vertices.tobytes() + shape.faces.tobytes()
    return hashlib.blake2b(content, digest_size=16).hexdigest()
