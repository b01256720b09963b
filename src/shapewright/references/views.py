"""Pictures of objects among the files of a collection: their masks, and which of them show the same object."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal, TypeAlias

from shapewright.references.reference import Reference
from shapewright.references.sources import Source, natural_key
from shapewright.shapes import Views

Pictures: TypeAlias = Literal["drawings", "views"]
"""What pictures are: drawings of a procedure of drawings, or views of objects that a procedure of meshes makes."""


def as_views(sources: Sequence[Source]) -> list[Source]:
    """The same files, pictures to be read as views."""
    return [replace(source, view=True) for source in sources]


def joined(sources: Sequence[Source], references: Sequence[Reference]) -> list[Reference]:
    """One reference an object, in natural order of their names: views that show the same one are joined.

    sources: of each reference. A view of no named object is a reference of its own.
    """
    objects: dict[str, list[Reference]] = {}
    for source, reference in zip(sources, references, strict=True):
        objects.setdefault(source.object or reference.name, []).append(reference)
    return [_object(name, objects[name]) for name in sorted(objects, key=natural_key)]


def _object(name: str, views: Sequence[Reference]) -> Reference:
    shapes = [view.shape for view in views if isinstance(view.shape, Views)]
    if len(views) == 1 or len(shapes) < len(views):
        return replace(views[0], name=name)
    notes = tuple(dict.fromkeys(note for view in views for note in view.notes))
    shown = Views(tuple(view for shape in shapes for view in shape.views))
    return replace(views[0], name=name, shape=shown, notes=notes)
