"""Shapes: a triangle mesh with labels (3D), a drawing of filled regions (2D), points; and their normalisation."""

from shapewright.shapes.arrays import Bytes, Floats, Ints, Transform
from shapewright.shapes.drawing import Drawing
from shapewright.shapes.mesh import Mesh, concatenate
from shapewright.shapes.points import Points
from shapewright.shapes.shape import ReferenceShape, Shape, extent_of, shape_digest

__all__ = [
    "Bytes",
    "Drawing",
    "Floats",
    "Ints",
    "Mesh",
    "Points",
    "ReferenceShape",
    "Shape",
    "Transform",
    "concatenate",
    "extent_of",
    "shape_digest",
]
