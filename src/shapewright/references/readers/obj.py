"""Wavefront OBJ. Only vertices and faces are read: materials, textures, normals and groups are passed over.

Not through trimesh, which counts relative indices from the end of the file instead of from the face, and cuts concave
polygons as fans.
"""

from __future__ import annotations

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.polygons import Polygons


def read_obj(data: bytes) -> Polygons:
    """The polygons of an OBJ file's bytes. Raises UnreadableError with the line that cannot be understood."""
    vertices: list[tuple[float, float, float]] = []
    corners: list[int] = []
    counts: list[int] = []
    lines = data.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ").splitlines()
    line = b""
    try:
        for line in lines:
            fields = line.split()
            keyword = fields[0] if fields else b""
            if keyword == b"v":
                vertices.append((float(fields[1]), float(fields[2]), float(fields[3])))
            elif keyword == b"f":
                if b"#" in line:
                    fields = line.partition(b"#")[0].split()
                for field in fields[1:]:
                    index = int(field.partition(b"/")[0])
                    corners.append(index - 1 if index >= 0 else len(vertices) + index)
                counts.append(len(fields) - 1)
    except (ValueError, IndexError) as error:
        raise UnreadableError(f"broken: cannot understand the line {line[:60].decode(errors='replace')!r}") from error
    return Polygons.of(vertices, corners, counts)
