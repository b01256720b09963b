"""Mutated files of every format, each read in a process with limits: what crashes, hangs, eats memory or lies.

    python benchmarks/fuzzing.py --seed 0 --count 10000
    python benchmarks/fuzzing.py --seed 0 --count 500 --format ply --format stl

Small valid files of each format are mutated: bytes flipped, pieces cut, doubled, inserted, numbers raised, two files
spliced. A worker reads each file within 5 seconds and 1 GB. What comes out is counted:

- read, noted, refused: the shape, the shape with notes, or a reason
- crash: an error that is no reason of the reader, or a reason that shows one ("broken: KeyError: ...")
- hang, memory: the limits were reached
- size: the shape is read without a note, although no number in the file was touched, and is more than 10 times as large
  as the largest file that was mutated; or a file that was only cut is read without a note as another shape. Not counted
  in OBJ, which tells neither how much it holds nor where it ends

Findings are kept in the folder of ``--keep``.
"""

from __future__ import annotations

import argparse
import base64
import gzip
import io
import json
import multiprocessing
import os
import re
import struct
import sys
import tempfile
import time
import zipfile
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path

import numpy as np
from PIL import Image

SECONDS, BYTES = 5.0, 2**30
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


FORMATS: dict[str, Callable[[], list[bytes]]] = {
    "ply": ply_files,
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
    "zip": zip_files,
}
CHANGES = ("flip", "cut", "remove", "double", "number", "word", "splice")
WEIGHTS = (0.25, 0.1, 0.1, 0.1, 0.25, 0.1, 0.1)
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


def mutated(seeds: list[bytes], rng: np.random.Generator) -> Mutant:
    """One to three changes of one of the files."""
    seed = int(rng.integers(len(seeds)))
    data = bytearray(seeds[seed])
    changes = rng.choice(CHANGES, size=int(rng.choice([1, 1, 1, 2, 3])), p=WEIGHTS)
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
    return Mutant(bytes(data), seed, frozenset(map(str, changes)))


def serve(connection: Connection, folder: str) -> None:
    """Read the files that come, one at a time."""
    import resource
    import warnings

    import shapely  # noqa: F401 - loaded before the limit

    from shapewright.references import Collection, CollectionError
    from shapewright.shapes import Mesh

    warnings.simplefilter("ignore")
    mapped = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (mapped + BYTES, mapped + BYTES))
    while True:
        path = connection.recv()
        try:
            reference = Collection.load(path).references[0]
        except CollectionError as error:
            connection.send(("refused", str(error).replace(folder, ""), 0.0, 0))
        except MemoryError as error:
            connection.send(("memory", repr(error), 0.0, 0))
        except BaseException as error:  # noqa: BLE001 - what this looks for
            connection.send(("crash", repr(error), 0.0, 0))
        else:
            size = 1.0 / reference.transform.scale
            count = len(reference.shape.faces) if isinstance(reference.shape, Mesh) else 1
            connection.send(("noted" if reference.notes else "read", " | ".join(reference.notes), size, count))


class Reader:
    """A process that reads files, started again after each that ends it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._start()

    def _start(self) -> None:
        self.connection, other = multiprocessing.Pipe()
        self.process = multiprocessing.get_context("fork").Process(target=serve, args=(other, str(self.folder)))
        self.process.start()
        other.close()

    def read(self, path: Path) -> tuple[str, str, float, int]:
        """What came of a file: the outcome, the reason or notes, the size and the number of triangles."""
        self.connection.send(path)
        answer = None
        try:
            if self.connection.poll(SECONDS):
                answer = self.connection.recv()
        except EOFError:
            answer = ("crash", "the process ended", 0.0, 0)
        if answer is None or answer[0] == "crash":
            self.end()
            self._start()
        return answer or ("hang", f"more than {SECONDS:g} s", 0.0, 0)

    def end(self) -> None:
        self.process.kill()
        self.process.join()


SHOWN_ERROR = re.compile(r"broken: (\w*(?:Error|Exception|Iteration|Warning)\b.*)")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=1000, help="files over all formats")
    parser.add_argument("--format", action="append", choices=FORMATS, help="one or several; default: all")
    parser.add_argument("--keep", type=Path, help="a folder for the files with findings")
    options = parser.parse_args()
    kinds = options.format or list(FORMATS)
    outcomes = {kind: Counter[str]() for kind in kinds}
    told: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        os.environ["SHAPEWRIGHT_CACHE"] = str(Path(folder) / "cache")
        reader = Reader(Path(folder))
        known: dict[str, list[tuple[float, int]]] = {}
        for kind in kinds:
            for i, data in enumerate(FORMATS[kind]()):
                path = Path(folder) / f"seed{i}.{kind}"
                path.write_bytes(data)
                outcome = reader.read(path)
                if outcome[0] != "read":
                    sys.exit(f"{path.name} is not read as it is: {outcome}")
                known.setdefault(kind, []).append(outcome[2:])
        started = time.time()
        for number in range(options.count):
            kind = kinds[number % len(kinds)]
            rng = np.random.default_rng([options.seed, number])
            mutant = mutated(FORMATS[kind](), rng)
            path = Path(folder) / f"{number}.{kind}"
            path.write_bytes(mutant.data)
            outcome, why, size, count = reader.read(path)
            shown = SHOWN_ERROR.search(why) if outcome == "refused" else None
            if shown:
                outcome, why = ("memory" if "MemoryError" in why else "crash"), shown[1]
            cut = mutant.changes == {"cut"} and (size, count) != known[kind][mutant.seed]
            large = not mutant.changes & {"flip", "number", "word"} and size > 10 * max(known[kind])[0]
            if outcome == "read" and kind != "obj" and (cut or large):
                outcome, why = "size", f"size {size:g}, {count} triangles"
            outcomes[kind][outcome] += 1
            if outcome in ("crash", "hang", "memory", "size"):
                told[f"{kind} {outcome}: {re.sub('[0-9]+', '#', why)[:110]}"] += 1
                if options.keep:
                    options.keep.mkdir(parents=True, exist_ok=True)
                    (options.keep / path.name).write_bytes(mutant.data)
            path.unlink()
        reader.end()
    columns = ("read", "noted", "refused", "crash", "hang", "memory", "size")
    print(f"| format | {' | '.join(columns)} |\n|---|{'---|' * len(columns)}")
    for kind in kinds:
        print(f"| {kind} | {' | '.join(str(outcomes[kind][column]) for column in columns)} |")
    print(f"{options.count} files in {time.time() - started:.0f} s")
    for what, count in told.most_common(40):
        print(f"{count:5} {what}")


if __name__ == "__main__":
    main()
