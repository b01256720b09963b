"""The labelled parts of a replica where they stand when it is laid over its reference."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapewright.feedback.surfaces.connection import connected
from shapewright.feedback.surfaces.residuals import Residuals
from shapewright.shapes import Floats, Ints

_WELDED = 6  # digits of coordinates that make two corners one


@dataclass(frozen=True, eq=False)
class Part:
    """All that one label names. Places are in the frame of the normalised reference."""

    label: str
    bounds: Floats  # (2, 3), around all of it
    pieces: Floats  # (K, 2, 3), around each connected piece
    points: Floats  # (N, 3), on its surface where that can be seen; may be empty


def parts_of(residuals: Residuals) -> tuple[Part, ...]:
    """The parts of the replica, in the order of its labels; empty where nothing is labelled."""
    mesh = residuals.mesh
    if mesh.face_labels is None:
        return ()
    vertices = residuals.placement.apply(mesh.vertices)
    surface, parts = residuals.replica, []
    of_points = mesh.face_labels[surface.faces]
    for number, label in enumerate(mesh.label_names):
        faces = mesh.faces[mesh.face_labels == number]
        if len(faces):
            pieces = _pieces(vertices, faces)
            bounds = np.stack([pieces[:, 0].min(axis=0), pieces[:, 1].max(axis=0)])
            parts.append(Part(label, bounds, pieces, surface.points[surface.visible & (of_points == number)]))
    return tuple(parts)


def _pieces(vertices: Floats, faces: Ints) -> Floats:
    """(K, 2, 3): the boxes of connected faces, by corners that coincide."""
    used, corners = np.unique(faces, return_inverse=True)
    _, welded = np.unique(np.round(vertices[used], _WELDED), axis=0, return_inverse=True)
    joined = welded.reshape(-1)[corners.reshape(faces.shape)]
    count, component = connected(int(joined.max()) + 1, joined[:, :2].ravel(), joined[:, 1:].ravel())
    of_face = component[joined[:, 0]]
    boxes = []
    for number in range(count):
        some = vertices[faces[of_face == number]].reshape(-1, 3)
        if len(some):
            boxes.append(np.stack([some.min(axis=0), some.max(axis=0)]))
    return np.array(boxes)
