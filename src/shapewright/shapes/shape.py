"""A shape is a mesh or a drawing."""

from __future__ import annotations

import hashlib

import numpy as np

from shapewright.shapes.drawing import Drawing
from shapewright.shapes.mesh import Mesh

Shape = Mesh | Drawing


def shape_digest(shape: Shape) -> str:
    """A key for the geometry alone: equal vertices and faces, or equal drawings, have equal digests."""
    if isinstance(shape, Drawing):
        content = shape.geometry.wkb
    else:
        content = np.int64(len(shape.vertices)).tobytes() + shape.vertices.tobytes() + shape.faces.tobytes()
    return hashlib.blake2b(content, digest_size=16).hexdigest()
