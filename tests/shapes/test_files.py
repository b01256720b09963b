"""Files of shapes: what readers other than ours, and ours, find in them."""

import io
import json
import struct

import numpy as np
import pytest
import shapely
import trimesh

from shapewright import Collection, Drawing, Mesh
from shapewright.modelling.solids import box, cylinder
from shapewright.shapes import concatenate
from shapewright.shapes.files import encode, glb, obj, ply, read_glb, svg

EXTRAS = {"procedure": "stool", "version": "1.2.3", "seed": 7, "parameters": {"height": 0.45, "round": True, "legs": 3}}


@pytest.fixture(scope="module")
def stool():
    seat = cylinder((1, 0.1, 1), at=(0, 0.5, 0)).label("round seat")
    return (seat | box((0.1, 0.6, 0.1), at=(0, 0.2, 0)).label("leg") | box(0.1, at=(0.4, 0.6, 0))).mesh()


def document(data):
    length = struct.unpack("<I", data[12:16])[0]
    return json.loads(data[20 : 20 + length])


def test_glb_is_valid_and_has_one_node_per_label(stool):
    data = glb(stool, EXTRAS)
    magic, version, length = struct.unpack("<4sII", data[:12])
    assert (magic, version, length) == (b"glTF", 2, len(data)) and len(data) % 4 == 0
    root, *parts = document(data)["nodes"]
    assert root["name"] == "stool" and root["extras"] == EXTRAS and root["children"] == [1, 2, 3]
    assert [part["name"] for part in parts] == ["round seat", "leg", "unlabelled"]
    for view in document(data)["bufferViews"]:
        assert view["byteOffset"] % 4 == 0


def test_other_readers_find_the_parts_of_a_glb(stool, tmp_path):
    (tmp_path / "stool.glb").write_bytes(glb(stool, EXTRAS))
    scene = trimesh.load(tmp_path / "stool.glb")
    labels = np.array([label or "unlabelled" for label in stool.labels])
    assert set(scene.geometry) == set(labels)
    for name, part in scene.geometry.items():
        assert len(part.faces) == (labels == name).sum()
    np.testing.assert_allclose(scene.bounds, stool.bounds, atol=1e-7)
    assert scene.metadata["procedure"] == "stool" and scene.metadata["parameters"]["legs"] == 3


def labelled_triangles(mesh):
    corners = mesh.triangles.astype(np.float32).tolist()
    return sorted(zip(corners, [label or "" for label in mesh.labels], strict=True))


@pytest.mark.parametrize(
    "labels",
    [
        [None],
        [None, None],
        ["seat"],
        ["seat", "legs"],
        ["legs", "seat", "legs"],
        ["seat", None],
        ["front/left leg", "Stuhl \u00e4", "4", None],
        ["shape"],
        ["shape", None],
        ["unlabelled"],
        ["unlabelled", None],
        [None, "unlabelled", "shape", "seat"],
    ],
    ids=str,
)
def test_a_glb_is_read_back_with_its_labels(labels):
    cubes = [box(1, at=(2 * i, 0, 0)).mesh() for i in range(len(labels))]
    mesh = concatenate([c if name is None else c.label(name) for c, name in zip(cubes, labels, strict=True)])
    again = read_glb(glb(mesh, EXTRAS))
    assert labelled_triangles(again) == labelled_triangles(mesh)
    assert (again.face_labels is None) == (labels == [None] * len(labels))
    assert len(again.vertices) == len(mesh.vertices)


def test_parts_that_share_vertices_share_them_again(stool):
    again = read_glb(glb(stool))
    assert labelled_triangles(again) == labelled_triangles(stool) and len(again.vertices) == len(stool.vertices)
    assert again.soundness() == stool.soundness()


def test_labels_of_which_no_face_is_left_are_no_labels():
    mesh = Mesh(box(1).mesh().vertices, box(1).mesh().faces, np.full(12, -1), ("seat",))
    assert set(read_glb(glb(mesh)).labels) == {None}


def test_only_a_part_named_like_one_without_label_says_that_it_is_a_label(stool):
    assert b'"label"' not in glb(stool) and b'"label"' not in glb(box(1).mesh())
    assert document(glb(box(1).mesh().label("shape")))["meshes"][0]["extras"] == {"label": True}


