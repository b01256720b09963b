"""Stanford PLY, ASCII or binary, with polygons of any and of mixed numbers of corners.

Not through trimesh, which cannot read binary files that mix triangles with quads, and cuts concave polygons as fans.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.polygons import Polygons
from shapewright.shapes import Ints

_OLD_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4"}
_NEW_TYPES = {f"{sign}int{8 * size}": f"{sign or 'i'}{size}" for sign in ("", "u") for size in (1, 2, 4, 8)}
_FLOAT_TYPES = {"float": "f4", "float32": "f4", "double": "f8", "float64": "f8"}
_TYPES = _OLD_TYPES | _NEW_TYPES | _FLOAT_TYPES
_STRUCT = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "i8": "q", "u8": "Q", "f4": "f", "f8": "d"}
_END = re.compile(rb"[\r\n]end_header *(?:\r\n|\r|\n)")
_ORDER = {"ascii": "<", "binary_little_endian": "<", "binary_big_endian": ">"}


@dataclass(frozen=True)
class _Property:
    """One property of an element; ``length`` is the type of the count before a list, None for a single value."""

    name: str
    type: str
    length: str | None = None


@dataclass(frozen=True)
class _Element:
    name: str
    count: int
    properties: tuple[_Property, ...]


@dataclass(frozen=True, eq=False)
class _Column:
    """The values of a property in all rows, one row after the other, and how many each row has."""

    values: np.ndarray[tuple[int], np.dtype[np.generic]]
    counts: Ints


def read_ply(data: bytes) -> Polygons:
    """The polygons of a PLY file's bytes. Raises UnreadableError for a file that is broken or cut short."""
    encoding, elements, body = _header(data)
    if encoding == "ascii":
        # Numbers as text are laid out like a binary file whose every type is a double.
        body = np.array(body.split(), dtype=np.float64).tobytes()
        elements = [replace(e, properties=tuple(_as_double(p) for p in e.properties)) for e in elements]
    tables: dict[str, Mapping[str, _Column]] = {}
    start = 0
    for element in elements:
        tables[element.name], start = _table(element, body, start, _ORDER[encoding])
        if {"vertex", "face"} <= tables.keys():
            break
    if "vertex" not in tables:
        raise UnreadableError("it has no vertices")
    vertices = np.stack([tables["vertex"][axis].values.astype(np.float64) for axis in "xyz"], axis=-1)
    if "tristrips" in tables and "face" not in tables:
        raise UnreadableError("it holds triangle strips, which are not read; save it with plain faces")
    faces = tables.get("face", {})
    loops = faces.get("vertex_indices") or faces.get("vertex_index")
    if loops is None:
        return Polygons(vertices, np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64))
    return Polygons(vertices, loops.values.astype(np.int64), loops.counts)


def _header(data: bytes) -> tuple[str, list[_Element], bytes]:
    """The encoding, the elements and the bytes behind the header."""
    end = _END.search(data)
    lines = [line.split() for line in data[: end.start()].decode("latin-1").splitlines() if line.split()] if end else []
    if end is None or lines[:1] != [["ply"]]:
        raise UnreadableError("broken: no PLY header")
    encoding, elements = "", list[_Element]()
    for fields in lines:
        match fields:
            case ["format", word, *_]:
                encoding = word
            case ["element", name, count]:
                elements.append(_Element(name, int(count), ()))
            case ["property", "list", length, kind, name] if elements:
                elements[-1] = _with(elements[-1], _Property(name, _TYPES[kind], _TYPES[length]))
            case ["property", kind, name] if elements:
                elements[-1] = _with(elements[-1], _Property(name, _TYPES[kind]))
    if encoding not in _ORDER:
        raise UnreadableError(f"broken: unknown PLY format {encoding!r}")
    return encoding, elements, data[end.end() :]


def _with(element: _Element, added: _Property) -> _Element:
    return replace(element, properties=(*element.properties, added))


def _as_double(p: _Property) -> _Property:
    return replace(p, type="f8", length="f8" if p.length else None)


def _table(element: _Element, body: bytes, start: int, order: str) -> tuple[Mapping[str, _Column], int]:
    """The columns of an element that begins at ``start`` of the body, and where the next one begins."""
    lengths = _first_lengths(element, body, start, order)
    fields = list[tuple[str, str] | tuple[str, str, tuple[int]]]()
    pairs = list(zip(element.properties, lengths, strict=True))
    for p, length in pairs:
        fields += [(f"{p.name} count", order + p.length)] if p.length else []
        fields += [(p.name, order + p.type, (length,))]
    row = np.dtype(fields)
    end = start + row.itemsize * element.count
    if end <= len(body):
        rows = np.frombuffer(body, row, element.count, start)
        if all((rows[f"{p.name} count"] == length).all() for p, length in pairs if p.length):
            columns = {p.name: _Column(rows[p.name].reshape(-1), np.full(len(rows), n)) for p, n in pairs}
            return columns, end
    if any(p.length for p in element.properties):
        return _ragged_table(element, body, start, order)
    raise _cut_short(element)


def _first_lengths(element: _Element, body: bytes, start: int, order: str) -> list[int]:
    """How many values each property has in the first row."""
    if not element.count:
        return [1 for _ in element.properties]
    first, _ = _ragged_table(replace(element, count=1), body, start, order)
    return [int(first[p.name].counts[0]) for p in element.properties]


def _ragged_table(element: _Element, body: bytes, start: int, order: str) -> tuple[Mapping[str, _Column], int]:
    """The same row by row, for lists whose lengths differ."""
    values: dict[str, list[float]] = {p.name: [] for p in element.properties}
    counts: dict[str, list[int]] = {p.name: [] for p in element.properties}
    sizes = {p: np.dtype(p.type).itemsize for p in element.properties}
    prefixes = {p: struct.Struct(order + _STRUCT[p.length]) for p in element.properties if p.length}
    try:
        for _ in range(element.count):
            for p in element.properties:
                length = 1
                if p.length:
                    length = int(prefixes[p].unpack_from(body, start)[0])
                    start += prefixes[p].size
                values[p.name].extend(struct.unpack_from(f"{order}{length}{_STRUCT[p.type]}", body, start))
                counts[p.name].append(length)
                start += length * sizes[p]
    except struct.error as error:
        raise _cut_short(element) from error
    columns = {name: _Column(np.array(values[name]), np.array(counts[name], dtype=np.int64)) for name in values}
    return columns, start


def _cut_short(element: _Element) -> UnreadableError:
    return UnreadableError(f"cut short: it ends among its {element.count} elements {element.name!r}")
