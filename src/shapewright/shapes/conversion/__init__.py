"""What an author's function may return, turned into our Mesh or Drawing."""

from shapewright.shapes.conversion.conversion import as_reference, as_shape
from shapewright.shapes.conversion.parts import Colour, Part
from shapewright.shapes.conversion.registry import register

__all__ = ["Colour", "Part", "as_reference", "as_shape", "register"]
