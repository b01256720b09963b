"""Object File Format (Geomview): OFF and its kinds with normals, colours or texture coordinates, which are passed over.

Not through trimesh, which cuts concave polygons as fans. Usually each vertex and each face has a line of its own.
Geomview goes by words, so a file of another form is read by words.
"""

from __future__ import annotations

import re

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.cloud import Cloud
from shapewright.references.readers.polygons import Polygons
from shapewright.references.readers.text import PADDING, Rows, plain, rows, shown
from shapewright.shapes import Floats, Ints

# Some collections write the counts right behind the word, without a space (ModelNet).
_WORD = re.compile(rb"\s*((?:ST|C|N|4|n)*+)OFF(?=[\s\d]|\Z)|\s*((?:st|c|n|4)*+)off(?=[\s\d]|\Z)")
_BINARY = re.compile(rb"(?:\s*#[^\r\n]*+)*\s*(?:ST|C|N|4|n)*+OFF[ \t]+BINARY", re.IGNORECASE)
_COLOUR = 4  # values of a colour, which some programs write undeclared
_COMMENT = re.compile(rb"(?<!\d\.)#[^\r\n]*+")  # but not in 1.#IND


def read_off(data: bytes) -> Polygons | Cloud:
    """The polygons of an OFF file's bytes, or its vertices where it has no faces.

    Raises UnreadableError for another kind of file, or one that ends early.
    """
    if _BINARY.match(data):
        raise UnreadableError("binary OFF, which is not read; save it as text, or as PLY")
    text = plain(data).rstrip(PADDING)
    if b"#" in text:
        text = _COMMENT.sub(b"", text)
    word = _WORD.match(text)
    if word is None and not re.match(rb"\s*\d+\s+\d+\s", text):
        raise UnreadableError(f"broken: does not begin with OFF, but with {shown(text.lstrip())}")
    kind = (word[1] or word[2] or b"") if word else b""
    table = rows(text[word.end() :] if word else text)
    if b"n" in kind and word and word[1]:
        if table.values[:1].tolist() != [3.0]:
            raise UnreadableError("its vertices have more or fewer than 3 dimensions")
        table = Rows(table.values[1:], np.unique(np.maximum(table.starts - 1, 0)))
    width = 4 if b"4" in kind else 3
    if len(table.values) < 2 or (table.values[:2] < 0).any() or (table.values[:2] % 1 != 0).any():
        raise UnreadableError("broken: no numbers of vertices and faces behind the word OFF")
    counted = (int(table.values[0]), int(table.values[1]))
    first = _first_row(table)
    if len(table) - first == sum(counted):
        return _or_points(_by_lines(table, first, counted, width))
    declared = width + 3 * (b"N" in kind) + 4 * (b"C" in kind) + 2 * (b"ST" in kind)
    polygons = None if _is_usual(table, first, width, declared) else _by_words(table, counted, width, declared)
    if polygons is None:
        announced = f"{counted[0]} vertices and {counted[1]} faces announced"
        if len(table) - 1 < sum(counted):
            raise UnreadableError(f"cut short: {announced}, fewer there")
        raise UnreadableError(f"broken: {announced}, and it holds more")
    return _or_points(polygons)


def _or_points(polygons: Polygons) -> Polygons | Cloud:
    return polygons if len(polygons.counts) else Cloud(polygons.vertices, notes=polygons.notes)


def _first_row(table: Rows) -> int:
    """The first line behind the numbers of vertices, faces and edges; that of edges is missing in some files."""
    lengths = table.lengths
    return 2 if len(table) > 1 and lengths[0] == 2 and lengths[1] == 1 else 1


def _by_lines(table: Rows, first: int, counted: tuple[int, int], width: int) -> Polygons:
    starts, lengths = table.starts[first:-1], table.lengths[first:]
    points, loops = starts[: counted[0]], starts[counted[0] :]
    counts = table.values[loops]
    if not np.all((counts >= 0) & (counts % 1.0 == 0.0)):
        raise UnreadableError("broken: a face whose number of corners is no whole number")
    short = lengths < np.concatenate([np.full(len(points), width), counts + 1])
    if short.any():
        which = int(np.flatnonzero(short)[0])
        what = f"vertex {which}" if which < len(points) else f"face {which - len(points)}"
        raise UnreadableError(f"broken: the line of {what} has too few numbers")
    sizes = lengths[: len(points)]
    uneven = int((sizes != sizes[0]).sum()) if len(points) else 0
    notes = (f"{uneven} lines of vertices are longer or shorter than the first",) if uneven else ()
    at = np.repeat(loops + 1 - (np.cumsum(counts) - counts), counts.astype(np.int64)) + np.arange(int(counts.sum()))
    return _polygons(table.values[points[:, None] + np.arange(width)], table.values[at.astype(np.int64)], counts, notes)


def _is_usual(table: Rows, first: int, width: int, declared: int) -> bool:
    """Whether lines of one vertex each come before lines of one face each, however many are announced.

    Such a file read by words would give other faces, and sometimes use it up.
    """
    lengths = table.lengths[first:]
    sizes = table.values[table.starts[first:-1]]
    no_face = np.flatnonzero((sizes < 1) | (lengths < 1 + sizes))
    vertices = lengths[: int(no_face[-1]) + 1 if len(no_face) else 0]
    return len(lengths) > 1 and bool(((vertices >= width) & (vertices <= declared + _COLOUR)).all())


def _by_words(table: Rows, counted: tuple[int, int], width: int, declared: int) -> Polygons | None:
    """Line ends mean nothing but, where faces have colours, the end of a face; None where words are left or missing."""
    values = table.values
    head = 2 if table.lengths[0] == 2 and _first_row(table) == 1 else 3
    body = head + counted[0] * declared
    for coloured in (False, True):
        loops = _loops(table, body, counted[1], coloured) if body <= len(values) else None
        if loops is not None:
            corners = [values[at + 1 : at + 1 + int(values[at])] for at in loops]
            points = values[head:body].reshape(-1, declared)[:, :width]
            return _polygons(points, np.concatenate([np.empty(0), *corners]), values[loops])
    return None


def _loops(table: Rows, start: int, count: int, coloured: bool) -> list[int] | None:
    """Where each face begins; None where they do not end with the file."""
    values, loops, at = table.values, list[int](), start
    while at < len(values) and len(loops) < count:
        size = float(values[at])
        if coloured and table.starts[np.searchsorted(table.starts, at)] != at:
            return None
        if size < 0 or size % 1.0 != 0.0 or at + 1 + size > len(values):
            return None
        loops.append(at)
        at += 1 + int(size)
        if coloured:
            at = int(table.starts[np.searchsorted(table.starts, at)])
    return loops if len(loops) == count and at == len(values) else None


def _polygons(points: Floats, corners: Floats, counts: Floats, notes: tuple[str, ...] = ()) -> Polygons:
    if (corners % 1.0 != 0.0).any():
        raise UnreadableError("broken: a face has a corner that is no whole number")
    if points.shape[1] == 4:  # homogeneous coordinates
        with np.errstate(divide="ignore", invalid="ignore"):
            points = points[:, :3] / points[:, 3:]
    return Polygons(points, whole(corners), whole(counts), notes)


def whole(values: Floats) -> Ints:
    """Numbers that are whole, as such."""
    return np.asarray(values.astype(np.int64))
