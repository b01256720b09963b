"""Shapes as files: meshes as GLB, PLY, OBJ, STL or OFF, drawings as SVG; with their labels, and where they come from.

``extras`` are plain values for JSON that travel in the file: which procedure made the shape, at which parameters. GLB
and STL hold coordinates in single precision, the others in double.
"""

from __future__ import annotations

import io
import json
import struct
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, Literal, TypeAlias, get_args
from xml.sax.saxutils import escape

import numpy as np
from numpy.typing import NDArray

from shapewright.shapes.arrays import Bytes, Ints
from shapewright.shapes.drawing import Drawing
from shapewright.shapes.mesh import Mesh, concatenate
from shapewright.shapes.shape import Shape

Format: TypeAlias = Literal["glb", "ply", "obj", "stl", "off"]
FORMATS: tuple[Format, ...] = get_args(Format)
"""Formats of meshes that are written; each is the extension of its files."""
Extras: TypeAlias = Mapping[str, Any]

_NAME = "shape"
_REST = "unlabelled"
_NO_LABEL = (_NAME, _REST)
"""Names in files of faces without a label; a GLB says with each part of such a name if it is a label after all."""


def encode(shape: Shape, format: Format = "glb", extras: Extras | None = None, metres: float | None = None) -> bytes:
    """The bytes of a file: of a mesh in this format, of a drawing as SVG whatever the format.

    metres: length of the unit, for GLB, the only one of these formats that has one.
    """
    if isinstance(shape, Drawing):
        return svg(shape, extras)
    if format in ("stl", "off"):
        import trimesh

        exported = trimesh.Trimesh(shape.vertices, shape.faces, process=False).export(file_type=format)
        return exported.encode() if isinstance(exported, str) else bytes(exported)
    return glb(shape, extras, metres) if format == "glb" else {"ply": ply, "obj": obj}[format](shape, extras)


def glb(mesh: Mesh, extras: Extras | None = None, metres: float | None = None) -> bytes:
    """Binary glTF 2.0: one node for each label, and of a label with several colours for each of these, with vertices
    of its own, under a root node that holds the extras, as the scene does, and brings a unit of so many metres to one.
    """
    buffer = bytearray()
    accessors: list[dict[str, Any]] = []
    views: list[dict[str, Any]] = []
    meshes: list[dict[str, Any]] = []
    nodes: list[dict[str, Any]] = [{"name": _title(extras)}]
    materials: list[dict[str, Any]] = []
    for name, faces, label, colour in _coloured_parts(mesh):
        used, corners = np.unique(faces, return_inverse=True)
        positions = mesh.vertices[used].astype(np.float32)
        arrays = (positions, corners.ravel().astype(np.uint16 if len(used) <= 0xFFFF else np.uint32))
        primitive: dict[str, Any] = {"attributes": {"POSITION": len(accessors)}, "indices": len(accessors) + 1}
        if colour is not None:
            primitive["material"] = len(materials)
            materials.append(_material(colour))
        meshes.append({"name": name, "primitives": [primitive]})
        if label and name in _NO_LABEL:
            meshes[-1]["extras"] = {"label": True}
        nodes.append({"name": name, "mesh": len(meshes) - 1})
        for array, target in zip(arrays, (34962, 34963), strict=True):
            data = array.tobytes()
            views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data), "target": target})
            accessors.append(_accessor(len(views) - 1, array))
            buffer += data + bytes(-len(data) % 4)
    if metres:
        nodes[0]["scale"] = [metres] * 3
    nodes[0]["children"] = list(range(1, len(nodes)))
    known = {"extras": dict(extras)} if extras else {}
    nodes[0] |= known
    document = {
        "asset": {"version": "2.0", "generator": "shapewright"},
        "scene": 0,
        "scenes": [{"nodes": [0], **known}],  # some readers keep the scene's extras, some the nodes'
        "nodes": nodes,
        "meshes": meshes,
        "accessors": accessors,
        **({"materials": materials} if materials else {}),
        "bufferViews": views,
        "buffers": [{"byteLength": len(buffer)}],
    }
    text = json.dumps(document, separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(buffer), b"BIN\0") + buffer
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def read_glb(data: bytes) -> Mesh:
    """The mesh of a file that ``glb`` wrote, with its labels and colours."""
    import trimesh

    document = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    written = document["meshes"]
    scene = trimesh.load_scene(io.BytesIO(data), file_type="glb", process=False)
    parts = []
    for entry, part in zip(written, scene.geometry.values(), strict=True):
        mesh = Mesh(part.vertices, part.faces)
        if (material := entry["primitives"][0].get("material")) is not None:
            colour = document["materials"][material]["extras"]["srgb"]
            mesh = replace(mesh, face_colours=np.tile(np.array(colour, dtype=np.uint8), (len(mesh.faces), 1)))
        labelled = entry["name"] not in _NO_LABEL or entry.get("extras", {}).get("label")
        parts.append(mesh.label(entry["name"]) if labelled else mesh)
    whole = concatenate(parts)
    if len(parts) == 1:
        return whole
    # A file holds each part's vertices apart from the others'; equal ones are one again.
    vertices, index = np.unique(whole.vertices, axis=0, return_inverse=True)
    return replace(whole, vertices=vertices, faces=index.ravel()[whole.faces])


