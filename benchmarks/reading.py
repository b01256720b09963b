"""What reading a million triangles, or points, costs: each format in a process of its own.

    python benchmarks/reading.py
    python benchmarks/reading.py --format stl-text --format obj --triangles 200000

A wave of quads, cut in two, is written in each format. A fresh process reads the file as the workers of
``Collection.load`` do, and tells CPU seconds, elapsed seconds and its peak of memory, of which 50 MB are the program.
"""

from __future__ import annotations

import argparse
import json
import struct
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

PROGRAM = r"""
import re, sys, time
from shapewright.references.reading import attempt
from shapewright.references.sources import find
(source,) = find([sys.argv[1]])
cpu, started = time.process_time(), time.perf_counter()
found = attempt(source)
took = time.process_time() - cpu, time.perf_counter() - started
shape = getattr(found, "shape", None)
size = len(getattr(shape, "positions", getattr(shape, "faces", ())))
print(*took, int(re.search(r"VmHWM:\s+(\d+)", open("/proc/self/status").read())[1]) / 1024, size)
if not size:
    print(found, file=sys.stderr)
"""


class Wave:
    """n x n points (N, 3) float32, and the triangles (F, 3) and quads (Q, 4) between them, uint32."""

    def __init__(self, triangles: int) -> None:
        n = max(2, round((triangles / 2) ** 0.5)) + 1
        axis = np.linspace(-1.0, 1.0, n)
        x, y = np.meshgrid(axis, axis)
        self.points = np.stack([x, y, 0.1 * np.sin(9 * x) * np.cos(7 * y)], axis=-1).reshape(-1, 3).astype("<f4")
        at = np.arange(n * n, dtype="<u4").reshape(n, n)
        self.quads = np.stack([at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]], axis=-1).reshape(-1, 4)
        self.faces = np.concatenate([self.quads[:, [0, 1, 2]], self.quads[:, [0, 2, 3]]])


def rows(values: np.ndarray, form: str) -> str:
    return "".join([form % tuple(row) for row in values.tolist()])


def obj(wave: Wave) -> bytes:
    return (rows(wave.points, "v %.6f %.6f %.6f\n") + rows(wave.faces + 1, "f %d %d %d\n")).encode()


def obj_with_attributes(wave: Wave) -> bytes:
    points = wave.points
    text = (
        rows(points, "v %.6f %.6f %.6f\n") + rows(points[:, :2], "vt %.6f %.6f\n") + rows(points, "vn %.6f %.6f %.6f\n")
    )
    return (text + rows(np.repeat(wave.faces + 1, 3, axis=1), "f %d/%d/%d %d/%d/%d %d/%d/%d\n")).encode()


def off(wave: Wave) -> bytes:
    head = f"OFF\n{len(wave.points)} {len(wave.faces)} 0\n"
    return (head + rows(wave.points, "%.6f %.6f %.6f\n") + rows(wave.faces, "3 %d %d %d\n")).encode()


def ply_head(wave: Wave, kind: str, faces: int) -> str:
    head = f"ply\nformat {kind} 1.0\nelement vertex {len(wave.points)}\n"
    head += "".join(f"property float {axis}\n" for axis in "xyz")
    return head + f"element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"


def ply_text(wave: Wave) -> bytes:
    body = rows(wave.points, "%.6f %.6f %.6f\n") + rows(wave.faces, "3 %d %d %d\n")
    return (ply_head(wave, "ascii", len(wave.faces)) + body).encode()


def counted(polygons: np.ndarray) -> np.ndarray:
    table = np.zeros(len(polygons), np.dtype([("count", "u1"), ("corners", "<u4", polygons.shape[1])]))
    table["count"], table["corners"] = polygons.shape[1], polygons
    return table


def ply(wave: Wave) -> bytes:
    head = ply_head(wave, "binary_little_endian", len(wave.faces))
    return head.encode() + wave.points.tobytes() + counted(wave.faces).tobytes()


def ply_mixed(wave: Wave) -> bytes:
    """Every second quad cut in two: one of four corners, two of three, and so on."""
    halves, whole = counted(wave.quads[::2][:, [0, 1, 2]]), counted(wave.quads[1::2])
    others = counted(wave.quads[::2][:, [0, 2, 3]])
    parts: list[bytes] = []
    for i in range(len(halves)):
        parts += [halves[i].tobytes(), others[i].tobytes(), whole[i].tobytes() if i < len(whole) else b""]
    head = ply_head(wave, "binary_little_endian", 2 * len(halves) + len(whole))
    return head.encode() + wave.points.tobytes() + b"".join(parts)


