"""Binary messages, in which meshes travel to the page."""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from shapewright.studio.wire.shapes import BufferKind, MeshHead, ResidualsHead
from shapewright.studio.wire.values import encode

_KINDS: Mapping[str, BufferKind] = {"f4": "f32", "u4": "u32", "i4": "i32"}
Buffers = Mapping[str, NDArray[Any]]


def binary(head: MeshHead | ResidualsHead, buffers: Buffers) -> bytes:
    """A binary message: u32 length of the header, the header as JSON, the buffers; all little-endian, 4-byte aligned.

    buffers: float32, uint32 or int32; the head's field ``buffers`` comes to describe them.
    """
    described = [(name, _KINDS[array.dtype.str[1:]], array.size) for name, array in buffers.items()]
    text = encode(replace(head, buffers=described))
    text += b" " * (-len(text) % 4)
    arrays = (np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("<")) for array in buffers.values())
    return b"".join([struct.pack("<I", len(text)), text, *(array.tobytes() for array in arrays)])


def parse(message: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """The inverse of ``binary``. Raises ValueError for a message that is cut short."""
    (length,) = struct.unpack_from("<I", message)
    header = json.loads(message[4 : 4 + length])
    kinds = {kind: f"<{code}" for code, kind in _KINDS.items()}
    buffers, start = {}, 4 + length
    for name, kind, count in header["buffers"]:
        buffers[name] = np.frombuffer(message, dtype=kinds[kind], count=count, offset=start)
        start += 4 * count
    return header, buffers