def ply(mesh: Mesh, extras: Extras | None = None) -> bytes:
    """Binary PLY with a property ``label`` of every face: an index into the comments ``label 0 top``, or -1."""
    comments = [f"comment label {i} {name}" for i, name in enumerate(mesh.label_names)]
    if extras:
        comments.append(f"comment extras {_json(extras)}")
    header = [
        "ply",
        "format binary_little_endian 1.0",
        *comments,
        f"element vertex {len(mesh.vertices)}",
        *(f"property double {axis}" for axis in "xyz"),
        f"element face {len(mesh.faces)}",
        "property list uchar int vertex_indices",
        "property int label",
        "end_header\n",
    ]
    rows = np.empty(len(mesh.faces), dtype=[("count", "u1"), ("corners", "<i4", 3), ("label", "<i4")])
    rows["count"], rows["corners"], rows["label"] = 3, mesh.faces, -1
    if mesh.face_labels is not None:
        rows["label"] = mesh.face_labels
    return "\n".join(header).encode() + mesh.vertices.astype("<f8").tobytes() + rows.tobytes()


def obj(mesh: Mesh, extras: Extras | None = None) -> bytes:
    """Wavefront OBJ with one group per label, the extras in a comment, coordinates to the last digit."""
    lines = [f"# extras {_json(extras)}"] if extras else []
    lines.append(f"o {_title(extras)}")
    lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in mesh.vertices.tolist()]
    for name, rows, _ in _parts(mesh):
        lines.append(f"g {'_'.join(name.split())}")
        lines += [f"f {a} {b} {c}" for a, b, c in (mesh.faces[rows] + 1).tolist()]
    return ("\n".join(lines) + "\n").encode()


def svg(drawing: Drawing, extras: Extras | None = None) -> bytes:
    """SVG, black on white, the extras in its metadata."""
    (left, low), (right, high) = drawing.bounds
    margin = 0.02 * max(right - left, high - low)
    box = f"{left - margin} {-high - margin} {right - left + 2 * margin} {high - low + 2 * margin}"
    shape = drawing.geometry.svg(scale_factor=0.0, fill_color="black", opacity=1.0)
    metadata = f"<metadata>{escape(_json(extras))}</metadata>" if extras else ""
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">{metadata}'
    return f'{head}<g transform="scale(1 -1)">{shape}</g></svg>'.encode()


def _parts(mesh: Mesh) -> Iterator[tuple[str, NDArray[np.bool_], bool]]:
    """Name and faces (F,) of each label that has any, and whether it is one; without labels all the mesh's faces."""
    if mesh.face_labels is None:
        yield _NAME, np.ones(len(mesh.faces), dtype=bool), False
        return
    for i, name in (*enumerate(mesh.label_names), (-1, _REST)):
        if (chosen := mesh.face_labels == i).any():
            yield name, chosen, i >= 0


def _coloured_parts(mesh: Mesh) -> Iterator[tuple[str, Ints, bool, Bytes | None]]:
    """What _parts yields, with the faces of each colour apart; (4,) uint8, None without one."""
    for name, rows, label in _parts(mesh):
        if mesh.face_colours is None:
            yield name, mesh.faces[rows], label, None
            continue
        colours, index = np.unique(mesh.face_colours[rows], axis=0, return_inverse=True)
        for i, colour in enumerate(colours):
            yield name, mesh.faces[rows][index.ravel() == i], label, colour if colour.any() else None


def _material(colour: Bytes) -> dict[str, Any]:
    """A material of this colour, which glTF holds linear (IEC 61966-2-1); the exact one is beside it."""
    srgb = colour / 255.0
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    factor = [round(float(x), 6) for x in (*linear[:3], srgb[3])]
    shown = {"pbrMetallicRoughness": {"baseColorFactor": factor, "metallicFactor": 0.0}, "doubleSided": True}
    return {**shown, **({"alphaMode": "BLEND"} if colour[3] < 255 else {}), "extras": {"srgb": colour.tolist()}}


def _accessor(view: int, array: np.ndarray[Any, Any]) -> dict[str, Any]:
    kind = {"f4": 5126, "u2": 5123, "u4": 5125}[array.dtype.str[1:]]
    accessor = {"bufferView": view, "componentType": kind, "count": len(array), "type": "SCALAR"}
    if array.ndim == 2:
        accessor |= {"type": "VEC3", "min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
    return accessor


def _title(extras: Extras | None) -> str:
    return "_".join(str((extras or {}).get("procedure", _NAME)).split())


def _json(extras: Extras) -> str:
    return json.dumps(dict(extras), separators=(",", ":"), allow_nan=False)
