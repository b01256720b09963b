"""Shapes as bytes, to the bit: a head of plain values, and the arrays one after the other."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from shapewright.shapes.drawing import Drawing
from shapewright.shapes.mesh import Mesh
from shapewright.shapes.points import Points
from shapewright.shapes.views import Views

_MESH = ("vertices", "faces", "face_labels", "face_rules", "face_colours")
_POINTS = ("positions", "normals", "seen_from")
_KINDS = {"face_colours": np.uint8, **dict.fromkeys(("faces", "face_labels", "face_rules"), np.int64)}
_COLUMNS = {"face_colours": 4, "face_labels": 0, "face_rules": 0}
"""Of an array; three of the others, 0 for one without."""
ALIGNED = 8
"""Bytes that a shape's length is a multiple of, so that the next one's numbers lie where processors want them."""

Head = Mapping[str, Any]
"""What of a shape is not in its arrays, as plain values for JSON; ``bytes`` is their length."""


def pack(shape: Mesh | Drawing | Points) -> tuple[Head, bytes]:
    """The head and the bytes of a shape."""
    if isinstance(shape, Drawing):
        content = shape.geometry.wkb
        return {"kind": "drawing", "used": len(content), "bytes": _whole(len(content))}, _padded(content)
    names = _MESH if isinstance(shape, Mesh) else _POINTS
    arrays = {name: array for name in names if (array := getattr(shape, name)) is not None}
    content = _padded(b"".join(np.ascontiguousarray(array).tobytes() for array in arrays.values()))
    head = {"kind": "points", "arrays": {name: len(array) for name, array in arrays.items()}, "bytes": len(content)}
    if isinstance(shape, Mesh):
        head |= {"kind": "mesh", "labels": list(shape.label_names), "rules": list(shape.rule_names)}
    return head, content


def unpack(head: Head, content: Any) -> Mesh | Drawing | Points:
    """The shape of a head and of its bytes, in which its arrays lie. Raises ValueError and KeyError for others."""
    if head["kind"] == "drawing":
        import shapely

        return Drawing(shapely.from_wkb(bytes(content[: head["used"]])))  # type: ignore[arg-type]  # a drawing's
    arrays: dict[str, Any] = {}
    start = 0
    for name, rows in head["arrays"].items():
        kind, columns = np.dtype(_KINDS.get(name, np.float64)), _COLUMNS.get(name, 3)
        count = rows * max(columns, 1)
        array = np.frombuffer(content, kind, count, start)
        arrays[name] = array.reshape(rows, columns) if columns else array
        start += count * kind.itemsize
    if head["kind"] == "points":
        points = Points(arrays["positions"], seen_from=arrays.get("seen_from"))
        object.__setattr__(points, "normals", arrays.get("normals"))  # they are of length 1 to the bit that they are
        return points
    return Mesh(**arrays, label_names=tuple(head["labels"]), rule_names=tuple(head["rules"]))


def size_of(shape: Mesh | Drawing | Points | Views) -> int:
    """Bytes of the arrays of a mesh or of points; 0 for the others, which are small or stay in memory."""
    names = _MESH if isinstance(shape, Mesh) else _POINTS if isinstance(shape, Points) else ()
    return sum(array.nbytes for name in names if (array := getattr(shape, name)) is not None)


def _whole(length: int) -> int:
    return -(-length // ALIGNED) * ALIGNED


def _padded(content: bytes) -> bytes:
    return content + bytes(_whole(len(content)) - len(content))
