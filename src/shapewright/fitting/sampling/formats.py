"""The formats in which samples are written."""

from __future__ import annotations

from typing import Literal, TypeAlias

from shapewright.shapes.files import Format

FileFormat: TypeAlias = Literal["glb", "ply", "obj", "stl", "off", "wds"]
"""Formats of meshes, each a file for itself; wds: tars of GLB or SVG files, each beside a JSON of what it is."""


def shape_format(format: FileFormat) -> Format:
    """In which format each mesh is."""
    return "glb" if format == "wds" else format
