"""How a glTF file is framed: JSON alone, or JSON and bytes in the chunks of a GLB."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.text import utf8

MAGIC = b"glTF"
_HEADER = struct.Struct("<4sII")
_CHUNK = struct.Struct("<II")
_JSON, _BINARY = 0x4E4F534A, 0x004E4942
"""Types of chunks (glTF 2.0, "Binary glTF Layout"). Chunks of other types have to be passed over."""


@dataclass(frozen=True, eq=False)
class Container:
    """The two parts of a file.

    Attributes:
        text: the JSON.
        binary: the bytes beside it in a GLB, None where there are none.
        notes: what of the file was left out.
    """

    text: bytes
    binary: memoryview | None = None
    notes: tuple[str, ...] = ()


def unpack(data: bytes) -> Container:
    """The parts of a file, by what it begins with, not by its name. Raises UnreadableError where it is no glTF."""
    if data.startswith(MAGIC):
        return _unpack_binary(data)
    text = utf8(data).lstrip()
    if not text.startswith(b"{"):
        raise UnreadableError("broken: neither the JSON text of a glTF file nor a binary one (GLB)")
    return Container(text)


def _unpack_binary(data: bytes) -> Container:
    if len(data) < _HEADER.size:
        raise UnreadableError("broken: cut short in the header of a GLB")
    _, version, length = _HEADER.unpack_from(data)
    if version != 2:
        raise UnreadableError(f"GLB of version {version}, which is not read; save it as glTF 2.0")
    if length > len(data):
        raise UnreadableError(f"broken: cut short, {len(data)} of {length} bytes")
    chunks: dict[int, memoryview] = {}
    first, start = None, _HEADER.size
    # Some writers do not pad the last chunk, so fewer than 4 bytes may stay.
    while start + _CHUNK.size <= length:
        size, kind = _CHUNK.unpack_from(data, start)
        start += _CHUNK.size + size
        if start > length:
            raise UnreadableError(f"broken: a chunk of the GLB ends at byte {start} of {length}")
        chunks.setdefault(kind, memoryview(data)[start - size : start])
        first = kind if first is None else first
    if first != _JSON:
        raise UnreadableError("broken: the GLB does not begin with its JSON")
    text = utf8(bytes(chunks[_JSON])).rstrip(b"\0 ")
    rest = len(data) - length
    notes = (f"{rest} bytes behind the end of the GLB left out",) if data[length:].strip(b"\0 \r\n") else ()
    return Container(text, chunks.get(_BINARY), notes)
