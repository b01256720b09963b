"""Object File Format (Geomview): OFF and its kinds with normals, colours or texture coordinates, which are passed over.

Not through trimesh, which cuts concave polygons as fans.
"""

from __future__ import annotations

import re

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.polygons import Polygons

# Some collections write the counts right behind the word, without a space (ModelNet).
_HEADER = re.compile(rb"\s*(?:#.*\s+)*(?:ST)?C?N?OFF(?! *BINARY)")
_COMMENT = re.compile(rb"#[^\r\n]*")


def read_off(data: bytes) -> Polygons:
    """The polygons of an OFF file's bytes. Raises UnreadableError for another kind of file, or one that ends early."""
    header = _HEADER.match(data)
    if header is None:
        raise UnreadableError("broken: does not begin with OFF, or is binary OFF, which is not read")
    lines = _COMMENT.sub(b"", data[header.end() :]).splitlines()
    rows = [row for line in lines if (row := line.split())]
    try:
        vertex_count, face_count = int(rows[0][0]), int(rows[0][1])
        if len(rows) < 1 + vertex_count + face_count:
            raise UnreadableError(f"cut short: {vertex_count} vertices and {face_count} faces announced, fewer there")
        vertices = [(float(x), float(y), float(z)) for x, y, z, *_ in rows[1 : 1 + vertex_count]]
        faces = rows[1 + vertex_count : 1 + vertex_count + face_count]
        counts = [int(row[0]) for row in faces]
        corners = [int(row[1 + i]) for row, count in zip(faces, counts, strict=True) for i in range(count)]
    except (IndexError, ValueError) as error:
        if isinstance(error, UnreadableError):
            raise
        raise UnreadableError(f"broken: {error}") from error
    return Polygons.of(vertices, corners, counts)
