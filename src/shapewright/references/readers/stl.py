"""STL, binary or text. A file is binary when its size says so: many binary ones begin with the word "solid" too.

Not through trimesh, which regroups the corners of quads by three, and refuses names that are not UTF-8, other line
ends, and files without "endsolid". Normals, colours and attributes are passed over.
"""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.parts import PartName, Parts
from shapewright.references.readers.polygons import Polygons
from shapewright.references.readers.text import LONG, PADDING, numbers, plain, shown
from shapewright.shapes import Floats, Ints

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER, _COUNT = 80, 4  # bytes of a binary file before the number of its triangles, and of that number
_FACET = (
    # Of the normal any part may be missing. A word that follows must not be a keyword of a broken file.
    rb"\s*+facet(?:\s++(?!outer|vertex|end|facet)[^\s]++){0,4}+\s++outer\s++loop"
    rb"((?:\s++vertex(?:\s++(?!vertex|end)[^\s]++){3})*+)\s++endloop\s++endfacet(?=\s|\Z)"
)
_SMALL, _ANY = re.compile(_FACET), re.compile(_FACET, re.IGNORECASE)  # small letters are found 1.4 times as fast
_SOLID = re.compile(
    rb"\s*+solid(?=\s|\Z)[^\r\n]*?(?=[\r\n]|\s+facet\s+(?:normal|outer)\s|\s+endsolid|\Z)", re.IGNORECASE
)
_ENDSOLID = re.compile(rb"\s*+endsolid(?=\s|\Z)[^\r\n]*?(?=[\r\n]|\s+solid\s[^\r\n]*?facet\s|\Z)", re.IGNORECASE)
_AT_ONCE = 50_000
"""Facets whose text is held at once, 6 MB of it."""
_ODD = 1000
"""Facets of a long text from one on that a kernel cannot read."""


def read_stl(data: bytes) -> Polygons:
    """The triangles of an STL file's bytes, and the polygons of facets with more corners, of all its solids.

    Raises UnreadableError for a file that is broken or cut short.
    """
    if _declared(data, 0) is not None and len(data) == _end(data, 0):
        return _binary(data)
    text = plain(data)
    if _SOLID.match(text):
        return _text(text)
    if len(data) < _HEADER + _COUNT:
        raise UnreadableError(f"broken: neither text that begins with 'solid' nor binary: it has {len(data)} bytes")
    return _binary(data)


def _declared(data: bytes, start: int) -> int | None:
    """The number of triangles that a binary solid declares; None where its header does not fit."""
    at = start + _HEADER
    return int.from_bytes(data[at : at + _COUNT], "little") if len(data) >= at + _COUNT else None


def _end(data: bytes, start: int) -> int:
    return start + _HEADER + _COUNT + _TRIANGLE.itemsize * (_declared(data, start) or 0)


def _binary(data: bytes) -> Polygons:
    """One binary solid, or several of them one behind the other."""
    corners: list[Floats] = []
    notes: tuple[str, ...] = ()
    start = 0
    while start == 0 or _declared(data, start) is not None:
        declared, end = _declared(data, start) or 0, _end(data, start)
        there, odd = divmod(len(data) - start - _HEADER - _COUNT, _TRIANGLE.itemsize)
        if not declared and there and not odd and start == 0:  # a program that did not go back to write the number
            declared, end = there, len(data)
            notes = (f"its header declares no triangles, its size says {there}: these are read",)
        if end > len(data):
            if start:
                break
            raise UnreadableError(f"cut short: it declares {declared} triangles and has bytes for {there}")
        triangles = np.frombuffer(data, _TRIANGLE, declared, start + _HEADER + _COUNT)
        corners.append(triangles["corners"].reshape(-1, 3).astype(np.float64))
        start = end
    if data[start:].strip(PADDING):
        notes = (*notes, f"{len(data) - start} bytes behind its last triangle left out")
    return _facets(corners, [np.full(len(points) // 3, 3) for points in corners], notes)


def _text(text: bytes) -> Polygons:
    points: list[Floats] = []
    counts: list[Ints] = []
    at, facets, opened, name = 0, 0, False, PartName()
    solids: list[tuple[PartName, int]] = []
    long = len(text) >= LONG
    room = np.empty((3 * text.count(b"endfacet"), 3)) if long else np.empty((0, 3))
    while at < len(text):
        if len(room):
            found, at = _long_facets(text, at, room)
            points += [room[: 3 * found]] if found else []
            counts.append(np.full(found, 3))
            solids.append((name, found))
            facets, room = facets + found, room[3 * found :]
        loops: list[bytes] = []
        while len(loops) < (_ODD if long else _AT_ONCE) and (facet := _SMALL.match(text, at) or _ANY.match(text, at)):
            loops.append(facet[1].lower())
            at = facet.end()
        if loops:
            points.append(numbers(b"".join(loops).replace(b"vertex", b"")).reshape(-1, 3))
            counts.append(np.array([loop.count(b"vertex") for loop in loops], dtype=np.int64))
            facets += len(loops)
            solids.append((name, len(loops)))
        elif solid := _SOLID.match(text, at):
            at, opened = solid.end(), True
            name = PartName.of(solid[0].strip()[len(b"solid") :])
        elif end := _ENDSOLID.match(text, at):
            at, opened = end.end(), False
        else:
            rest = text[at:].strip(PADDING)
            if not rest:
                break
            if b"endfacet" not in rest.lower():
                raise UnreadableError(f"cut short: it ends in facet {facets + 1}, with {shown(rest)}")
            raise UnreadableError(f"broken: facet {facets + 1} cannot be understood: {shown(rest)}")
    few = sum(int((of < 3).sum()) for of in counts)
    if few:
        raise UnreadableError(f"broken: {few} of its facets have fewer than three corners")
    notes = ("the last solid has no 'endsolid': the file may be cut short",) if opened else ()
    return replace(_facets(points, counts, notes), parts=Parts.of(solids))


def _long_facets(text: bytes, at: int, room: Floats) -> tuple[int, int]:
    """Put the corners of triangles into ``room`` (3 F, 3), from a place on, as far as a kernel reads facets.

    Returns how many triangles there are, and the place behind the last.
    """
    from shapewright.references.readers.kernels.words import stl_facets

    return stl_facets(np.frombuffer(text, np.uint8), at, room)


def _facets(points: list[Floats], counts: list[Ints], notes: tuple[str, ...]) -> Polygons:
    """Polygons of which each corner has a vertex of its own."""
    vertices = points[0] if len(points) == 1 else np.concatenate([np.empty((0, 3)), *points])
    return Polygons(vertices, np.arange(len(vertices)), np.concatenate([np.empty(0, np.int64), *counts]), notes)
