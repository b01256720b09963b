"""Points as lines of numbers: XYZ as many programs write it, and PTS, which begins with the number of its points."""

from __future__ import annotations

import re

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.cloud import Cloud
from shapewright.references.readers.text import PADDING, Rows, plain, rows, shown
from shapewright.shapes import Floats

_COMMENT = re.compile(rb"^[ \t]*(?:#|//|;|%)[^\r\n]*", re.MULTILINE)
_TITLES = re.compile(rb"\A\s*\"?[A-Za-z_][^\r\n]*")  # one line of names above the columns
_MOLECULE = re.compile(rb"\A\s*\d+[ \t]*\r?\n[^\n]*\n[ \t]*[A-Z][a-z]?[ \t]+-?[\d.]+[ \t]+-?[\d.]+[ \t]+-?[\d.]+")
_UNIT = 0.01  # by how much the length of a normal may be off: programs round to three digits
_RARE = 0.01  # share of normals that may be missing: of length 0


def read_xyz(data: bytes) -> Cloud:
    """The points of lines of three numbers and more, separated by white space, commas or semicolons.

    Three columns that are all of length 1 are normals; other columns are passed over, with a note. Raises
    UnreadableError for lines of other lengths, and for words.
    """
    return _cloud(_table(data))


def read_pts(data: bytes) -> Cloud:
    """As ``read_xyz``, with the number of points on a line before them; of several clouds too, one behind the other."""
    table = _table(data)
    counted = np.flatnonzero(table.lengths == 1)
    if not len(counted):
        return _cloud(table)
    if counted[0] != 0:
        raise UnreadableError(f"broken: line {int(counted[0]) + 1} holds one number, among lines of points")
    declared = table.values[table.starts[counted]]
    there = np.diff([*counted, len(table)]) - 1
    if (wrong := np.flatnonzero(declared != there)).size:
        first = int(wrong[0])
        less = "cut short" if declared[first] > there[first] else "broken"
        raise UnreadableError(f"{less}: it declares {declared[first]:g} points and holds {there[first]}")
    points = np.ones(len(table.values), dtype=bool)
    points[table.starts[counted]] = False
    lengths = np.delete(table.lengths, counted)
    return _cloud(Rows(table.values[points], np.concatenate([[0], np.cumsum(lengths)])))


def _table(data: bytes) -> Rows:
    text = plain(data).rstrip(PADDING)
    if _MOLECULE.match(text):
        raise UnreadableError("a molecule, whose atoms are no points of a surface")
    if b"#" in text or b"/" in text or b";" in text or b"%" in text:
        text = _COMMENT.sub(b"", text)
    text = _TITLES.sub(b"", text)
    if b";" in text:
        text = text.replace(b";", b" ")
    # A comma among points and beside blanks is one of decimals, which ``rows`` refuses.
    if b"," in text and (b"." in text or b", " in text or not re.search(rb"\S[ \t]+\S", text)):
        text = text.replace(b",", b" ")
    return rows(text)


def _cloud(table: Rows) -> Cloud:
    lengths = table.lengths
    if not len(table):
        raise UnreadableError("it holds no points")
    width = int(np.median(lengths))
    if (odd := np.flatnonzero(lengths != width)).size:
        which = int(odd[0])
        values = table.values[table.starts[which] : table.starts[which + 1]]
        line = shown(" ".join(f"{value:g}" for value in values).encode())
        raise UnreadableError(f"broken: row {which + 1} has {lengths[which]} numbers, others have {width}: {line}")
    if width < 3:
        raise UnreadableError(f"its rows have {width} numbers, fewer than a point's three")
    values = table.values.reshape(-1, width)
    first = next((c for c in range(3, width - 2) if are_normals(values[:, c : c + 3])), None)
    left = width - (3 if first is None else 6)
    notes = (f"{left} more columns left out, such as colours",) if left else ()
    return Cloud(values[:, :3], None if first is None else values[:, first : first + 3], None, notes)


def are_normals(values: Floats) -> bool:
    """Whether columns (N, 3) are directions: of length 1, but for a few of length 0."""
    with np.errstate(over="ignore", invalid="ignore"):
        lengths = np.linalg.norm(values, axis=1)
    directions = np.abs(lengths - 1.0) < _UNIT
    return bool((directions | (lengths == 0.0)).all() and directions.mean() > 1.0 - _RARE)
