"""CadQuery's workplanes, shapes, assemblies and sketches."""

from __future__ import annotations

import re
from typing import Any

from shapewright.shapes.conversion.naming import refusal
from shapewright.shapes.conversion.parts import Part

_NO_NAME = re.compile(r"[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}")
"""Names that CadQuery gives to assemblies without one."""
_LINES = "extrude it with .extrude(height), or draw it as a cq.Sketch, which has an area"


def convert(value: Any) -> Any:
    """The parts of an assembly by their names; the kernel's shape of anything else.

    Raises TypeError for lines, and for a workplane that stands at a face or a point of a solid.
    """
    import cadquery

    if isinstance(value, cadquery.Assembly):
        return _assembly(value)
    if isinstance(value, cadquery.Sketch):
        faces = [item for item in value if item.ShapeType() == "Face"]
        if not faces:
            raise refusal(value, f"it holds no area; {_CLOSE}" if list(value) else "it is empty")
        return [face.wrapped for face in faces]
    if isinstance(value, cadquery.Workplane):
        return _workplane(value, cadquery)
    if isinstance(value, cadquery.Edge | cadquery.Wire | cadquery.Vertex):
        raise refusal(value, _LINES)
    if isinstance(value, cadquery.Shape):
        return value.wrapped
    raise refusal(value)


_CLOSE = "close its edges and add .assemble(), or give them a width with .offset()"


def _assembly(assembly: Any) -> list[Part]:
    parts = []
    for shape, path, place, colour in assembly:
        steps = [step for step in path.split("/")[1:] if not _NO_NAME.fullmatch(step)]
        name = "/".join(steps) or (assembly.name if not _NO_NAME.fullmatch(assembly.name) else None)
        parts.append(Part(shape.wrapped.Moved(place.wrapped), name, colour.toTuple() if colour else None))
    if not parts:
        raise ValueError("the shape is empty: the assembly holds no parts")
    return parts


def _workplane(value: Any, cadquery: Any) -> Any:
    held = value.vals()
    solid = _solid_before(value)
    if held and all(isinstance(item, cadquery.Sketch) for item in held):
        return held
    shapes = [item for item in held if isinstance(item, cadquery.Shape)]
    if not shapes:
        raise refusal(
            value,
            f"it holds a place, no shape; {_RETURN_SOLID}"
            if solid
            else "it holds no shape; add one, for example .box(1, 1, 1)",
        )
    if all(isinstance(item, cadquery.Face) for item in shapes) and solid:
        raise refusal(value, f"it stands at a face of a solid; {_RETURN_SOLID}")
    if all(isinstance(item, cadquery.Edge | cadquery.Wire | cadquery.Vertex) for item in shapes):
        raise refusal(
            value, f"it stands at edges of a solid; {_RETURN_SOLID}" if solid else f"it holds lines; {_LINES}"
        )
    return shapes[0].wrapped if len(shapes) == 1 else [item.wrapped for item in shapes]


_RETURN_SOLID = "return the solid: end the chain with .end(), or .findSolid()"


def _solid_before(value: Any) -> bool:
    """Whether a solid stands earlier in the chain."""
    try:
        return value.findSolid() is not None
    except ValueError:
        return False
