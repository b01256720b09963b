"""Meshes of the libraries that show and measure them: pyvista, vedo and Open3D."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from shapewright.shapes.arrays import Ints
from shapewright.shapes.conversion.naming import refusal
from shapewright.shapes.conversion.parts import Colour, Part
from shapewright.shapes.conversion.tables import array, mesh_of


def convert(value: Any) -> Any:
    """The mesh, or the parts by their names."""
    library = next(kind.__module__ for kind in type(value).__mro__ if kind.__module__ != "builtins").partition(".")[0]
    package = library if library in _BY_LIBRARY else _library(value)
    return _BY_LIBRARY[package](value)


def _library(value: Any) -> str:
    """That of a class which this one extends."""
    packages = (kind.__module__.partition(".")[0] for kind in type(value).__mro__)
    return next(package for package in packages if package in _BY_LIBRARY)


def _pyvista(value: Any) -> Any:
    """Of a MultiBlock the blocks by name; of a grid its surface."""
    if hasattr(value, "n_blocks"):
        return [Part(block, name) for name, block in zip(value.keys(), value, strict=True) if block is not None]
    surface = value if hasattr(value, "n_strips") else value.extract_surface(algorithm="dataset_surface")
    if surface.n_strips:
        surface = surface.triangulate()
    return mesh_of(surface.points, list(_runs(np.asarray(surface.faces))))


def _runs(faces: Ints) -> Iterator[Ints]:
    """Faces of VTK: each begins with the number of its corners."""
    at = 0
    while at < len(faces):
        yield faces[at + 1 : at + 1 + faces[at]]
        at += 1 + int(faces[at])


def _vedo(value: Any) -> Any:
    if callable(getattr(value, "unpack", None)):
        return list(value.unpack())
    if not len(getattr(value, "cells", ())):
        raise refusal(value, "it has no faces; return a vedo.Mesh")
    red, green, blue = (float(x) for x in value.color())
    name = value.name if value.name not in ("", type(value).__name__) else None
    faces = [list(map(int, cell)) for cell in value.cells]
    return Part(mesh_of(np.asarray(value.vertices), faces), name, (red, green, blue, float(value.alpha())))


def _open3d(value: Any) -> Any:
    if hasattr(value, "vertex") and hasattr(value, "triangle"):  # of open3d.t
        return mesh_of(value.vertex.positions.cpu().numpy(), value.triangle.indices.cpu().numpy())
    if not hasattr(value, "triangles"):
        raise refusal(value, "it has no triangles; return an open3d.geometry.TriangleMesh")
    mesh = mesh_of(array(value.vertices), array(value.triangles))
    colour: Colour | None = None
    if value.has_vertex_colors():
        red, green, blue = (float(x) for x in np.median(array(value.vertex_colors), axis=0))
        colour = (red, green, blue, 1.0)
    return Part(mesh, None, colour)


_BY_LIBRARY = {"pyvista": _pyvista, "vedo": _vedo, "open3d": _open3d}
