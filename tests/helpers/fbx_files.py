"""Small FBX files, binary and as text, made from one tree of nodes."""

import struct
import zlib

import numpy as np

from gltf_files import CUBE, CUBE_FACES

MAGIC = b"Kaydara FBX Binary  \0\x1a"


def node(name: str, *values, below=()):
    return name, values, list(below)


def record(tree, start: int, version: int, order: str = "<", compressed: bool = False) -> bytes:
    """The bytes of a node that begins at a place of the file."""
    name, values, below = tree
    head = struct.Struct(f"{order}3{'Q' if version >= 7500 else 'I'}B")
    packed = b"".join(packed_value(value, order, compressed) for value in values)
    body = name.encode() + packed
    for each in below:
        body += record(each, start + head.size + len(body), version, order, compressed)
    body += bytes(head.size) if below else b""
    return head.pack(start + head.size + len(body), len(values), len(packed), len(name)) + body


def packed_value(value, order: str, compressed: bool) -> bytes:
    if isinstance(value, str):
        name, sign, kind = value.rpartition("::")[::-1] if "::" in value else (value, "", "")
        text = (f"{name}\0\x01{kind}" if sign else value).encode()
        return b"S" + struct.pack(order + "I", len(text)) + text
    if isinstance(value, np.ndarray):
        kind = "d" if value.dtype.kind == "f" else "i"
        data = value.astype(order + {"d": "f8", "i": "i4"}[kind]).tobytes()
        data = zlib.compress(data) if compressed else data
        return kind.encode() + struct.pack(order + "3I", value.size, int(compressed), len(data)) + data
    return (
        b"D" + struct.pack(order + "d", value) if isinstance(value, float) else b"L" + struct.pack(order + "q", value)
    )


def binary(nodes, version: int = 7400, order: str = "<", compressed: bool = True) -> bytes:
    data = MAGIC + bytes([order == ">"]) + struct.pack(order + "I", version)
    for each in nodes:
        data += record(each, len(data), version, order, compressed)
    return data + bytes(25 if version >= 7500 else 13) + bytes(160)


def written(nodes, version: int = 7400) -> bytes:
    digits = ".".join(str(version)[:3])
    return (f"; FBX {digits} project file\n; comment: {{\n\n" + "".join(text(each, "") for each in nodes)).encode()


def text(tree, before: str) -> str:
    name, values, below = tree
    shown = ", ".join(f'"{v}"' if isinstance(v, str) else f"{v!r}" for v in values if not isinstance(v, np.ndarray))
    for value in (v for v in values if isinstance(v, np.ndarray)):
        rows = ",\n".join(",".join(f"{x:g}" for x in value[i : i + 9]) for i in range(0, value.size, 9))
        shown += f"*{value.size} {{\n{before}\ta: {rows}\n{before}}}"
    inner = f" {{\n{''.join(text(each, before + chr(9)) for each in below)}{before}}}" if below else ""
    return f"{before}{name}: {shown}{inner}\n"


def properties(**values):
    """Properties70 of numbers; names may have a _ for each space."""
    rows = [
        node("P", name.replace("_", " "), "", "", "A", *np.atleast_1d(value).astype(float).tolist())
        for name, value in values.items()
    ]
    return node("Properties70", below=rows)


def geometry(key: int, vertices=CUBE, polygons=CUBE_FACES, more=()):
    corners = [index if i + 1 < len(polygon) else ~index for polygon in polygons for i, index in enumerate(polygon)]
    arrays = [node("Vertices", np.ravel(vertices).astype(float)), node("PolygonVertexIndex", np.array(corners, "i4"))]
    return node("Geometry", key, "Geometry::", "Mesh", below=[*arrays, *more])


def model(key: int, kind: str = "Mesh", **values):
    return node("Model", key, f"Model::m{key}", kind, below=[properties(**values)])


def scene(objects, *connections, settings=None):
    """The outermost nodes of a file; a connection is of one key to another, 0 is the scene."""
    links = [node("C", "OO", int(child), int(parent)) for child, parent in connections]
    told = [node("GlobalSettings", below=[properties(**settings)])] if settings else []
    return [*told, node("Objects", below=objects), node("Connections", below=links)]


def cube(settings=None, **values):
    """A scene of a cube, whose model has these properties."""
    return scene([geometry(1), model(2, **values)], (1, 2), (2, 0), settings=settings)
