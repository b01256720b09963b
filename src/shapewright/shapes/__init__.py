"""Shapes: triangle meshes with labels (3D), drawings of filled regions (2D), points, views of objects; and their
normalisation."""

from shapewright.shapes.arrays import Bytes, Floats, Ints, Transform
from shapewright.shapes.drawing import Drawing
from shapewright.shapes.mesh import Mesh, concatenate
from shapewright.shapes.points import Points
from shapewright.shapes.shape import ReferenceShape, Shape, extent_of, shape_digest
from shapewright.shapes.views import View, Views

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
    "View",
    "Views",
    "concatenate",
    "extent_of",
    "shape_digest",
]
