"""Drawings in SVG files: what they paint dark, as an area."""

from shapewright.references.readers.svg.reader import read_svg

__all__ = ["read_svg"]
