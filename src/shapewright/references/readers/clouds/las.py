"""LAS and LAZ, the files of airborne and mobile scanners, through laspy (extra ``points``).

Where the ends of a file are is read here, by the LAS specification 1.4: laspy reads past them.
"""

from __future__ import annotations

import io
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.cloud import Cloud, refuse_count
from shapewright.references.readers.text import PADDING
from shapewright.shapes import Floats

_AT_ONCE = 1_000_000  # points that are decoded at once
_PACKED = 0x80  # the bit of the point format that LAZ sets
_RECORD = 54  # bytes that each of the records between header and points has at least
_NEWEST = 4  # 1.4, of which the specification is


def read_las(_: Path, data: bytes) -> Cloud:
    """The points of a LAS or LAZ file's bytes, Z up. Points that are marked as withheld are left out.

    Raises UnreadableError for a file that is broken or cut short, and where laspy is missing.
    """
    if not data.startswith(b"LASF") or len(data) < 227:
        raise UnreadableError("broken: it does not begin as LAS does")
    _check_size(data)
    try:
        import laspy
    except ImportError as error:
        raise UnreadableError("LAS, which needs laspy: pip install 'shapewright[points]'") from error
    try:
        places, hidden, declared = _decoded(laspy, data)
    except UnreadableError:
        raise
    except BaseException as error:  # lazrs panics on what it does not expect, which is no Exception
        if isinstance(error, Exception) or type(error).__name__ == "PanicException":
            raise UnreadableError(f"broken, or packed in a way that laspy cannot read: {error}") from error
        raise
    if len(places) != declared:
        raise UnreadableError(f"cut short: it declares {declared} points and holds {len(places)}")
    notes = (f"{int(hidden.sum())} of {declared} points left out: marked as withheld",) if hidden.any() else ()
    return Cloud(places[~hidden] if hidden.any() else places, notes=notes, up="z")


def _decoded(laspy: Any, data: bytes) -> tuple[Floats, NDArray[np.bool_], int]:
    """Places (N, 3) of the points, which of them (N,) are withheld, and how many the header declares."""
    positions, withheld = [np.empty((0, 3))], [np.empty(0, dtype=bool)]
    with laspy.open(io.BytesIO(data), read_evlrs=False) as file:
        declared = int(file.header.point_count)
        refuse_count(declared, len(data))
        for chunk in file.chunk_iterator(_AT_ONCE):
            positions.append(np.stack([np.asarray(chunk[axis], dtype=np.float64) for axis in "xyz"], axis=-1))
            withheld.append(np.asarray(chunk["withheld"]).astype(bool))
    return np.concatenate(positions), np.concatenate(withheld), declared


def _check_size(data: bytes) -> None:
    """Raise UnreadableError where the points that the header declares do not end with the file."""
    minor = data[25]
    begin, offset, records, kind, length, count = struct.unpack_from("<HIIBHI", data, 94)
    waveforms = extended = 0
    if data[24] != 1 or minor > _NEWEST:
        raise UnreadableError(f"LAS {data[24]}.{minor}, which is not read; save it as LAS 1.4 or older")
    if begin + records * _RECORD > offset:
        raise UnreadableError(f"broken: {records} records do not fit before the points, at byte {offset}")
    if minor >= 3 and len(data) >= 235:
        waveforms = struct.unpack_from("<Q", data, 227)[0]
    if minor >= 4 and len(data) >= 375:
        extended = struct.unpack_from("<Q", data, 235)[0]
        count = struct.unpack_from("<Q", data, 247)[0] or count
    if kind & _PACKED:
        _check_chunks(data, offset, count)
        return  # the size says nothing of packed points
    end = offset + count * length
    if end > len(data):
        raise UnreadableError(f"cut short: it declares {count} points of {length} bytes and has {len(data)} in all")
    if not (waveforms or extended) and data[end:].strip(PADDING):
        raise UnreadableError(f"broken: {len(data) - end} bytes follow the {count} points that it declares")


def _check_chunks(data: bytes, offset: int, count: int) -> None:
    """Raise UnreadableError where LAZ announces more chunks than points: lazrs takes memory for as many as it reads.

    Where the table of chunks begins stands before the points, or, where that says -1, in the last 8 bytes.
    """
    if offset + 8 > len(data):
        raise UnreadableError(f"cut short: its points begin at byte {offset} of {len(data)}")
    begin = int.from_bytes(data[offset : offset + 8], "little", signed=True)
    if begin == -1:
        begin = int.from_bytes(data[-8:], "little", signed=True)
    if not offset <= begin <= len(data) - 8:
        raise UnreadableError(f"cut short: its table of chunks begins at byte {begin} of {len(data)}")
    version, chunks = struct.unpack_from("<II", data, begin)
    if version or chunks > count:
        raise UnreadableError(f"broken: it announces {chunks} chunks of version {version} for {count} points")