def stl(wave: Wave) -> bytes:
    table = np.zeros(
        len(wave.faces), np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    )
    table["corners"] = wave.points[wave.faces]
    return b"wave".ljust(80) + struct.pack("<I", len(table)) + table.tobytes()


def stl_text(wave: Wave) -> bytes:
    vertex = "    vertex %.6f %.6f %.6f\n"
    facet = f"facet normal 0.000000 0.000000 1.000000\n  outer loop\n{3 * vertex}  endloop\nendfacet\n"
    return f"solid wave\n{rows(wave.points[wave.faces].reshape(-1, 9), facet)}endsolid wave\n".encode()


def glb(wave: Wave) -> bytes:
    points, faces = wave.points.tobytes(), wave.faces.tobytes()
    ends = {"min": wave.points.min(axis=0).tolist(), "max": wave.points.max(axis=0).tolist()}
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(wave.points), "type": "VEC3", **ends},
            {"bufferView": 1, "componentType": 5125, "count": wave.faces.size, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(points)},
            {"buffer": 0, "byteOffset": len(points), "byteLength": len(faces)},
        ],
        "buffers": [{"byteLength": len(points) + len(faces)}],
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = [struct.pack("<II", len(text), 0x4E4F534A), text, struct.pack("<II", len(points + faces), 0x004E4942)]
    body = b"".join([*chunks, points, faces])
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def threemf(wave: Wave) -> bytes:
    namespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
    model = (
        f'<model unit="millimeter" xmlns="{namespace}"><resources><object id="1" type="model"><mesh><vertices>'
        + rows(wave.points, '<vertex x="%.6f" y="%.6f" z="%.6f"/>\n')
        + "</vertices><triangles>"
        + rows(wave.faces, '<triangle v1="%d" v2="%d" v3="%d"/>\n')
        + '</triangles></mesh></object></resources><build><item objectid="1"/></build></model>'
    )
    related = "http://schemas.openxmlformats.org/package/2006/relationships"
    start = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
    with tempfile.TemporaryFile() as file:
        with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            archive.writestr(
                "_rels/.rels",
                f'<Relationships xmlns="{related}"><Relationship Id="r" Target="/3D/a.model" Type="{start}"/>'
                "</Relationships>",
            )
            archive.writestr("3D/a.model", model)
        file.seek(0)
        return file.read()


def xyz(wave: Wave) -> bytes:
    return rows(wave.points[wave.faces].mean(axis=1), "%.6f %.6f %.6f\n").encode()


FORMATS: dict[str, tuple[str, Callable[[Wave], bytes]]] = {
    "stl": (".stl", stl),
    "ply": (".ply", ply),
    "ply-mixed": (".ply", ply_mixed),
    "glb": (".glb", glb),
    "3mf": (".3mf", threemf),
    "ply-text": (".ply", ply_text),
    "off": (".off", off),
    "obj": (".obj", obj),
    "obj-attributes": (".obj", obj_with_attributes),
    "stl-text": (".stl", stl_text),
    "xyz": (".xyz", xyz),
}


def measured(wave: Wave, names: list[str], folder: Path) -> Iterator[str]:
    """A row of the table for each format."""
    for name in names:
        extension, written = FORMATS[name]
        path = folder / f"wave{extension}"
        path.write_bytes(written(wave))
        run = subprocess.run([sys.executable, "-P", "-c", PROGRAM, path], capture_output=True, text=True, check=True)
        cpu, elapsed, peak, size = map(float, run.stdout.split())
        megabytes = path.stat().st_size / 1e6
        yield f"| {name} | {megabytes:.0f} | {size:.0f} | {cpu:.2f} | {elapsed:.2f} | {peak:.0f} |{run.stderr[-200:]}"
        path.unlink()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--triangles", type=int, default=10**6)
    parser.add_argument("--format", action="append", choices=FORMATS, help="one or several; default: all")
    options = parser.parse_args()
    wave = Wave(options.triangles)
    print("| format | file, MB | triangles | CPU, s | elapsed, s | peak, MB |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for row in measured(wave, options.format or list(FORMATS), Path(folder)):
            print(row, flush=True)


if __name__ == "__main__":
    main()
