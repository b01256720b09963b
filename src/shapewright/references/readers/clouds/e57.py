"""E57 (ASTM E2807), the exchange format of scanners on tripods, through pye57 (extra ``points``)."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.cloud import Cloud, refuse_count
from shapewright.shapes import Floats

_CODE = re.compile(r" ?\(Error\w+\)")
"""Behind the words of a message of libE57Format."""
_METRE = 1.0  # the unit of the format
_HEADER, _SIZE_AT = 48, 16  # bytes of the header, and where in it the length of the file stands


def read_e57(path: Path, data: bytes) -> Cloud:
    """The points of all scans of an E57 file, where their poses put them, in metres, with the places of the scanners.

    Raises UnreadableError for a file that is broken or cut short or has no scans, and where pye57 is missing.
    """
    if not data.startswith(b"ASTM-E57") or len(data) < _HEADER:
        raise UnreadableError("broken: it does not begin as E57 does")
    length = int.from_bytes(data[_SIZE_AT : _SIZE_AT + 8], "little")
    if length != len(data):
        less = "cut short" if length > len(data) else "broken"
        raise UnreadableError(f"{less}: it declares {length} bytes and has {len(data)}")
    try:
        import pye57
    except ImportError as error:
        raise UnreadableError("E57, which needs pye57: pip install 'shapewright[points]'") from error
    positions: list[Floats] = []
    sensors: list[Floats] = []
    declared = 0
    try:
        with pye57.E57(str(path)) as file:
            refuse_count(sum(file.get_header(i).point_count for i in range(file.scan_count)), len(data))
            for i in range(file.scan_count):
                header, found = file.get_header(i), _scan(file, i)
                declared += header.point_count
                positions.append(found)
                # Without a pose the points may have been merged: nobody knows where the scanner stood.
                place = header.translation if header.has_pose() else [np.nan] * 3
                sensors.append(np.broadcast_to(np.asarray(place, dtype=np.float64), found.shape))
    except pye57.libe57.E57Exception as error:
        said = str(error).partition("\n")[0]  # what follows are lines of its source
        raise UnreadableError(f"broken: {_CODE.sub('', said)}") from error
    if not positions:
        raise UnreadableError("it holds no scans")
    invalid = declared - sum(len(found) for found in positions)
    notes = (f"{invalid} of {declared} points left out: marked as invalid",) if invalid else ()
    return Cloud(np.concatenate(positions), None, np.concatenate(sensors), notes, _METRE)


def _scan(file: Any, number: int) -> Floats:
    """The valid points of a scan in the frame of the file."""
    found = file.read_scan(number, ignore_missing_fields=True, intensity=False, colors=False, transform=True)
    return np.stack([np.asarray(found[f"cartesian{axis}"], dtype=np.float64) for axis in "XYZ"], axis=-1)
