"""Vertices without faces in the formats of meshes: PLY, OBJ, OFF."""

import struct

import numpy as np
import pytest

import shapewright as sw
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.cloud import Cloud
from shapewright.references.readers.formats import read
from shapewright.references.readers.obj import read_obj
from shapewright.references.readers.off import read_off
from shapewright.references.readers.ply import read_ply
from shapewright.references.readers.polygons import Polygons

PLACES = np.random.default_rng(0).normal(size=(200, 3)).astype("f4").astype(float)
NORMALS = PLACES / np.linalg.norm(PLACES, axis=1, keepdims=True)


def ply(encoding: str, more: str = "", columns: str = "xyz", rows: np.ndarray = PLACES, body: bytes = b"") -> bytes:
    names = [*"xyz", "nx", "ny", "nz"][: rows.shape[1]]
    head = f"ply\nformat {encoding} 1.0\nelement vertex {len(rows)}\n"
    head += "".join(f"property double {name}\n" for name in names) + more + "end_header\n"
    if encoding == "ascii":
        return (head + "\n".join(" ".join(map(repr, row)) for row in rows.tolist()) + "\n").encode() + body
    return head.encode() + rows.astype("<f8" if "little" in encoding else ">f8").tobytes() + body


ENCODINGS = ("ascii", "binary_little_endian", "binary_big_endian")


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("faces", ["", "element face 0\nproperty list uchar int vertex_indices\n"])
def test_a_ply_without_faces_is_points(encoding, faces):
    cloud = read_ply(ply(encoding, faces))
    assert isinstance(cloud, Cloud)
    assert (cloud.positions == PLACES).all() and cloud.normals is None
    with_normals = read_ply(ply(encoding, faces, rows=np.hstack([PLACES, NORMALS])))
    assert (with_normals.normals == NORMALS).all()


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_a_ply_of_points_is_used_up(encoding):
    with pytest.raises(UnreadableError, match=r"cut short|broken"):
        read_ply(ply(encoding)[:-30])
    with pytest.raises(UnreadableError, match="broken"):
        read_ply(ply(encoding) + b"1 2 3 4 5\n")
    with pytest.raises(UnreadableError, match=r"cut short|broken"):
        read_ply(ply(encoding).replace(b"vertex 200", b"vertex 2000000000"))


def test_a_ply_of_edges_is_a_frame_of_wires_and_no_cloud():
    more = "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
    assert isinstance(read_ply(ply("binary_little_endian", more, body=struct.pack("<2i", 0, 1))), Polygons)


def test_an_obj_of_vertices_alone_is_points():
    text = "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in PLACES.tolist())
    cloud = read_obj(f"o scan\n{text}".encode())
    assert isinstance(cloud, Cloud) and (cloud.positions == PLACES).all()
    assert isinstance(read_obj(text.replace("\n", " 0.5 0.5 0.5\n").encode()), Cloud)


@pytest.mark.parametrize("line", ["f 1 2 3", "l 1 2 3", "curv2 1 2", "surf 0 1 0 1 1 2 3"])
def test_an_obj_with_faces_lines_or_surfaces_is_no_cloud(line):
    text = "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in PLACES.tolist())
    assert isinstance(read_obj(f"{text}{line}\n".encode()), Polygons)


def test_an_off_without_faces_is_points():
    text = "OFF\n200 0 0\n" + "\n".join(" ".join(map(repr, row)) for row in PLACES.tolist())
    for content in (text, text.replace("\n", " ")):
        cloud = read_off(content.encode())
        assert isinstance(cloud, Cloud) and (cloud.positions == PLACES).all()


@pytest.mark.parametrize("name", ["a.ply", "a.obj", "a.off", "a.xyz", "a.pts", "a.pcd"])
def test_a_file_of_points_becomes_points_in_a_collection(tmp_path, name):
    rows = "\n".join(" ".join(map(repr, row)) for row in PLACES.tolist()) + "\n"
    (tmp_path / name).write_bytes(
        {
            "a.ply": ply("ascii"),
            "a.obj": ("v " + rows.rstrip().replace("\n", "\nv ")).encode(),
            "a.off": f"OFF\n200 0 0\n{rows}".encode(),
            "a.xyz": rows.encode(),
            "a.pts": f"200\n{rows}".encode(),
            "a.pcd": f"FIELDS x y z\nWIDTH 200\nDATA ascii\n{rows}".encode(),
        }[name]
    )
    points, notes = read(tmp_path / name)
    assert (points.positions == PLACES).all() and notes == ()
    (reference,) = sw.Collection.load(tmp_path)
    assert isinstance(reference.shape, sw.Points)


def test_meshes_points_and_their_previews_lie_in_one_folder(tmp_path):
    rows = "\n".join(" ".join(map(repr, row)) for row in PLACES.tolist())
    (tmp_path / "scan.xyz").write_text(rows)
    (tmp_path / "scan.png").write_bytes(b"\x89PNG")
    (tmp_path / "mesh.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    refs = sw.Collection.load(tmp_path)
    assert [type(reference.shape) for reference in refs] == [sw.Mesh, sw.Points]
    assert not refs.skipped
    assert refs.kind is sw.Mesh
