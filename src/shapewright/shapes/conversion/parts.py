"""A part of what a function returns, with its name and colour; and what becomes of them in a mesh."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np

from shapewright.shapes.mesh import Mesh

Colour: TypeAlias = tuple[float, float, float, float]
"""Red, green, blue and opacity, sRGB, 0 to 1."""


@dataclass(frozen=True, eq=False)
class Part:
    """A part of a shape.

    Attributes:
        value: anything that a procedure may return; a list of parts as well.
        name: becomes the label of its faces; before the labels that they have already, it stands as ``name/label``.
        colour: of those of its faces that have none.
    """

    value: Any
    name: str | None = None
    colour: Colour | None = None

    def dressed(self, mesh: Mesh) -> Mesh:
        """The mesh of the value, with this name and colour."""
        return coloured(named(mesh, self.name) if self.name else mesh, self.colour)


def named(mesh: Mesh, name: str) -> Mesh:
    """The mesh with this label, before those that it has."""
    if mesh.face_labels is None:
        return mesh.label(name)
    unlabelled = mesh.face_labels < 0
    names = tuple(f"{name}/{label}" for label in mesh.label_names)
    if not unlabelled.any():
        return replace(mesh, label_names=names)
    labels = np.where(unlabelled, len(names), mesh.face_labels)
    return replace(mesh, face_labels=labels, label_names=(*names, name))


def coloured(mesh: Mesh, colour: Colour | None) -> Mesh:
    """The mesh with this colour where it has none."""
    if colour is None:
        return mesh
    row = np.round(np.clip(colour, 0.0, 1.0) * 255.0).astype(np.uint8)
    if mesh.face_colours is None:
        return replace(mesh, face_colours=np.tile(row, (len(mesh.faces), 1)))
    bare = mesh.face_colours[:, 3:] == 0
    return replace(mesh, face_colours=np.where(bare, row, mesh.face_colours))
