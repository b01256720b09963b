"""Small valid files of every format, and how ``fuzzing`` mutates them."""

from __future__ import annotations

import base64
import gzip
import io
import json
import re
import struct
import sys
import tempfile
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "helpers"))
POINTS = np.array([(x, y, z) for x in (0, 1) for y in (0, 2) for z in (0, 3)], dtype="<f4")
FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
     [1, 5, 7], [1, 7, 3]], dtype="<u4",
)  # fmt: skip


def spaced(rows: np.ndarray, before: str = "") -> str:
    return "".join(f"{before}{' '.join(f'{value:g}' for value in row)}\n" for row in rows)


def ply_files() -> list[bytes]:
    head = "ply\nformat {} 1.0\ncomment x\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
    head += "element face 12\nproperty list uchar uint vertex_indices\nend_header\n"
    rows = [b"".join(bytes([3]) + face.astype(order + "u4").tobytes() for face in FACES) for order in "<>"]
    quads = head.replace("face 12", "face 2").format("binary_little_endian").encode() + POINTS.tobytes()
    quads += struct.pack("<B4I", 4, 0, 1, 3, 2) + struct.pack("<B3I", 3, 4, 6, 7)
    strips = head.replace("face 12", "tristrips 1").replace("uchar uint", "int int").format("ascii")
    return [
        (head.format("ascii") + spaced(POINTS) + spaced(FACES, "3 ")).encode(),
        head.format("binary_little_endian").encode() + POINTS.tobytes() + rows[0],
        head.format("binary_big_endian").encode() + POINTS.astype(">f4").tobytes() + rows[1],
        quads,
        (strips + spaced(POINTS) + "9 0 1 2 3 -1 4 5 6 7\n").encode(),
    ]


def stl_files() -> list[bytes]:
    facets = b"".join(struct.pack("<3f9fH", 0, 0, 0, *POINTS[face].reshape(-1), 0) for face in FACES)
    loops = ("".join(f"vertex {x:g} {y:g} {z:g}\n" for x, y, z in POINTS[face]) for face in FACES)
    text = "".join(f"facet normal 0 0 0\nouter loop\n{loop}endloop\nendfacet\n" for loop in loops)
    solids = f"solid a\n{text}endsolid a\n" * 2
    return [
        b"box".ljust(80) + struct.pack("<I", 12) + facets,
        f"solid box\n{text}endsolid box\n".encode(),
        solids.encode(),
    ]


def obj_files() -> list[bytes]:
    box = spaced(POINTS, "v ") + spaced(FACES + 1, "f ")
    rich = "mtllib a.mtl\no box\n" + spaced(POINTS, "v ") + "vt 0 0\nvn 0 0 1\nusemtl wood\n"
    rich += "".join(f"f {'/1/1 '.join(map(str, face.astype(int) - 8))}/1/1\n" for face in FACES)
    return [box.encode(), rich.encode(), box.encode("utf-16")]


def off_files() -> list[bytes]:
    body = spaced(POINTS) + spaced(FACES, "3 ")
    coloured = "COFF\n8 12 0\n" + spaced(np.hstack([POINTS, np.ones((8, 4))])) + spaced(FACES, "3 ")
    return [("OFF\n8 12 0\n" + body).encode(), coloured.encode(), ("OFF 8 12 0 " + body.replace("\n", " ")).encode()]


def gltf(binary: bytes, uri: str | None) -> dict[str, object]:
    buffer: dict[str, object] = {"byteLength": len(binary)} | ({"uri": uri} if uri else {})
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"children": [1], "scale": [2, 1, 1]}, {"mesh": 0, "translation": [0, 1, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [0, 0, 0], "max": [1, 2, 3]},
            {"bufferView": 1, "componentType": 5125, "count": 36, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 96},
            {"buffer": 0, "byteOffset": 96, "byteLength": 144},
        ],
        "buffers": [buffer],
    }


def glb_files() -> list[bytes]:
    binary = POINTS.tobytes() + FACES.tobytes()
    text = json.dumps(gltf(binary, None)).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary
    return [struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks]


