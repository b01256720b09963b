"""The bytes that a glTF document refers to: files beside it, data URIs, the binary chunk, and views of them."""

from __future__ import annotations

import base64
import binascii
import re
import unicodedata
from collections.abc import Callable
from functools import cache
from pathlib import Path
from urllib.parse import unquote, unquote_to_bytes

import msgspec

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.gltf.document import MESHOPT, Buffer, BufferView, Document, at, extension

Views = Callable[[int], memoryview]
"""The bytes of a buffer view, by its index; decompressed, and kept for the next call."""

_SHOWN = 200
"""Letters of a URI that a message shows."""
_MOST = 2**29
"""Bytes that the views of a file may have after decompression: five million points and ten million triangles."""
_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")
_ELSEWHERE = re.compile(r"[/\\]|[A-Za-z]:[/\\]|(.*[/\\])?\.\.([/\\]|$)")
"""Paths from the root of a disk, and such that go up."""


class _Compressed(msgspec.Struct, rename="camel", frozen=True):
    """A buffer view by EXT_meshopt_compression or KHR_meshopt_compression."""

    buffer: int
    byte_length: int
    byte_stride: int
    count: int
    mode: str
    byte_offset: int = 0
    filter: str = "NONE"


def views(document: Document, folder: Path, binary: memoryview | None) -> Views:
    """What reads the buffer views of a document whose files lie in ``folder``. It raises UnreadableError."""

    compressed = [_compressed(view) for view in document.buffer_views]
    size = sum(max(view.count, 0) * max(view.byte_stride, 0) for view in compressed if view is not None)
    if size > _MOST:
        raise UnreadableError(f"compressed views that unpack to {size:,} bytes: too large to read")

    @cache
    def buffer(index: int) -> memoryview:
        described = at(document.buffers, index, "buffer")
        if described.uri is None and (index > 0 or binary is None):
            raise UnreadableError(f"broken: buffer {index} has no data")
        data = binary if described.uri is None else memoryview(_fetched(described, folder))
        assert data is not None
        if len(data) < described.byte_length:
            raise UnreadableError(f"broken: cut short, buffer {index} has {len(data)} of {described.byte_length} bytes")
        return data[: described.byte_length]

    @cache
    def view(index: int) -> memoryview:
        described = at(document.buffer_views, index, "buffer view")
        coded = compressed[index]
        if coded is not None:
            data = _stretch(buffer(coded.buffer), coded, f"compressed view {index}")
            from shapewright.references.readers.gltf import meshopt

            return meshopt.decoded(data, coded.count, coded.byte_stride, coded.mode, coded.filter)
        try:
            return _stretch(buffer(described.buffer), described, f"buffer view {index}")
        except UnreadableError as error:
            if described.extensions:
                raise UnreadableError(f"{error}: compressed by {', '.join(described.extensions)}") from error
            raise

    return view


def _compressed(view: BufferView) -> _Compressed | None:
    found = (extension(view.extensions, name, _Compressed) for name in MESHOPT if name in view.extensions)
    return next(found, None)


def _stretch(data: memoryview, described: BufferView | _Compressed, name: str) -> memoryview:
    end = described.byte_offset + described.byte_length
    if end > len(data) or min(described.byte_offset, described.byte_length) < 0:
        raise UnreadableError(f"broken: {name} ends at byte {end} of a buffer of {len(data)}")
    return data[described.byte_offset : end]


def _fetched(buffer: Buffer, folder: Path) -> bytes:
    """The bytes of a buffer with a URI: at least its length where the file beside it has them."""
    assert buffer.uri is not None
    if buffer.uri[:5].lower() == "data:":
        return _embedded(buffer.uri)
    path = _located(buffer.uri, folder)
    with path.open("rb") as file:
        return file.read(min(buffer.byte_length, path.stat().st_size))


def _embedded(uri: str) -> bytes:
    """The bytes in a data URI (RFC 2397)."""
    head, comma, body = uri.partition(",")
    if not comma:
        raise UnreadableError("broken: a data URI without data")
    data = unquote_to_bytes(body)
    if not head.lower().rstrip().endswith(";base64"):
        return data
    data = b"".join(data.split()).rstrip(b"=").translate(bytes.maketrans(b"-_", b"+/"))
    try:
        return base64.b64decode(data + b"=" * (-len(data) % 4), validate=True)
    except binascii.Error as error:
        raise UnreadableError(f"broken: a data URI that is not base64 ({error})") from error


def _located(uri: str, folder: Path) -> Path:
    """The file of a relative URI. Raises UnreadableError for one that lies elsewhere, or that is missing.

    URIs are percent-encoded, but many writers leave that out, write backslashes or another case, compose accents
    another way, or add a query for a server.
    """
    decoded = unquote(uri)
    names = [decoded, uri, decoded.replace("\\", "/"), decoded.partition("?")[0]]
    names += [unicodedata.normalize(form, decoded) for form in ("NFC", "NFD")]
    if _SCHEME.match(uri) or any(_ELSEWHERE.match(name) for name in names):
        raise UnreadableError(f"it refers to {decoded[:_SHOWN]}, which lies outside its folder")
    path = folder / decoded
    try:
        found = next((folder / name for name in names if (folder / name).is_file()), None)
        if found is None:
            alike = [each for each in path.parent.iterdir() if each.name.casefold() == path.name.casefold()]
            found = alike[0] if len(alike) == 1 and alike[0].is_file() else None
    except OSError:  # a name longer than the system takes, or no such folder
        found = None
    if found is None:
        raise UnreadableError(f"it needs {decoded[:_SHOWN]}, which is missing")
    return found
