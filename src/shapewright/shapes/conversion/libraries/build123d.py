"""build123d's parts, compounds with children, sketches, lists and builders."""

from __future__ import annotations

from typing import Any

from shapewright.shapes.conversion.naming import refusal
from shapewright.shapes.conversion.parts import Part

_LINES = "give it a width with trace(line, line_width=...), or make a face of a closed one with make_face(line)"


def convert(value: Any) -> Any:
    """What a builder has built, the items of a list, the labelled children of a compound, or the kernel's shape.

    Raises TypeError for lines and points, ValueError for what holds nothing.
    """
    import build123d

    if isinstance(value, list):
        return list(value)
    if isinstance(value, build123d.Builder):
        return _built(value)
    if not isinstance(value, build123d.Shape):
        raise refusal(value)
    if isinstance(value, build123d.Curve | build123d.Edge | build123d.Wire | build123d.Vertex):
        raise refusal(value, _LINES)
    if value.children:
        parts = [_part(child, value.wrapped.Location()) for child in value.children]
        return Part(parts, None if any(_has_name(child) for child in value.children) else value.label or None)
    return _part(value)


def _built(builder: Any) -> Any:
    made = next((getattr(builder, name) for name in ("part", "sketch", "line") if hasattr(builder, name)), None)
    if made is None:
        raise ValueError(f"the shape is empty: the {type(builder).__name__} has built nothing")
    return made


def _part(shape: Any, place: Any = None) -> Part:
    """A shape and its children where they stand. place: the kernel's location of what holds it."""
    if shape.wrapped is None:
        raise ValueError("the shape is empty: its operations leave nothing")
    colour = None if shape.color is None else tuple(shape.color)
    located = shape.wrapped if place is None else shape.wrapped.Moved(place)
    inside = [_part(child, located.Location()) for child in shape.children]
    return Part(inside or located, shape.label or None, colour)


def _has_name(shape: Any) -> bool:
    return bool(shape.label) or any(_has_name(child) for child in shape.children)