def gltf_files() -> list[bytes]:
    binary = POINTS.tobytes() + FACES.tobytes()
    uri = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    return [json.dumps(gltf(binary, uri), indent=1).encode()]


def threemf_files() -> list[bytes]:
    vertices = "".join(f'<vertex x="{x:g}" y="{y:g}" z="{z:g}"/>' for x, y, z in POINTS)
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in FACES)
    model = (
        '<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>'
        f'<object id="1" type="model"><mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh>'
        '</object></resources><build><item objectid="1"/></build></model>'
    )
    relations = (
        '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="r" '
        'Target="/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
    )
    types = '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"/>'
    files = []
    for method in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        with zipfile.ZipFile(buffer := io.BytesIO(), "w", method) as archive:
            archive.writestr("[Content_Types].xml", types)
            archive.writestr("_rels/.rels", relations)
            archive.writestr("3D/3dmodel.model", model)
        files.append(buffer.getvalue())
    return files


def svg_files() -> list[bytes]:
    text = b"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 64 64" width="64" height="64">
    <style>.a{fill:#123}</style><defs><g id="leg"><rect width="4" height="20"/></g></defs>
    <rect class="a" x="8" y="20" width="48" height="6"/><use href="#leg" x="10" y="26"/>
    <g transform="rotate(5 32 32) scale(.9)"><path d="M50 26h4v20h-4z"/>
    <circle cx="30" cy="40" r="5" stroke="black" stroke-width="2" fill="none" stroke-dasharray="3 2"/></g></svg>"""
    return [text, gzip.compress(text)]


def picture_files(kind: str, **options: object) -> list[bytes]:
    picture = np.full((64, 64), 255, dtype=np.uint8)
    picture[20:26, 8:56] = picture[26:46, 10:14] = picture[26:46, 50:54] = 0
    files = []
    for mode in ("L", "RGB"):
        Image.fromarray(picture).convert(mode).save(buffer := io.BytesIO(), kind, **options)
        files.append(buffer.getvalue())
    return files


def zip_files() -> list[bytes]:
    files = []
    for method in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        with zipfile.ZipFile(buffer := io.BytesIO(), "w", method) as archive:
            archive.writestr("chairs/a.obj", obj_files()[0])
            archive.writestr("chairs/b.stl", stl_files()[0])
        files.append(buffer.getvalue())
    return files


def dae_files() -> list[bytes]:
    import collada_files

    return [collada_files.document(f"<node id='n'>{collada_files.show()}</node>")]


def autodesk_files() -> list[bytes]:
    import fbx_files

    tree = fbx_files.cube()
    return [fbx_files.binary(tree), fbx_files.binary(tree, 7500, compressed=False), fbx_files.written(tree)]


def usd_files(binary: bool) -> list[bytes]:
    """A stage with a mesh, an exact shape and an instancer."""
    from pxr import Gf, Usd, UsdGeom

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"a.usd{'c' if binary else 'a'}"
        stage = Usd.Stage.CreateNew(str(path))
        box = UsdGeom.Mesh.Define(stage, "/box")
        box.GetPointsAttr().Set([Gf.Vec3f(*map(float, point)) for point in POINTS])
        box.GetFaceVertexCountsAttr().Set([3] * len(FACES))
        box.GetFaceVertexIndicesAttr().Set(FACES.reshape(-1).astype(int).tolist())
        UsdGeom.XformCommonAPI(box).SetTranslate((1, 0, 0))
        instancer = UsdGeom.PointInstancer.Define(stage, "/many")
        ball = UsdGeom.Sphere.Define(stage, "/many/ball")
        instancer.GetPrototypesRel().AddTarget(ball.GetPath())
        instancer.GetProtoIndicesAttr().Set([0, 0])
        instancer.GetPositionsAttr().Set([Gf.Vec3f(0, 0, 0), Gf.Vec3f(0, 3, 0)])
        stage.Save()
        return [path.read_bytes()]


def step_files() -> list[bytes]:
    import cadquery

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.step"
        cadquery.exporters.export(cadquery.Workplane("XY").box(1, 2, 3).faces(">Z").hole(0.5), str(path))
        return [path.read_bytes()]


def cloud() -> np.ndarray:
    """Points (400, 3) on the sides of a box."""
    rng = np.random.default_rng(0)
    points = rng.random((400, 3)) * (1, 2, 3)
    axis, side = rng.integers(3, size=400), rng.integers(2, size=400)
    points[np.arange(400), axis] = side * np.array((1, 2, 3))[axis]
    return points.astype("<f4")


def pcd_files() -> list[bytes]:
    points = cloud()
    head = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 400\nHEIGHT 1\n"
    head += "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 400\nDATA "
    columns = points.T.tobytes()
    literals = b"".join(bytes([len(columns[i : i + 32]) - 1]) + columns[i : i + 32] for i in range(0, len(columns), 32))
    return [
        (head + "ascii\n" + spaced(points)).encode(),
        (head + "binary\n").encode() + points.tobytes(),
        (head + "binary_compressed\n").encode() + struct.pack("<II", len(literals), len(columns)) + literals,
    ]


def cloud_ply_files() -> list[bytes]:
    def head(encoding: str, *names: str) -> bytes:
        properties = "".join(f"property float {name}\n" for name in names)
        return f"ply\nformat {encoding} 1.0\nelement vertex 400\n{properties}end_header\n".encode()

    rows = np.hstack([cloud(), np.tile([0.6, 0.0, 0.8], (400, 1))]).astype("<f4")
    names = (*"xyz", "nx", "ny", "nz")
    splats = np.hstack([cloud(), np.full((400, 4), 2.0)]).astype("<f4")
    return [
        head("ascii", *names) + spaced(rows).encode(),
        head("binary_little_endian", *names) + rows.tobytes(),
        head("binary_big_endian", *names) + rows.astype(">f4").tobytes(),
        head("binary_little_endian", *"xyz", "f_dc_0", "opacity", "scale_0", "rot_0") + splats.tobytes(),
    ]


def las_files(packed: bool) -> list[bytes]:
    import laspy

    files = []
    for version, kind in (("1.2", 3), ("1.4", 6)):
        las = laspy.LasData(laspy.LasHeader(version=version, point_format=kind))
        las.header.scales = [0.001] * 3
        las.x, las.y, las.z = cloud().T.astype("f8")
        las.write(buffer := io.BytesIO(), do_compress=packed)
        files.append(buffer.getvalue())
    return files


def e57_files() -> list[bytes]:
    import pye57

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "a.e57")
        with pye57.E57(str(path), mode="w") as file:
            file.write_scan_raw({f"cartesian{axis}": cloud()[:, i].astype("f8") for i, axis in enumerate("XYZ")})
        return [path.read_bytes()]


def splat_files() -> list[bytes]:
    row = np.dtype([("position", "<f4", 3), ("scale", "<f4", 3), ("colour", "u1", 4), ("rotation", "u1", 4)])
    table = np.zeros(400, row)
    table["position"], table["colour"] = cloud(), 255
    return [table.tobytes()]


FORMATS: dict[str, Callable[[], list[bytes]]] = {
    "ply": lambda: ply_files() + cloud_ply_files(),
    "stl": stl_files,
    "obj": obj_files,
    "off": off_files,
    "glb": glb_files,
    "gltf": gltf_files,
    "3mf": threemf_files,
    "svg": svg_files,
    "png": lambda: picture_files("PNG"),
    "jpg": lambda: picture_files("JPEG", quality=90),
    "webp": lambda: picture_files("WEBP", lossless=True),
    "gif": lambda: picture_files("GIF"),
    "bmp": lambda: picture_files("BMP"),
    "tiff": lambda: picture_files("TIFF"),
    "dae": dae_files,
    "fbx": autodesk_files,
    "xyz": lambda: [spaced(cloud()).encode()],
    "pts": lambda: [("400\n" + spaced(cloud())).encode()],
    "pcd": pcd_files,
    "splat": splat_files,
    "zip": zip_files,
}
if find_spec("pxr"):  # the extra [usd]
    FORMATS |= {"usda": cache(lambda: usd_files(False)), "usdc": cache(lambda: usd_files(True))}
if find_spec("cadquery") and find_spec("cascadio"):  # the extras [cadquery] and [cad]
    FORMATS["step"] = cache(step_files)
if find_spec("laspy") and find_spec("pye57"):  # the extra [points]
    FORMATS |= {"las": lambda: las_files(False), "laz": lambda: las_files(True), "e57": e57_files}
DECLARED = {
    "ply": rb"element \w+ (\d+)",
    "off": rb"OFF\s+(\d+) \d+ \d+|OFF\s+\d+ (\d+) \d+",
    "gltf": rb'"(?:byteLength|byteOffset)": ?(\d+)',
    "glb": rb'"(?:byteLength|byteOffset)": ?(\d+)',
    "dae": rb'(?:count|stride)="(\d+)"',
    "fbx": rb"\*(\d+) \{",
    "pts": rb"\A(\d+)",
    "pcd": rb"(?:WIDTH|HEIGHT|POINTS|COUNT 1 1|SIZE 4 4) (\d+)",
}
"""Where a format declares how much it holds. glTF's accessors do not count: they may show a part of a view."""
CHANGES = ("flip", "cut", "remove", "double", "number", "word", "splice", "count")
WEIGHTS = (0.2, 0.1, 0.1, 0.1, 0.2, 0.1, 0.1, 0.1)
NUMBERS = (b"0", b"-1", b"99999999", b"4294967295", b"1e308", b"nan", b"0.0000001", b"18446744073709551616", b"7")


@dataclass(frozen=True)
class Mutant:
    """A mutated file.

    data: its bytes.
    seed: the number of the file that it was.
    changes: what was done to it.
    """

    data: bytes
    seed: int
    changes: frozenset[str]


def mutated(kind: str, rng: np.random.Generator) -> Mutant:
    """One to three changes of one of the files of a format; one change alone where that is of what it declares."""
    seeds = FORMATS[kind]()
    seed = int(rng.integers(len(seeds)))
    data = bytearray(seeds[seed])
    changes = rng.choice(CHANGES, size=int(rng.choice([1, 1, 1, 2, 3])), p=WEIGHTS)
    if "count" in changes:
        changes = ["count"]
    for change in changes:
        at, length = int(rng.integers(max(len(data), 1))), int(rng.integers(1, 1 + max(1, len(data) // 3)))
        if change == "flip":
            for place in rng.integers(max(len(data), 1), size=int(rng.integers(1, 5))):
                data[place : place + 1] = bytes([int(rng.integers(256))])
        elif change == "cut":
            del data[at:]
        elif change == "remove":
            del data[at : at + length]
        elif change == "double":
            data[at:at] = data[at : at + length]
        elif change == "number":
            found = list(re.finditer(rb"-?\d+(?:\.\d+)?", data))
            if found:
                chosen = found[rng.integers(len(found))]
                data[chosen.start() : chosen.end()] = NUMBERS[rng.integers(len(NUMBERS))]
        elif change == "word" and len(data) >= 4:
            place = int(rng.integers(len(data) - 3))
            data[place : place + 4] = struct.pack("<I", int(rng.choice([0, 1, 2**16, 2**31 - 1, 2**32 - 1])))
        elif change == "splice":
            other = seeds[rng.integers(len(seeds))]
            data[at:] = other[int(rng.integers(len(other))) :]
        elif change == "count":
            recount(kind, data, rng)
    return Mutant(bytes(data), seed, frozenset(map(str, changes)))


def recount(kind: str, data: bytearray, rng: np.random.Generator) -> None:
    """Another number in one place where the file says how much it holds."""
    found = [match.span(match.lastindex) for match in re.finditer(DECLARED.get(kind, b"(?!)"), data)]
    if kind == "stl" and not data.startswith(b"solid"):
        at = 80
        now = int.from_bytes(data[at : at + 4], "little")
        data[at : at + 4] = struct.pack("<I", max(0, other(now, rng)) % 2**32)
    elif found:
        start, end = found[rng.integers(len(found))]
        data[start:end] = str(other(int(data[start:end]), rng)).encode()


def other(now: int, rng: np.random.Generator) -> int:
    return int(rng.choice([0, 1, now // 2, now - 1, now + 1, 2 * now, 10**9, 2**32 - 1]))
