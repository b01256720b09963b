"""Stanford PLY, ASCII or binary, with polygons of any and of mixed numbers of corners, triangle strips, or points.

Not through trimesh, which cannot read binary files that mix triangles with quads, and cuts concave polygons as fans.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds import gaussians
from shapewright.references.readers.clouds.cloud import Cloud
from shapewright.references.readers.ply_tables import TYPES, Column, Element, Property, ascii_tables, binary_tables
from shapewright.references.readers.polygons import Polygons
from shapewright.references.readers.text import PADDING, plain, shown
from shapewright.shapes import Floats, Ints

_BEGIN = re.compile(rb"ply[ \t]*(\r\n|\r|\n)", re.IGNORECASE)
_ORDER = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_NORMALS = ("nx", "ny", "nz")
_KNOWN = ("vertex", "face", "tristrips", "edge")
_RESTART = -1  # in the list of a strip: a new strip begins


def read_ply(data: bytes) -> Polygons | Cloud:
    """The polygons of a PLY file's bytes, or its points where it has no faces, strips or edges.

    Raises UnreadableError for a file that is broken or cut short.
    """
    encoding, elements, body = _header(plain(data))
    if encoding == "ascii":
        tables, notes = ascii_tables(elements, body.rstrip(PADDING))
    else:
        tables, notes = binary_tables(elements, body, _ORDER[encoding])
    if "vertex" not in tables:
        raise UnreadableError(f"it has no vertices, only {', '.join(tables) or 'a header'}")
    points = _points(tables["vertex"])
    faces = _lists(tables, "face")
    strips = _lists(tables, "tristrips")
    odd = [e for e in elements if e.name not in _KNOWN and any(p.length for p in e.properties) and e.count]
    if odd and not (faces or strips):
        raise UnreadableError(f"it holds no faces but elements {odd[0].name!r}, which are not read")
    notes = (*notes, *(f"{e.count} elements {e.name!r} left out" for e in odd))
    if not (faces and len(faces.counts)) and not strips and not any(e.count for e in elements if e.name == "edge"):
        return _cloud(points, tables["vertex"], notes)
    corners, counts = (_whole(faces.values), faces.counts) if faces else (np.empty(0, np.int64), np.empty(0, np.int64))
    if strips:
        triangles = _triangles(_whole(strips.values), strips.counts)
        corners = np.concatenate([corners, triangles.reshape(-1)])
        counts = np.concatenate([counts, np.full(len(triangles), 3)])
    return Polygons(points, corners, counts, notes)


def _header(data: bytes) -> tuple[str, tuple[Element, ...], bytes]:
    """The encoding, the elements and the bytes behind the header."""
    begin = _BEGIN.match(data)
    # Where lines end in one \r, a \n is the first byte of the body.
    end = re.compile(rb"[\r\n]end_header[ \t]*(?:%b|\Z)" % (begin[1] if begin else b"")).search(data) if begin else None
    if begin is None or end is None:
        raise UnreadableError("broken: no PLY header")
    encoding, elements = "", list[Element]()
    for line in data[begin.end() : end.start()].decode("latin-1").splitlines():
        match line.split():
            case [] | ["comment" | "obj_info", *_]:
                pass
            case ["format", word, *_]:
                encoding = word
            case ["element", name, count] if count.isdecimal():
                elements.append(Element(name.casefold(), int(count), ()))
            case ["property", "list", length, kind, name] if elements and {length, kind} <= TYPES.keys():
                elements[-1] = elements[-1].having(Property(name.casefold(), TYPES[kind], TYPES[length]))
            case ["property", kind, name] if elements and kind in TYPES:
                elements[-1] = elements[-1].having(Property(name.casefold(), TYPES[kind]))
            case _:
                raise UnreadableError(f"broken: cannot understand the line {shown(line.encode())} of the header")
    if encoding not in _ORDER:
        raise UnreadableError(f"broken: unknown PLY format {encoding!r}")
    names = [element.name for element in elements]
    if twice := {name for name in names if names.count(name) > 1}:
        raise UnreadableError(f"broken: the header declares {min(twice)!r} twice")
    return encoding, tuple(elements), data[end.end() :]


def _points(columns: Mapping[str, Column]) -> Floats:
    if missing := [axis for axis in "xyz" if axis not in columns or columns[axis].is_list]:
        raise UnreadableError(f"its vertices have no property {missing[0]!r}, only {', '.join(columns)}")
    return _stacked(columns, "xyz")


def _stacked(columns: Mapping[str, Column], names: Iterable[str]) -> Floats:
    return np.stack([columns[name].values.astype(np.float64) for name in names], axis=-1)


def _cloud(points: Floats, columns: Mapping[str, Column], notes: tuple[str, ...]) -> Cloud:
    if gaussians.is_gaussians(columns):
        splats = gaussians.of_ply(points, columns["opacity"].values)
        return replace(splats, notes=(*notes, *splats.notes))
    known = all(name in columns and not columns[name].is_list for name in _NORMALS)
    return Cloud(points, _stacked(columns, _NORMALS) if known else None, notes=notes)


def _lists(tables: Mapping[str, Mapping[str, Column]], name: str) -> Column | None:
    """The corners of the faces or strips; None where the file has none. Raises UnreadableError for another name."""
    columns = tables.get(name, {})
    fitting = [key for key in columns if key.replace("_", "").startswith(("vertexind", "vertind", "indices"))]
    if len(fitting) == 1 and columns[fitting[0]].is_list:
        return columns[fitting[0]]
    if any(len(column.counts) for column in columns.values()):
        raise UnreadableError(f"its elements {name!r} have no one list 'vertex_indices', only {', '.join(columns)}")
    return None


def _whole(values: np.ndarray[tuple[int], np.dtype[np.generic]]) -> Ints:
    if values.dtype.kind == "f" and not np.all(np.mod(values, 1.0) == 0.0):  # also NaN and infinity
        raise UnreadableError("broken: a face has a corner that is no whole number")
    return np.asarray(values.astype(np.int64))


def _triangles(corners: Ints, counts: Ints) -> Ints:
    """(F, 3): those of strips, every second one turned round, without those that only lead on to the next."""
    padded = np.insert(corners, np.cumsum(counts) - counts, _RESTART)
    restarts = np.append(padded, [_RESTART, _RESTART]) == _RESTART
    at = np.flatnonzero(~(restarts[:-2] | restarts[1:-1] | restarts[2:]))
    begins = np.maximum.accumulate(np.where(restarts[:-2], np.arange(len(padded)), 0)) + 1
    faces = padded[at[:, None] + np.arange(3)]
    turned = (at - begins[at]) % 2 == 1
    faces[turned] = faces[turned][:, [1, 0, 2]]
    a, b, c = faces.T
    return np.asarray(faces[(a != b) & (b != c) & (c != a)])
