"""How refusals call what a function returned, and the way out that they name."""

from __future__ import annotations

from typing import Any

_ACCEPTED = (
    "a Mesh, Drawing, Solid or Sketch, (vertices, faces), a trimesh.Trimesh or Scene, a manifold3d.Manifold or "
    "CrossSection, a shapely geometry, a CadQuery, build123d, pyvista, vedo, Open3D or meshio object, a list of these, "
    "or a dict of them by name; for a class of your own write a method __shapewright__() that returns one of them"
)


def called(value: Any) -> str:
    """The class of an object, with its module."""
    return f"{type(value).__module__}.{type(value).__qualname__}".removeprefix("builtins.")


def refusal(value: Any, way_out: str | None = None) -> TypeError:
    """The error for an object that stands for no shape. way_out: what to return instead; by default what there is."""
    return TypeError(f"it returned {called(value)}; {way_out or f'return {_ACCEPTED}'}")
