"""Small glTF files, made from arrays."""

import base64
import json
import struct
from pathlib import Path

import numpy as np

TYPES = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "i4": 5124, "u4": 5125, "f4": 5126}
WIDTHS = {(): "SCALAR", (2,): "VEC2", (3,): "VEC3", (4,): "VEC4", (4, 4): "MAT4"}

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=np.float64)
"""The corners of a unit cube."""
CUBE_FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
     [1, 5, 7], [1, 7, 3]]
)  # fmt: skip
"""Its twelve triangles, outward."""


class Gltf:
    """A glTF file in the making: ``document`` is its JSON, ``binary`` the bytes of its buffer."""

    def __init__(self, **document):
        self.binary = bytearray()
        self.document = {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], **document}

    def view(self, data: bytes, **more) -> int:
        """A buffer view with these bytes."""
        self.binary += bytes(-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data), **more}
        self.binary += data
        self.document["bufferViews"].append(view)
        return len(self.document["bufferViews"]) - 1

    def array(self, values, kind="f4", **more) -> int:
        """An accessor of values in rows; matrices are stored column by column, as the format asks."""
        values = np.asarray(values)
        stored = np.swapaxes(values, -1, -2) if values.ndim == 3 else values
        view = self.view(np.ascontiguousarray(stored, "<" + kind).tobytes())
        return self.accessor(len(values), WIDTHS[values.shape[1:]], kind, bufferView=view, **more)

    def accessor(self, count, width, kind, **more) -> int:
        self.document["accessors"].append({"componentType": TYPES[kind], "count": count, "type": width, **more})
        return len(self.document["accessors"]) - 1

    def add(self, rows, **row) -> int:
        """A row of one of the document's lists."""
        self.document.setdefault(rows, []).append(row)
        return len(self.document[rows]) - 1

    def mesh(self, *primitives, **more) -> int:
        return self.add("meshes", primitives=list(primitives), **more)

    def cube(self, vertices=CUBE) -> int:
        """A mesh of the cube's faces."""
        indices = self.array(CUBE_FACES.reshape(-1), "u2")
        return self.mesh({"attributes": {"POSITION": self.array(vertices)}, "indices": indices})

    def scene(self, *nodes) -> "Gltf":
        """The same file with these nodes as its scene."""
        self.document |= {"scenes": [{"nodes": list(nodes)}], "scene": 0}
        return self

    def shown(self, mesh, **node) -> "Gltf":
        """The same file with one node that has this mesh as its scene."""
        return self.scene(self.add("nodes", mesh=mesh, **node))

    def text(self, **buffer) -> bytes:
        """The file as JSON, with its buffer as a data URI where no URI is given."""
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.binary).decode()
        described = {"byteLength": len(self.binary), "uri": uri, **buffer}
        return json.dumps(self.document | {"buffers": [described]}).encode()

    def glb(self) -> bytes:
        buffers = [{"byteLength": len(self.binary)}, *self.document.get("buffers", ())]
        text = json.dumps(self.document | {"buffers": buffers}).encode()
        return glb(text, bytes(self.binary))


def glb(text: bytes, binary: bytes = b"", version: int = 2) -> bytes:
    """A binary glTF file of a JSON text and the bytes beside it."""
    text += b" " * (-len(text) % 4)
    binary += bytes(-len(binary) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    chunks += struct.pack("<II", len(binary), 0x004E4942) + binary if binary else b""
    return struct.pack("<4sII", b"glTF", version, 12 + len(chunks)) + chunks


def written(folder: Path, gltf: Gltf, name: str = "a.glb") -> Path:
    """The path of a file in a folder."""
    path = folder / name
    path.write_bytes(gltf.glb() if name.endswith(".glb") else gltf.text())
    return path
