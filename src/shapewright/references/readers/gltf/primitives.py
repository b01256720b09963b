"""The primitives of a mesh in glTF: their triangles, and which joints move their vertices."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.gltf.accessors import Accessors, Array, as_floats
from shapewright.references.readers.gltf.document import DRACO, Primitive, at, extension
from shapewright.references.readers.gltf.draco import Streams
from shapewright.references.readers.polygons import check_indices
from shapewright.shapes import Floats, Ints

_TRIANGLES, _STRIP, _FAN = 4, 5, 6
"""Modes of primitives that are triangles; lower ones are points and lines."""
_POSITION = "POSITION"


class _Draco(msgspec.Struct, rename="camel", frozen=True):
    buffer_view: int
    attributes: dict[str, int]


@dataclass(frozen=True, eq=False)
class Geometry:
    """Triangles in the frame of their mesh.

    Attributes:
        vertices: (V, 3), morphed by the weights of the targets.
        faces: (F, 3).
        joints: (V, J), of a skin; J is 0 where no joints move the vertices.
        weights: (V, J), how much each joint does.
        spare: corners at the end that are no whole triangle.
        elsewhere: whether the file says of its positions that they lie elsewhere.
        within: whether its positions or indices begin where no number can.
    """

    vertices: Floats
    faces: Ints
    joints: Ints
    weights: Floats
    spare: int = 0
    elsewhere: bool = False
    within: bool = False


def has_triangles(primitive: Primitive) -> bool:
    """Whether a primitive can have triangles: it is not points or lines. Raises UnreadableError for no known mode."""
    if not 0 <= primitive.mode <= _FAN:
        raise UnreadableError(f"broken: a primitive of mode {primitive.mode}")
    return primitive.mode >= _TRIANGLES and _POSITION in primitive.attributes


def size(primitive: Primitive, accessors: Accessors) -> int:
    """The triangles that a primitive announces at most, where it has some."""
    index = primitive.attributes[_POSITION] if primitive.indices is None else primitive.indices
    count = at(accessors.described, index, "accessor").count
    return count // 3 if primitive.mode == _TRIANGLES and primitive.indices is not None else count


def geometry(primitive: Primitive, morph: Sequence[float], accessors: Accessors, streams: Streams) -> Geometry:
    """The triangles of a primitive that has some, with each morph target taken as often as ``morph`` says.

    Vertices that lie before or behind all used ones are left out. Raises UnreadableError for broken data.
    """
    compressed = extension(primitive.extensions, DRACO, _Draco)
    decoded = streams(compressed.buffer_view) if compressed else None
    encoded = compressed.attributes if compressed else {}
    position = primitive.attributes[_POSITION]
    if decoded is None:
        _refuse_missing(primitive, accessors)
        count = len(accessors.stored(position))
        corners = np.arange(count) if primitive.indices is None else accessors.indices(primitive.indices)[:, 0]
        faces = _faces(primitive.mode, corners.astype(np.int64))
        spare = len(corners) % 3 if primitive.mode == _TRIANGLES else 0
    else:
        if encoded.get(_POSITION) not in decoded.attributes:
            raise UnreadableError("broken: its Draco compression has no positions")
        count, faces, spare = len(decoded.attributes[encoded[_POSITION]]), decoded.faces, 0
        told = at(accessors.described, position, "accessor").count, size(primitive, accessors)
        if count != told[0] or len(faces) > told[1]:
            raise UnreadableError(f"broken: its Draco compression has {count} vertices and {len(faces)} triangles, "
                                  f"not {told[0]} and {told[1]}")  # fmt: skip
    check_indices(faces.reshape(-1), count)
    rows, faces = _used(faces)

    def values(attribute: str, index: int, width: int) -> Floats:
        if decoded is not None and encoded.get(attribute) in decoded.attributes:
            array: Array = decoded.attributes[encoded[attribute]]
            real = as_floats(array[rows], at(accessors.described, index, "accessor").normalized)
        else:
            array, real = accessors.stored(index), accessors.floats(index, width, rows)
        if len(array) != count or real.shape[1:] != (width,):
            raise UnreadableError(f"broken: {attribute} has {len(array)} values for {count} vertices")
        return real

    vertices = values(_POSITION, position, 3)
    elsewhere = decoded is None and accessors.lie_elsewhere(position)
    read = () if decoded else (position,) if primitive.indices is None else (position, primitive.indices)
    within = any(accessors.begins_within_a_number(index) for index in read)
    for target, weight in zip(primitive.targets, morph, strict=False):
        if weight and _POSITION in target:
            vertices += weight * values("a morph target", target[_POSITION], 3)
    joints, weights = _influences(primitive, values)
    return Geometry(vertices, faces, joints, weights, spare, elsewhere, within)


def _refuse_missing(primitive: Primitive, accessors: Accessors) -> None:
    for name, index in (("positions", primitive.attributes[_POSITION]), ("indices", primitive.indices)):
        if index is not None and not accessors.has_data(index):
            by = f": it is compressed by {', '.join(primitive.extensions)}" if primitive.extensions else ""
            raise UnreadableError(f"a mesh has no data for its {name}{by}")


def _faces(mode: int, corners: Ints) -> Ints:
    """Triangles (F, 3) of a list, a strip or a fan, as glTF orders their corners; an incomplete one is left out."""
    if mode == _TRIANGLES:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    if len(corners) < 3:
        return np.empty((0, 3), dtype=np.int64)
    if mode == _FAN:
        first = np.broadcast_to(corners[0], len(corners) - 2)
        return np.stack([corners[1:-1], corners[2:], first], axis=1)
    faces = np.stack([corners[:-2], corners[1:-1], corners[2:]], axis=1)
    faces[1::2, 1:] = faces[1::2, :0:-1]
    return faces


def _used(faces: Ints) -> tuple[Ints | slice, Ints]:
    """Rows of the vertices that hold all used ones, and the faces that point at those rows.

    One array of vertices often serves a thousand primitives, so none of them may take it whole.
    """
    if not len(faces):
        return slice(0), faces
    first, last = int(faces.min()), int(faces.max())
    if last - first < 2 * faces.size:
        return slice(first, last + 1), faces - first
    rows, corners = np.unique(faces, return_inverse=True)
    return rows, corners.reshape(faces.shape)


def _influences(primitive: Primitive, values: Callable[[str, int, int], Floats]) -> tuple[Ints, NDArray[Any]]:
    """Joints and weights, four a set: JOINTS_0 and WEIGHTS_0, and so on."""
    joints, weights = list[Floats](), list[Floats]()
    while (name := f"JOINTS_{len(joints)}") in primitive.attributes:
        weight = f"WEIGHTS_{len(joints)}"
        if weight not in primitive.attributes:
            raise UnreadableError(f"broken: {name} without {weight}")
        joints.append(values(name, primitive.attributes[name], 4))
        weights.append(values(weight, primitive.attributes[weight], 4))
    if not joints:
        return np.empty((0, 0), dtype=np.int64), np.empty((0, 0))
    return np.concatenate(joints, axis=1).astype(np.int64), np.concatenate(weights, axis=1)
