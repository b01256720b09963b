"""The meshes of an FBX file in their own frames, with their blend shapes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.fbx.document import Document, Object
from shapewright.references.readers.fbx.nodes import Node
from shapewright.references.readers.polygons import Polygons, check_indices, triangulate
from shapewright.shapes import Floats, Ints

_FULL = 100.0
"""The weight, in percent, at which a blend shape that does not tell it stands as it is written."""


@dataclass(frozen=True, eq=False)
class Geometry:
    """A mesh in its own frame.

    Attributes:
        key: the object that it is written in.
        vertices: (V, 3).
        faces: (F, 3).
        materials: (F,), the number of the material of each face, among those of the model that shows the mesh.
    """

    key: Object
    vertices: Floats
    faces: Ints
    materials: Ints


def is_mesh(shape: Object) -> bool:
    """Whether an object has points and polygons."""
    return shape.node.child("Vertices") is not None and shape.node.child("PolygonVertexIndex") is not None


def read_geometry(document: Document, shape: Object) -> Geometry:
    """The mesh that an object tells, blended as the file does. Raises UnreadableError, with the reason."""
    vertices = shape.node.points("Vertices")
    corners = shape.node.integers("PolygonVertexIndex")
    last = corners < 0
    if len(corners) and not last[-1]:
        raise UnreadableError("broken: its last polygon has no end")
    ends = np.flatnonzero(last)
    counts = np.diff(ends, prepend=-1)
    corners = np.where(last, ~corners, corners)
    check_indices(corners, len(vertices))
    hole = _holes(shape, len(counts))
    materials = _materials(shape, len(counts))[~hole]
    corners, counts = corners[np.repeat(~hole, counts)], counts[~hole]
    vertices = vertices + _blended(document, shape, len(vertices))
    faces = triangulate(Polygons(vertices, corners, counts))
    return Geometry(shape, vertices, faces, np.repeat(materials, np.maximum(counts - 2, 0)))


def _holes(shape: Object, count: int) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Which polygons are holes: (count,)."""
    found = np.zeros(count, dtype=bool)
    layer = shape.node.child("LayerElementHole")
    if layer is not None:
        told = layer.integers("Hole")[:count] != 0
        found[: len(told)] = told
    return found


def _materials(shape: Object, count: int) -> Ints:
    """The number of the material of each polygon: (count,)."""
    layer = shape.node.child("LayerElementMaterial")
    told = np.empty(0, dtype=np.int64) if layer is None else layer.integers("Materials")
    return told if len(told) == count else np.full(count, told[0] if len(told) else 0)


def _blended(document: Document, shape: Object, count: int) -> Floats:
    """By how much blend shapes move the vertices: (count, 3)."""
    moved = np.zeros((count, 3))
    for blend in document.below(shape.key, "Deformer", "BlendShape"):
        for channel in document.below(blend.key, "Deformer", "BlendShapeChannel"):
            targets = [each.node for each in document.below(channel.key, "Geometry", "Shape")]
            told = channel.node.floats("DeformPercent")
            weight = channel.number("DeformPercent", float(told[0]) if len(told) else 0.0)
            if not targets or not weight:
                continue
            full = channel.node.floats("FullWeights")
            if len(targets) == 1 and len(full) > 1:  # Blender writes there how much each vertex moves
                _move(moved, targets[0], weight / _FULL * full / _FULL)
                continue
            full = np.concatenate([full, np.full(max(0, len(targets) - len(full)), _FULL)])[: len(targets)]
            for target, share in zip(targets, shares(weight, full), strict=True):
                if share:
                    _move(moved, target, share)
    for target in shape.node.children("Shape"):  # as files before version 7.2 have them
        if share := shape.number(target.text(0), 0.0) / _FULL:
            _move(moved, target, share)
    return moved


def _move(moved: Floats, target: Node, share: float | Floats) -> None:
    indices, steps = target.integers("Indexes"), target.points("Vertices")
    if len(indices) != len(steps) or np.size(share) not in (1, len(steps)):
        raise UnreadableError(f"broken: a blend shape of {len(indices)} vertices and {len(steps)} steps")
    check_indices(indices, len(moved))
    np.add.at(moved, indices, np.reshape(share, (-1, 1)) * steps)


def shares(weight: float, full: Floats) -> Floats:
    """How much each of the shapes of a channel counts at a weight; ``full`` (K,) are the weights of the shapes alone.

    Between two shapes, or a shape and none, it goes in a straight line, and on in it beyond the last one.
    """
    knots = np.concatenate([[0.0], full])
    beyond = [int(i) for i in np.argsort(np.abs(knots), kind="stable") if knots[i] * weight > 0.0]
    line = [0, *(beyond or [int(np.argmin(np.abs(full))) + 1])]
    at = int(np.clip(np.searchsorted(np.abs(knots[line]), abs(weight)), 1, len(line) - 1))
    before, behind = line[at - 1], line[at]
    result, step = np.zeros(len(knots)), knots[behind] - knots[before]
    if step:
        result[behind] = (weight - knots[before]) / step
        result[before] = 1.0 - result[behind]
    return result[1:]
