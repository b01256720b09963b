"""scene_synthesizer's assets and scenes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from shapewright.shapes.conversion.libraries import trimesh
from shapewright.shapes.conversion.naming import refusal
from shapewright.shapes.conversion.parts import Part

_OBJECT = "object"
"""The name that an asset gets in its own scene, which stands before the names of its parts."""


def convert(value: Any) -> Any:
    """The parts of an asset as it is seen, with their names; of a scene all that is in it, posed as it is."""
    if not callable(getattr(value, "as_trimesh_scene", None)):
        if hasattr(inner := getattr(value, "scene", None), "graph"):
            return trimesh.convert(inner)
        raise refusal(value)
    parts = trimesh.convert(value.as_trimesh_scene(namespace=_OBJECT, use_collision_geometry=False))
    return [replace(part, name=_own(part)) for part in parts]


def _own(part: Part) -> str | None:
    return trimesh.named((part.name or "").removeprefix(f"{_OBJECT}/"))
