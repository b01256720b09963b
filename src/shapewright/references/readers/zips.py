"""ZIP archives in a file's bytes, which may be hostile."""

from __future__ import annotations

import io
import zipfile
import zlib

from shapewright.references.errors import UnreadableError

_RATIO, _SLACK = 200, 2**26
"""An archive may unpack to so many times its bytes, and as many bytes more. The text of models shrinks to a twentieth,
that of the most regular ones to a hundredth; a bomb to a thousandth."""
_LARGEST = 2**30
"""Bytes of an entry: ten million triangles."""


def opened(data: bytes) -> zipfile.ZipFile:
    """The archive in a file's bytes. Raises UnreadableError for what is none, and for a ZIP bomb."""
    try:
        archive = zipfile.ZipFile(io.BytesIO(data))
    except (zipfile.BadZipFile, ValueError, NotImplementedError, OSError) as error:
        raise UnreadableError(f"broken: no ZIP archive, or cut short ({error})") from error
    size = sum(entry.file_size for entry in archive.infolist())
    if size > _RATIO * len(data) + _SLACK:
        raise UnreadableError(f"a ZIP bomb: {len(data):,} bytes that unpack to {size:,}")
    return archive


def unpacked(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, name: str) -> bytes:
    """The bytes of an entry, which messages call ``name``. Raises UnreadableError where it is broken or too large."""
    if entry.file_size > _LARGEST:
        raise UnreadableError(f"its part {name[:200]} has {entry.file_size:,} bytes, more than are read")
    try:
        return archive.read(entry)
    except (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, ValueError, OSError) as error:
        raise UnreadableError(f"broken: its part {name[:200]} cannot be unpacked ({error})") from error
