"""PCD, the files of the Point Cloud Library: versions .5 to .7, as text, binary, and binary packed with LZF.

The format: https://pointclouds.org/documentation/tutorials/pcd_file_format.html
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.cloud import Cloud
from shapewright.references.readers.text import PADDING, plain, rows, shown
from shapewright.shapes import Floats

_LINE = re.compile(rb"([^\r\n]*)\r?\n")
_KINDS = {("F", 4): "<f4", ("F", 8): "<f8"} | {
    (sign, size): f"<{code}{size}" for sign, code in (("I", "i"), ("U", "u")) for size in (1, 2, 4, 8)
}
_OLD = {"COLUMNS": "FIELDS"}  # of version .5
_NORMALS = (("normal_x", "normal_y", "normal_z"), ("nx", "ny", "nz"))
_PASSED_OVER = frozenset(["_", "rgb", "rgba", "rgba_", "intensity", "curvature", "label", "ring", "time", "timestamp"])
_NOWHERE = (0.0, 0.0, 0.0)  # the viewpoint that is written where none is known


@dataclass(frozen=True)
class _Header:
    """What the header declares; a field of several values stands in ``names`` once for each of them."""

    names: tuple[str, ...]
    kinds: tuple[str, ...]
    points: int
    viewpoint: tuple[float, ...]
    encoding: str


def read_pcd(data: bytes) -> Cloud:
    """The points of a PCD file's bytes. Raises UnreadableError for a file that is broken or cut short."""
    header, body = _header(data)
    columns = _COLUMNS[header.encoding](header, body)
    if missing := [axis for axis in "xyz" if axis not in columns]:
        raise UnreadableError(f"its points have no field {missing[0]!r}, only {', '.join(dict.fromkeys(header.names))}")
    named = next((names for names in _NORMALS if set(names) <= columns.keys()), None)
    unknown = set(columns) - {*"xyz", *(named or ())} - _PASSED_OVER
    sensor = header.viewpoint[:3]
    return Cloud(
        _stacked(columns, "xyz"),
        _stacked(columns, named) if named else None,
        None if sensor == _NOWHERE else np.array(sensor),
        (f"{len(unknown)} fields left out, such as {min(unknown)!r}",) if unknown else (),
    )


def _header(data: bytes) -> tuple[_Header, bytes]:
    found: dict[str, list[str]] = {}
    at = 0
    text = plain(data)
    while "DATA" not in found:
        line = _LINE.match(text, at)
        if line is None:
            raise UnreadableError("broken: no PCD header")
        at = line.end()
        match line[1].decode("latin-1").split():
            case [] | ["VERSION", *_]:
                pass
            case [word, *_] if word.startswith("#"):
                pass
            case [word, *values] if re.fullmatch(r"[A-Z]+", word) and word not in found and values:
                found[_OLD.get(word, word)] = values
            case _:
                raise UnreadableError(f"broken: cannot understand the line {shown(line[1])} of the header")
    try:
        return _understood(found), text[at:]
    except (KeyError, ValueError, OverflowError) as error:
        raise UnreadableError(f"broken: its header says nothing of {error}") from error


def _understood(found: Mapping[str, Sequence[str]]) -> _Header:
    fields = found["FIELDS"]
    sizes, types = found.get("SIZE", ["4"] * len(fields)), found.get("TYPE", ["F"] * len(fields))
    counts = [int(count) for count in found.get("COUNT", ["1"] * len(fields))]
    if not len(fields) == len(sizes) == len(types) == len(counts) or min(counts) < 1 or sum(counts) > 10_000:
        raise UnreadableError("broken: its header has fields without size, type or count")
    kinds = [_KINDS.get((kind.upper(), int(size))) for kind, size in zip(types, sizes, strict=True)]
    each: list[tuple[str, str]] = []
    for name, kind, count in zip(fields, kinds, counts, strict=True):
        if kind is None:
            raise UnreadableError(f"its field {name!r} is of a type that is not known")
        each += [(name.casefold(), kind)] * count
    width, height = int(found["WIDTH"][0]), int(found.get("HEIGHT", ["1"])[0])
    points = int(found.get("POINTS", [str(width * height)])[0])
    if min(width, height, points) < 0 or points != width * height:
        raise UnreadableError(f"broken: it declares {points} points, and {width} x {height} of them")
    encoding = found["DATA"][0].lower()
    if encoding not in _COLUMNS:
        raise UnreadableError(f"its data are {encoding!r}, which is not known")
    viewpoint = tuple(float(value) for value in found.get("VIEWPOINT", ["0"] * 3))
    return _Header(tuple(name for name, _ in each), tuple(kind for _, kind in each), points, viewpoint, encoding)


_Columns = dict[str, NDArray[np.generic]]


def _of_text(header: _Header, body: bytes) -> _Columns:
    table = rows(body.rstrip(PADDING))
    if len(table) != header.points:
        less = "cut short" if len(table) < header.points else "broken"
        raise UnreadableError(f"{less}: it declares {header.points} points and holds {len(table)}")
    if (odd := np.flatnonzero(table.lengths != len(header.names))).size:
        which = int(odd[0])
        held = table.lengths[which]
        raise UnreadableError(f"broken: point {which + 1} has {held} values, and its header {len(header.names)} fields")
    values = table.values.reshape(header.points, len(header.names))
    return {name: values[:, i] for i, name in _firsts(header)}


def _of_bytes(header: _Header, body: bytes) -> _Columns:
    row = np.dtype([(str(i), kind) for i, kind in enumerate(header.kinds)])
    size = row.itemsize * header.points
    if size > len(body):
        raise UnreadableError(f"cut short: it declares {header.points} points of {row.itemsize} bytes")
    if body[size:].strip(PADDING):
        raise UnreadableError(f"broken: {len(body) - size} bytes follow the points that it declares")
    table = np.frombuffer(body, row, header.points)
    return {name: table[str(i)] for i, name in _firsts(header)}


def _of_packed(header: _Header, body: bytes) -> _Columns:
    """The fields one after the other, packed together behind the two sizes."""
    from shapewright.references.readers.clouds.lzf import MOST_GROWTH, unpacked  # numba loads slowly

    packed, size = (int(n) for n in np.frombuffer(body, "<u4", 2)) if len(body) >= 8 else (0, 0)
    sizes = [np.dtype(kind).itemsize * header.points for kind in header.kinds]
    if packed > len(body) - 8 or not packed:
        raise UnreadableError(f"cut short: it declares {packed} bytes of packed points")
    if body[8 + packed :].strip(PADDING):
        raise UnreadableError(f"broken: {len(body) - 8 - packed} bytes follow its packed points")
    if size != sum(sizes) or size > MOST_GROWTH * packed:
        raise UnreadableError(f"broken: {header.points} points cannot be packed as {size} bytes in {packed}")
    whole = unpacked(body[8 : 8 + packed], size)
    starts = np.cumsum([0, *sizes])
    return {name: np.frombuffer(whole, header.kinds[i], header.points, starts[i]) for i, name in _firsts(header)}


_COLUMNS = {"ascii": _of_text, "binary": _of_bytes, "binary_compressed": _of_packed}


def _firsts(header: _Header) -> list[tuple[int, str]]:
    """Each name with its first place: of a field of several values, the first of them."""
    return [(header.names.index(name), name) for name in dict.fromkeys(header.names)]


def _stacked(columns: _Columns, names: Sequence[str]) -> Floats:
    return np.stack([columns[name].astype(np.float64) for name in names], axis=-1)
