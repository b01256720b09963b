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
from shapewright.references.readers.text import LONG, Rows, lines, numbers, plain, rows, shown
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
_BLOCK, _ODD, _WORTH = 2**22, 2**19, 2**12
"""Bytes of long texts: of lines that kernels read at once, of lines around one that they cannot read, and of lines
before a name for which they are worth a call."""
_COMMENT = re.compile(rb"(?<!\d\.)#[^\n]*+")  # but not in 1.#IND


def read_obj(data: bytes) -> Polygons | Cloud:
    """The polygons of an OBJ file's bytes, or its vertices where it has nothing else.

    Raises UnreadableError with the line that cannot be understood.
    """
    text = plain(data)
    read = _Read()
    if len(text) >= LONG and b"\\" not in text:
        read.add_long(text)
    else:
        left = _continued(lines(text)) if b"\\" in text else lines(text)
        while batch := list(islice(left, _AT_ONCE)):
            read.add_lines(batch)
    return read.result()


class _Read:
    """What has been read of a file, up to some line."""

    def __init__(self) -> None:
        self.points, self.corners, self.counts = [np.empty((0, 3))], [np.empty(0, np.int64)], [np.empty(0, np.int64)]
        self.others: Counter[bytes] = Counter()
        self.vertices = self.polygons = 0
        self.part = PartName()
        self.begun = [(self.part, 0)]  # parts, each with the polygons above it

    def add(self, points: Floats, corners: Ints, counts: Ints) -> None:
        self.points.append(points)
        self.corners.append(corners)
        self.counts.append(counts)
        self.vertices += len(points)
        self.polygons += len(counts)

    def add_lines(self, batch: Iterable[bytes]) -> None:
        vertices: list[bytes] = []
        faces: list[bytes] = []
        before: list[int] = []  # vertices above each face, from which relative indices count
        for line in batch:
            keyword, *rest = line.split(None, 1) or (b"#",)
            if keyword == b"v":
                vertices += rest or [b""]
            elif keyword in (b"f", b"fo"):  # "fo" is that of version 2
                faces += rest or [b""]
                before.append(self.vertices + len(vertices))
            elif not keyword.startswith(b"#"):
                self.others[keyword] += 1
                if keyword in _NAMING:
                    self.part = _named(keyword, rest, self.part)
                    self.begun.append((self.part, self.polygons + len(before)))
        self.add(_points(vertices), *_corners(faces, before))

    def add_long(self, text: bytes) -> None:
        """A whole text: kernels read it as far as they understand it."""
        from shapewright.references.readers.kernels.words import LINE, obj_lines

        letters, sign = np.frombuffer(text, np.uint8), b"\n" if b"\n" in text else b"\r"
        at = 0
        while at < len(text):
            begin, stop = at, text.find(sign, at + _BLOCK) + 1 or len(text)
            points, corners, counts, at, why = obj_lines(letters, at, stop, self.vertices)
            self.add(points, corners, counts)
            if why:
                # Names and odd lines that are frequent are read faster together than one by one.
                alone = why == LINE and at - begin > _WORTH
                end = text.find(sign, at if alone else at + _ODD) + 1 or len(text)
                self.add_lines(text[at:end].splitlines())
                at = end

    def result(self) -> Polygons | Cloud:
        ends = [*(start for _, start in self.begun[1:]), self.polygons]
        parts = Parts.of((part, end - start) for (part, start), end in zip(self.begun, ends, strict=True))
        notes = tuple(_notes(self.others))
        points = np.concatenate(self.points)
        if self.vertices and not self.polygons and not self.others.keys() & (_SURFACES | {b"l"}):
            return Cloud(points, notes=notes)
        return Polygons(points, np.concatenate(self.corners), np.concatenate(self.counts), notes, parts)


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
    with np.errstate(invalid="ignore"):  # beyond all vertices anyway
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
