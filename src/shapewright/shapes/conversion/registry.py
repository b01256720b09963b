"""Which function converts the objects of which library: by the package of the object's class or of one it extends."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any, TypeAlias

Converter: TypeAlias = Callable[[Any], Any]
"""Gives for an object something else that a procedure may return: ``(vertices, faces)``, a Mesh, a dict of parts."""

_OURS = {
    "OCP": "libraries.kernel",
    "build123d": "libraries.build123d",
    "cadquery": "libraries.cadquery",
    "geopandas": "polygons",
    "manifold3d": "libraries.manifold",
    "meshio": "libraries.cells",
    "open3d": "libraries.viewers",
    "pyvista": "libraries.viewers",
    "scene_synthesizer": "libraries.scenes",
    "shapely": "polygons",
    "shapewright": "libraries.own",
    "trimesh": "libraries.trimesh",
    "vedo": "libraries.viewers",
}
"""Modules of this room whose ``convert`` is for the objects of a package; each is loaded when it is first needed."""
_registered: dict[str, Converter] = {}


def register(package: str) -> Callable[[Converter], Converter]:
    """Say how the objects of a package become shapes: ``@register("mylib")`` above a function of one object.

    What the function returns is converted in turn. It stands in the procedure's file or in what that imports, since
    every worker process loads that anew. It goes before what shapewright knows of the package.

    Args:
        package: the first names of the module of the objects' class, ``"mylib"`` or ``"mylib.solids"``.
    """

    def keep(converter: Converter) -> Converter:
        _registered[package] = converter
        return converter

    return keep


def converter_of(value: Any) -> Converter | None:
    """What converts an object: the function registered for the longest first names of the module of its class, or else
    of the classes that this one extends, in their order; None where nobody knows."""
    for kind in type(value).__mro__:
        package = kind.__module__
        while package:
            if package in _registered:
                return _registered[package]
            if package in _OURS:
                module = import_module(f"{__package__}.{_OURS[package]}")
                converter: Converter = module.convert
                return converter
            package = package.rpartition(".")[0]
    return None