def test_ply_keeps_double_precision_labels_and_extras(stool):
    data = ply(stool, EXTRAS)
    header, body = data.split(b"end_header\n", 1)
    assert b"comment label 0 round seat\n" in header and b"comment label 1 leg\n" in header
    assert json.loads(header.split(b"comment extras ")[1].split(b"\n")[0]) == EXTRAS
    vertices = np.frombuffer(body, "<f8", 3 * len(stool.vertices)).reshape(-1, 3)
    np.testing.assert_array_equal(vertices, stool.vertices)
    faces = np.frombuffer(body[vertices.nbytes :], dtype=[("n", "u1"), ("corners", "<i4", 3), ("label", "<i4")])
    np.testing.assert_array_equal(faces["corners"], stool.faces)
    np.testing.assert_array_equal(faces["label"], stool.face_labels)


def test_obj_has_one_group_per_label(stool):
    lines = obj(stool, EXTRAS).decode().splitlines()
    assert json.loads(lines[0].removeprefix("# extras ")) == EXTRAS and lines[1] == "o stool"
    vertices = np.array([line.split()[1:] for line in lines if line.startswith("v ")], dtype=float)
    np.testing.assert_array_equal(vertices, stool.vertices)
    assert [line for line in lines if line.startswith("g ")] == ["g round_seat", "g leg", "g unlabelled"]
    assert sum(line.startswith("f ") for line in lines) == len(stool.faces)


@pytest.mark.parametrize("format", ["glb", "ply", "obj", "stl", "off"])
def test_every_format_is_read_back_as_a_collection(stool, tmp_path, format):
    (tmp_path / f"stool.{format}").write_bytes(encode(stool, format, EXTRAS))
    (reference,) = Collection.load(str(tmp_path))
    assert len(reference.shape.faces) == len(stool.faces)
    np.testing.assert_allclose(reference.shape.extent, stool.extent / stool.extent.max(), atol=1e-6)


def test_meshes_without_labels_and_extras_are_one_part():
    mesh = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    assert [node["name"] for node in document(glb(mesh))["nodes"]] == ["shape", "shape"]
    assert "extras" not in document(glb(mesh))["nodes"][0]
    assert b"label" in ply(mesh) and b"comment" not in ply(mesh)
    assert obj(mesh).startswith(b"o shape\n")


def test_many_vertices_have_indices_of_four_bytes():
    count = 70_000
    mesh = Mesh(np.random.default_rng(0).uniform(size=(count, 3)), np.arange(count - 1).reshape(-1, 3))
    indices = document(glb(mesh))["accessors"][1]
    assert indices["componentType"] == 5125 and indices["count"] == count - 1


def test_drawings_are_svg_whatever_the_format():
    drawing = Drawing(shapely.box(0, 0, 2, 1).difference(shapely.box(0.5, 0.25, 1, 0.75)))
    text = encode(drawing, "glb", {"procedure": "a<b"}).decode()
    assert text.startswith("<svg ") and 'viewBox="-0.04 -1.04 2.08 1.08"' in text
    assert '<metadata>{"procedure":"a&lt;b"}</metadata>' in text
    assert "<metadata>" not in svg(drawing).decode()


def test_what_json_cannot_hold_is_refused(stool):
    with pytest.raises(ValueError, match="JSON"):
        glb(stool, {"height": float("nan")})


def test_colours_reach_a_glb_file_as_materials_and_come_back():
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    colours = np.array([[255, 0, 0, 255], [255, 0, 0, 255], [0, 128, 0, 100], [0, 0, 0, 0]], dtype=np.uint8)
    mesh = Mesh(corners, faces, np.array([0, 1, 1, -1]), ("top", "legs"), face_colours=colours)
    again = read_glb(glb(mesh))
    of_face = {(label, *row) for label, row in zip(again.labels, again.face_colours.tolist(), strict=True)}
    wanted = {(label, *row) for label, row in zip(mesh.labels, colours.tolist(), strict=True)}
    assert of_face == wanted and again.label_names == ("top", "legs")
    part = trimesh.load_scene(io.BytesIO(glb(mesh)), file_type="glb").geometry["top"]
    assert part.visual.material.baseColorFactor.tolist() == [255, 0, 0, 255]
    half = trimesh.load_scene(io.BytesIO(glb(mesh)), file_type="glb").geometry["legs"]
    assert half.visual.material.alphaMode == "BLEND"


def test_a_mesh_without_colours_has_no_materials():
    data = glb(Mesh(np.eye(3), np.array([[0, 1, 2]])))
    assert "materials" not in json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
