"""The binary form of FBX: records with the place of their end, and typed values, in either order of bytes."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.fbx.nodes import DEEPEST, Node, Packed, Value

MAGIC = b"Kaydara FBX Binary  \0\x1a"
_HEADER = 27
_WIDE = 7500
"""The version from which sizes have 64 bits."""
_SCALARS = {"Y": "h", "C": "?", "B": "?", "Z": "b", "I": "i", "F": "f", "D": "d", "L": "q"}
_ARRAYS = {"f": "f4", "d": "f8", "l": "i8", "i": "i4", "b": "u1", "c": "u1"}
_MOST = 2_000_000
"""Records of a file."""


@dataclass(frozen=True, eq=False)
class _Form:
    """How numbers are written: the sign of struct for the order of bytes, and the letter of sizes."""

    order: str
    size: str


def read_binary(data: bytes) -> tuple[Node, int]:
    """The outermost nodes, in one, and the version. Raises UnreadableError, with the reason."""
    if len(data) < _HEADER:
        raise UnreadableError("broken: cut short within its header")
    order = ">" if data[22] else "<"
    (version,) = struct.unpack_from(f"{order}I", data, 23)
    form = _Form(order, "Q" if version >= _WIDE else "I")
    view, count = memoryview(data), [0]
    top, position = list[Node](), _HEADER
    while True:
        node, position = _record(view, position, len(data), form, 0, count)
        if node is None:
            return Node("", (), top), version
        top.append(node)


def _record(
    data: memoryview, start: int, limit: int, form: _Form, depth: int, count: list[int]
) -> tuple[Node | None, int]:
    """The record at a place, and where it ends; None for the empty one that closes a list. ``count`` is of records."""
    count[0] += 1
    if depth > DEEPEST or count[0] > _MOST:
        raise UnreadableError(f"its records are more than {DEEPEST} levels deep, or more than {_MOST:,}")
    head = struct.Struct(f"{form.order}3{form.size}B")
    if start + head.size > limit:
        raise UnreadableError(f"broken: cut short at byte {start}")
    end, value_count, value_size, name_size = head.unpack_from(data, start)
    position = start + head.size
    if not (end or value_count or value_size or name_size):
        return None, position
    end = end or position + name_size + value_size  # as some programs write records without others in them
    if not position + name_size + value_size <= end <= limit:
        raise UnreadableError(f"broken: cut short, a record at byte {start} ends at byte {end} of {limit}")
    name = bytes(data[position : position + name_size]).decode("latin-1")
    position += name_size
    values, below = _values(data[position : position + value_size], value_count, form, start), list[Node]()
    position += value_size
    while position < end:
        node, position = _record(data, position, end, form, depth + 1, count)
        if node is None:
            break
        below.append(node)
    if position != end:
        raise UnreadableError(f"broken: a record at byte {start} ends at byte {position}, not at {end}")
    return Node(name, values, below), end


def _values(data: memoryview, count: int, form: _Form, start: int) -> list[Value]:
    values: list[Value] = []
    position = 0
    try:
        while len(values) < count:
            kind = chr(data[position])
            position += 1
            if kind in _SCALARS:
                scalar = struct.Struct(form.order + _SCALARS[kind])
                values.append(scalar.unpack_from(data, position)[0])
                position += scalar.size
            elif kind in "SR":
                (size,) = struct.unpack_from(f"{form.order}I", data, position)
                position += 4
                values.append(bytes(data[position : position + size]).decode("utf-8", "surrogateescape"))
                position += size
            elif kind in _ARRAYS:
                length, encoding, size = struct.unpack_from(f"{form.order}3I", data, position)
                packed = form.order + _ARRAYS[kind]
                size = size if encoding else length * int(packed[2:])
                position += 12
                values.append(Packed(packed, length, data[position : position + size], encoding != 0))
                position += size
            else:
                raise UnreadableError(f"broken: a record at byte {start} has a value of the unknown type {kind!r}")
    except (IndexError, struct.error) as error:
        raise UnreadableError(f"broken: a record at byte {start} has fewer values than it announces") from error
    if position != len(data):
        raise UnreadableError(f"broken: the values of a record at byte {start} do not end where it says")
    return values
