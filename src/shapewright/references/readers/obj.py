"""Wavefront OBJ: vertices, faces, and the names of groups and materials; textures and normals are passed over.

Not through trimesh, which counts relative indices from the end of the file instead of from the face, and cuts concave
polygons as fans.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.parts import PartName, Parts
from shapewright.references.readers.clouds.cloud import Cloud
from shapewright.references.readers.polygons import Polygons
from shapewright.references.readers.text import Rows, lines, numbers, plain, rows, shown
from shapewright.shapes import Floats, Ints

_SURFACES = frozenset(b"curv curv2 surf bzp bsp cdc cdp res".split())
_NAMES = frozenset(b"o g usemtl mtllib usemap maplib".split())
"""Keywords that names follow, which may end in a backslash."""
_NAMING = frozenset(b"o g usemtl".split())
"""Those that name the faces below them."""
_OTHERS = frozenset(
    b"vt vn vp s mg lod l p shadow_obj trace_obj bevel c_interp d_interp ctech stech cstype deg bmat step parm trim "
    b"hole scrv sp end con".split()
)
"""The keywords of version 3.0 that are passed over (Wavefront, "Advanced Visualizer Manual", appendix B1)."""
_AT_ONCE = 10_000
"""Lines whose text is held at once, 1 MB of it: it stays in the cache of a core."""
_COMMENT = re.compile(rb"(?<!\d\.)#[^\n]*+")  # but not in 1.#IND


def read_obj(data: bytes) -> Polygons | Cloud:
    """The polygons of an OBJ file's bytes, or its vertices where it has nothing else.

    Raises UnreadableError with the line that cannot be understood.
    """
    points, corners, counts = [np.empty((0, 3))], [np.empty(0, np.int64)], [np.empty(0, np.int64)]
    others: Counter[bytes] = Counter()
    above = polygons = 0
    part = PartName()
    begun = [(part, 0)]  # parts, each with the polygons above it
    text = plain(data)
    left = _continued(lines(text)) if b"\\" in text else lines(text)
    while batch := list(islice(left, _AT_ONCE)):
        vertices: list[bytes] = []
        faces: list[bytes] = []
        before: list[int] = []  # vertices above each face, from which relative indices count
        for line in batch:
            keyword, *rest = line.split(None, 1) or (b"#",)
            if keyword == b"v":
                vertices += rest or [b""]
            elif keyword in (b"f", b"fo"):  # "fo" is that of version 2
                faces += rest or [b""]
                before.append(above + len(vertices))
            elif not keyword.startswith(b"#"):
                others[keyword] += 1
                if keyword in _NAMING:
                    part = _named(keyword, rest, part)
                    begun.append((part, polygons + len(before)))
        points.append(_points(vertices))
        indices, sizes = _corners(faces, before)
        corners.append(indices)
        counts.append(sizes)
        above += len(vertices)
        polygons += len(before)
    ends = [*(start for _, start in begun[1:]), polygons]
    parts = Parts.of((part, end - start) for (part, start), end in zip(begun, ends, strict=True))
    notes = tuple(_notes(others))
    if above and not polygons and not others.keys() & (_SURFACES | {b"l"}):
        return Cloud(np.concatenate(points), notes=notes)
    return Polygons(np.concatenate(points), np.concatenate(corners), np.concatenate(counts), notes, parts)


def _named(keyword: bytes, rest: Sequence[bytes], before: PartName) -> PartName:
    """The part of the faces below a line with a name: an object or a group, whichever comes last, or a material."""
    name = rest[0] if rest else b""
    return (
        PartName(before.name, PartName.of(b"", name).material)
        if keyword == b"usemtl"
        else PartName.of(name, before.material)
    )


def _points(lines: Sequence[bytes]) -> Floats:
    places = _table(b"v", lines, 3)
    return np.asarray(places.values[places.starts[:-1, None] + np.arange(3)])


def _corners(lines: Sequence[bytes], before: Sequence[int]) -> tuple[Ints, Ints]:
    """The corners of faces, one face after the other, and how many each face has."""
    table = _table(b"f", lines, 1)
    if len(odd := np.flatnonzero(table.values % 1.0 != 0.0)):
        raise UnreadableError(f"broken: a face has the corner {table.values[odd[0]]:g}")
    indices = table.values.astype(np.int64)
    relative = (
        np.repeat(np.array(before, dtype=np.int64), table.lengths) + indices
    )  # where it is negative: before the first vertex
    return np.where(indices < 0, relative, indices - 1), table.lengths


def _continued(lines: Iterable[bytes]) -> Iterator[bytes]:
    """The lines, each that ends in a backslash with the next; those of comments and names stay apart."""
    held = b""
    for line in lines:
        line = held + line
        end = line.rstrip()
        keyword = line.split(None, 1)[:1]
        continues = end.endswith(b"\\") and not (keyword[0].startswith(b"#") or keyword[0] in _NAMES)
        held = end[:-1] + b" " if continues else b""
        if not continues:
            yield line
    if held:
        yield held


def _table(keyword: bytes, lines: Sequence[bytes], least: int) -> Rows:
    """The numbers of the lines of one keyword, of a corner the first index only."""
    text = b"\n".join(lines)
    if b"#" in text:
        text = _COMMENT.sub(b"", text)
    if b"/" in text and keyword == b"f":
        text = _without_attributes(text)
    try:
        table = rows(text)
        if len(table) == len(lines) and (not lines or table.lengths.min() >= least):
            return table
        why = ""
    except UnreadableError as error:
        why = str(error).removeprefix("broken: ")
    for number, line in enumerate(text.split(b"\n")):
        try:
            enough = len(numbers(line)) >= least
        except UnreadableError:
            enough = False
        if not enough:
            whole = keyword + b" " + lines[number]
            raise UnreadableError(f"broken: cannot understand the line {shown(whole)}" + (f": {why}" if why else ""))
    raise UnreadableError(f"broken: {why}")


def _without_attributes(text: bytes) -> bytes:
    """The words, each up to its first slash."""
    letters = np.frombuffer(text, np.uint8)
    gaps = letters <= ord(" ")
    slashes = np.cumsum(letters == ord("/"), dtype=np.int32)
    before = np.maximum.accumulate(np.where(gaps, slashes, 0))  # the word
    return np.where((slashes > before) & ~gaps, np.uint8(ord(" ")), letters).tobytes()


def _notes(others: Counter[bytes]) -> Iterator[str]:
    surfaces = sum(others[keyword] for keyword in _SURFACES)
    if surfaces:
        yield f"{surfaces} free-form curves or surfaces left out; export them as polygons"
    unknown = {key: count for key, count in others.items() if key not in _SURFACES | _NAMES | _OTHERS}
    for keyword in unknown:
        if keyword[:1] in b"0123456789-+.":
            raise UnreadableError(f"broken: a line begins with {shown(keyword)}, where a keyword is expected")
    if unknown:
        first = next(iter(unknown))
        yield f"{sum(unknown.values())} lines left out, the first of them begins with {shown(first)}"
