import json
import logging
import struct
import warnings
from pathlib import Path

import numpy as np
import pytest
import trimesh

from shapewright.references import Collection
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import EXTENSIONS, MESH_FORMATS, contents, read
from shapewright.shapes.files import FORMATS
from threemf_files import mesh, model, object_, single

# A soup: an open box corner with a doubled face, an inverted one, and a degenerate one.
VERTICES = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0], [0, 0, 0.5], [2, 0, 0.5]])
FACES = np.array([[0, 1, 2], [0, 2, 3], [0, 2, 3], [3, 2, 0], [0, 1, 5], [0, 5, 4], [1, 1, 2]])
SQUARE = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


@pytest.fixture(autouse=True)
def silence(caplog, capfd):
    """Nothing is to be printed, warned of or logged at WARNING while a file is read."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield
    assert [record for record in caplog.records if record.levelno >= logging.WARNING] == []
    assert "".join(capfd.readouterr()) == ""


def put(tmp_path, name: str, content: bytes):
    path = tmp_path / name
    path.write_bytes(content)
    return path


def triangles(path) -> np.ndarray:
    return read(path)[0].triangles


def reason(path) -> str:
    with pytest.raises(UnreadableError) as error:
        read(path)
    return str(error.value)


def soup() -> trimesh.Trimesh:
    return trimesh.Trimesh(VERTICES, FACES, process=False)


@pytest.mark.parametrize("kind", [".obj", ".ply", ".stl", ".off", ".glb", ".3mf"])
@pytest.mark.parametrize("case", [str.lower, str.upper])
def test_each_kind_gives_back_the_same_triangles_in_their_order(tmp_path, kind, case):
    path = tmp_path / case(f"shape{kind}")
    path.write_bytes(
        trimesh.exchange.export.export_mesh(soup(), None, kind[1:]).encode()
        if kind in (".obj", ".off")
        else trimesh.exchange.export.export_mesh(soup(), None, kind[1:])
    )
    np.testing.assert_allclose(triangles(path), VERTICES[FACES], atol=1e-7)
    assert read(path)[1] == ()


def test_gltf_with_its_buffers_beside_it(tmp_path):
    for name, content in soup().scene().export(file_type="gltf").items():
        put(tmp_path, name, content)
    np.testing.assert_allclose(triangles(tmp_path / "model.gltf"), VERTICES[FACES])
    (tmp_path / "gltf_buffer_0.bin").unlink()
    assert reason(tmp_path / "model.gltf") == "it needs gltf_buffer_0.bin, which is missing"


@pytest.mark.parametrize("kind", ["ply", "stl"])
def test_the_ascii_kinds(tmp_path, kind):
    options = {"ply": {"encoding": "ascii"}, "stl": {}}[kind]
    content = soup().export(file_type="stl_ascii" if kind == "stl" else "ply", **options)
    path = put(tmp_path, f"shape.{kind}", content.encode() if isinstance(content, str) else content)
    np.testing.assert_allclose(triangles(path), VERTICES[FACES], atol=1e-7)


@pytest.mark.parametrize("kind", ["glb", "3mf"])
def test_scenes_are_flattened_where_they_place_their_meshes(tmp_path, kind):
    scene = trimesh.Scene()
    part = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], process=False)
    turn = trimesh.transformations.rotation_matrix(np.pi / 2, [0, 0, 1])
    lift = trimesh.transformations.translation_matrix([0, 0, 5])
    scene.add_geometry(part, geom_name="part", node_name="turned", transform=turn)
    scene.graph.update("lifted", "world", matrix=lift, geometry="part")
    path = put(tmp_path, f"scene.{kind}", scene.export(file_type=kind))
    found = sorted(np.round(triangle, 6).tolist() for triangle in triangles(path) + 0.0)
    assert found == [[[0, 0, 0], [0, 1, 0], [-1, 0, 0]], [[0, 0, 5], [1, 0, 5], [0, 1, 5]]]


def test_vertices_that_no_triangle_uses_are_left_out(tmp_path):
    mesh, notes = read(put(tmp_path, "a.obj", b"v nan 0 0\nv 900 0 0\n" + SQUARE + b"f 3 4 5\n"))
    assert mesh.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0]]
    assert notes == ()


def test_triangles_with_a_corner_that_is_not_finite_are_left_out_with_a_note(tmp_path):
    mesh, notes = read(put(tmp_path, "a.obj", SQUARE + b"v inf 0 0\nf 1 2 3\nf 1 2 5\nf 1 3 4\n"))
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert notes == ("1 of 3 triangles left out: a corner is not finite",)


class TestObj:
    def test_statements_of_every_other_kind_are_passed_over(self, tmp_path):
        content = b"""# made by hand
mtllib missing.mtl
o seat
g first second
v 0 0 0 1.0 0.5 0.5
v\t1 0 0
v 1 1 0 # a comment
vt 0 0
vt 1 1 0
vn 0 0 1
vp 0.5
s off
usemtl \xe9b\xe8ne
  f 1/1/1 2/2/1 3/1/1
f 1//1 2//1 \\
3//1 # split over two lines
l 1 2
p 1
o back
v 0 1 0
f 1/1 3/2 4/1
"""
        path = put(tmp_path, "a.obj", content)
        mesh, _ = read(path)
        assert mesh.faces.tolist() == [[0, 1, 2], [0, 1, 2], [0, 2, 3]]
        assert mesh.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        np.testing.assert_array_equal(
            triangles(put(tmp_path, "b.obj", content.replace(b"\n", b"\r\n"))), mesh.triangles
        )

    def test_relative_indices_count_back_from_the_face_that_uses_them(self, tmp_path):
        content = SQUARE + b"f -4 -3 -2 -1\n" + SQUARE.replace(b"0\n", b"7\n") + b"f -4//-1 -3//-1 -2//-1\n"
        found = triangles(put(tmp_path, "a.obj", content))
        assert found[:, :, 2].tolist() == [[0, 0, 0], [0, 0, 0], [7, 7, 7]]

    def test_polygons_of_mixed_counts(self, tmp_path):
        content = b"v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\nf 1 2 3\nf 1 2\nf 1 2 4 5\n"
        found = triangles(put(tmp_path, "a.obj", content))
        areas = np.linalg.norm(np.cross(found[:, 1] - found[:, 0], found[:, 2] - found[:, 0]), axis=1) / 2
        assert len(found) == 6
        assert areas[:3].sum() == pytest.approx(10.0)

    @pytest.mark.parametrize(
        ("line", "why"),
        [
            (b"f 1 2 9", "point outside its 4 vertices"),
            (b"f 0 1 2", "point outside its 4 vertices"),
            (b"f -9 1 2", "point outside its 4 vertices"),
            (b"f a b c", "cannot understand the line 'f a b c'"),
            (b"v 1 2", "cannot understand the line 'v 1 2'"),
            (b"v 1,5 2 3", "cannot understand the line 'v 1,5 2 3'"),
        ],
    )
    def test_a_broken_line_is_the_reason(self, tmp_path, line, why):
        assert why in reason(put(tmp_path, "a.obj", SQUARE + line + b"\n"))


class TestPly:
    HEADER = (
        "ply\nformat {} 1.0\ncomment element vertex 9\nobj_info x\nelement vertex 5\nproperty double x\n"
        "property float y\nproperty float z\nproperty uchar red\nelement face 2\nproperty short flag\n"
        "property list uchar int {}\nproperty list uchar float texcoord\n"
        "element edge 1\nproperty int vertex1\nend_header\n"
    )
    POINTS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1))
    LOOPS = ((0, 1, 2, 3), (0, 1, 4))
    FACES = ((0, 1, 2), (0, 2, 3), (0, 1, 4))

    def binary(self, order: str) -> bytes:
        points = b"".join(struct.pack(order + "dffB", *point, 7) for point in self.POINTS)
        texture = struct.pack(order + "B2f", 2, 0.5, 0.5)
        loops = (struct.pack(f"{order}hB{len(loop)}i", 1, len(loop), *loop) + texture for loop in self.LOOPS)
        return points + b"".join(loops) + struct.pack(order + "i", 3)

    @pytest.mark.parametrize("name", ["vertex_indices", "vertex_index"])
    @pytest.mark.parametrize(("word", "order"), [("binary_little_endian", "<"), ("binary_big_endian", ">")])
    def test_binary_files_that_mix_polygons_with_other_properties(self, tmp_path, word, order, name):
        path = put(tmp_path, "a.ply", self.HEADER.format(word, name).encode() + self.binary(order))
        np.testing.assert_array_equal(triangles(path), np.array(self.POINTS)[np.array(self.FACES)])

    def test_ascii_files_that_mix_polygons(self, tmp_path):
        points = "".join(f"{x} {y} {z} 7\n" for x, y, z in self.POINTS)
        loops = "".join(f"1 {len(loop)} {' '.join(map(str, loop))} 2 .5 .5\n" for loop in self.LOOPS)
        content = self.HEADER.format("ascii", "vertex_indices") + points + loops + "3\n"
        for name, text in (("a.ply", content), ("b.ply", content.replace("\n", "\r\n"))):
            found = triangles(put(tmp_path, name, text.encode()))
            np.testing.assert_array_equal(found, np.array(self.POINTS)[np.array(self.FACES)])

    def test_every_cut_of_a_file_is_a_reason_or_the_whole_shape(self, tmp_path):
        content = self.HEADER.format("binary_little_endian", "vertex_indices").encode() + self.binary("<")
        body = len(content) - len(self.binary("<"))
        for length in range(body, len(content) - 4, 5):
            assert "cut short" in reason(put(tmp_path, "a.ply", content[:length]))
        assert "no PLY header" in reason(put(tmp_path, "a.ply", content[: body // 2]))

    @pytest.mark.parametrize(
        ("header", "why"),
        [
            (b"plywood\nend_header\n", "no PLY header"),
            (b"ply\nformat binary_middle 1.0\nend_header\n", "unknown PLY format 'binary_middle'"),
            (b"ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n0\n", "quad"),
            (b"ply\nformat ascii 1.0\nend_header\n", "no vertices"),
            (b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
             b"end_header\n0 0 zero\n", "zero"),
        ],
    )  # fmt: skip
    def test_a_broken_header_or_body_is_the_reason(self, tmp_path, header, why):
        assert why in reason(put(tmp_path, "a.ply", header))


class TestOff:
    @pytest.mark.parametrize(
        "content",
        [
            b"OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
            b"OFF4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
            b"# who made it\n\nOFF 4 1 0 # counts\n\n0 0 0\n1 0 0\r\n1 1 0\n# half way\n0 1 0\n4 0 1 2 3 255 0 0\n",
            b"COFF\n4 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n1 1 0 1 1 1 1\n0 1 0 1 1 1 1\n4 0 1 2 3\n",
            b"STCNOFF\n4 1\n0 0 0 9 9\n1 0 0 9 9\n1 1 0 9 9\n0 1 0 9 9\n4 0 1 2 3\n",
        ],
    )
    def test_its_kinds(self, tmp_path, content):
        square = [[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]]
        assert triangles(put(tmp_path, "a.off", content)).tolist() == square

    @pytest.mark.parametrize(
        ("content", "why"),
        [
            (b"solid\n", "does not begin with OFF"),
            (b"OFF BINARY\n\0\0", "binary OFF"),
            (b"OFF\n", "broken"),
            (b"OFF\n4 2 0\n0 0 0\n", "cut short: 4 vertices and 2 faces announced"),
            (b"OFF\n3 1 0\n0 0 0\n1 0 0\n1 1\n3 0 1 2\n", "broken"),
            (b"OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n", "point outside its 3 vertices"),
            (b"OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n4 0 1 2\n", "broken"),
        ],
    )
    def test_a_broken_file_is_the_reason(self, tmp_path, content, why):
        assert why in reason(put(tmp_path, "a.off", content))


class TestReasons:
    @pytest.mark.parametrize("kind", EXTENSIONS)
    def test_noise_an_empty_file_a_pointer_and_no_file_are_reasons_for_every_kind(self, tmp_path, kind):
        noise = np.random.default_rng(0).bytes(3000)
        assert reason(put(tmp_path, f"noise{kind}", noise))
        assert reason(put(tmp_path, f"text{kind}", b"<!DOCTYPE html>\n<html></html>\n"))
        assert reason(put(tmp_path, f"empty{kind}", b"")) == "the file is empty"
        assert "git lfs pull" in reason(
            put(tmp_path, f"lfs{kind}", b"version https://git-lfs.github.com/spec/v1\noid x\n")
        )
        assert reason(tmp_path / f"none{kind}") == "no such file or directory"

    @pytest.mark.parametrize(("kind", "why"), [("stl", "cut short"), ("glb", "broken"), ("3mf", "broken")])
    def test_a_file_cut_in_half(self, tmp_path, kind, why):
        content = trimesh.creation.icosphere(2).export(file_type=kind)
        assert why in reason(put(tmp_path, f"a.{kind}", content[: len(content) // 2]))

    def test_few_points(self, tmp_path):
        cloud = trimesh.PointCloud(VERTICES)
        why = reason(put(tmp_path, "a.glb", cloud.scene().export(file_type="glb")))
        assert why == "no triangles, only points or lines"
        why = reason(put(tmp_path, "a.ply", cloud.export(file_type="ply")))
        assert why == f"only {len(VERTICES)} points, too few to show a surface: 100 at least"

    def test_lines(self, tmp_path):
        path = trimesh.load_path(VERTICES[:3])
        assert (
            reason(put(tmp_path, "a.glb", path.scene().export(file_type="glb"))) == "no triangles, only points or lines"
        )
        assert reason(put(tmp_path, "a.obj", SQUARE + b"l 1 2 3\n")) == "no triangles, only points or lines"

    def test_nothing_at_all(self, tmp_path):
        assert reason(put(tmp_path, "a.obj", b"# nothing\n")) == "it holds no triangles"
        assert reason(put(tmp_path, "a.stl", bytes(84))) == "it holds no triangles"
        assert reason(put(tmp_path, "a.gltf", b'{"asset": {"version": "2.0"}}')) == "it holds no triangles"

    @pytest.mark.parametrize(
        ("vertices", "why"),
        [
            (b"v 1 1 1\nv 1 1 1\nv 1 1 1\n", "all its triangles lie at one point"),
            (b"v 0 0 0\nv 1 0 0\nv 2 0 0\n", "its triangles have no area"),
            (b"v 0 0 0\nv nan 0 0\nv 2 0 0\n", "no triangle has finite corners"),
            (b"v 1e308 0 0\nv -1e308 0 0\nv 0 1 0\n", "too large to measure"),
            (b"v 1e308 0 0\nv 1.1e308 0 0\nv 0 1 0\n", "too large to measure"),
        ],
    )
    def test_triangles_that_cannot_be_seen_or_measured(self, tmp_path, vertices, why):
        assert why in reason(put(tmp_path, "a.obj", vertices + b"f 1 2 3\n"))

    def test_a_small_shape_that_lies_far_away_is_fine(self, tmp_path):
        far = b"v 1e300 0 0\nv 1e300 1e-10 0\nv 1e300 0 1e-10\n"
        assert len(triangles(put(tmp_path, "a.obj", far + b"f 1 2 3\n"))) == 1

    def test_a_sheet_without_thickness_is_fine(self, tmp_path):
        assert len(triangles(put(tmp_path, "a.obj", SQUARE + b"f 1 2 3 4\nf 4 3 2 1\n"))) == 4

    @pytest.mark.parametrize("kind", ["obj", "off", "ply", "stl"])
    def test_a_file_of_another_kind_inside_says_what_it_holds(self, tmp_path, kind):
        assert reason(put(tmp_path, f"a.{kind}", b"<!DOCTYPE html>" + bytes(99))).endswith("it holds a web page")
        assert reason(put(tmp_path, f"b.{kind}", b"\x89PNG\r\n" + bytes(99))).endswith("it holds a PNG")
        assert "it holds a" not in reason(put(tmp_path, f"c.{kind}", b"solid\nfacet\n" if kind == "stl" else b"\0\1"))

    def test_another_kind_of_file(self, tmp_path):
        assert ".obj" in reason(put(tmp_path, "a.txt", b"x"))
        assert "a Blender file, which is not read: open it in Blender" in reason(put(tmp_path, "a.blend", b"x"))

    def test_a_pointer_and_a_link_of_git_annex(self, tmp_path):
        assert "git annex get" in reason(put(tmp_path, "a.obj", b"/annex/objects/MD5-s9--00\n"))
        (tmp_path / "b.obj").symlink_to(tmp_path / "none.obj")
        assert "a link to a file that is not there" in reason(tmp_path / "b.obj")


def test_every_text_lists_the_formats_that_there_are():
    root = Path(__file__).resolve().parents[3]
    assert f"Meshes ({', '.join(MESH_FORMATS)})" in " ".join(
        (root / "studio-page/src/first/drop.tsx").read_text().split()
    )
    assert f"{', '.join(MESH_FORMATS[:-1])} and {MESH_FORMATS[-1]}" in Collection.load.__doc__
    page = (root / "studio-page/src/frame/exporting.tsx").read_text()
    assert f"({json.dumps(FORMATS)} as ExportFormat[]).map" in page
    assert set(FORMATS) < {extension[1:] for extension in EXTENSIONS}


def test_what_a_format_or_a_file_states_of_unit_and_up_is_told(tmp_path):
    inches = single(model(object_(1, mesh()), 'objectid="1"', attributes='unit="inch"'))
    found = contents(put(tmp_path, "a.3mf", inches))
    assert (found.unit, found.up) == (pytest.approx(0.0254), "z")
    soup().export(tmp_path / "a.glb")
    assert (contents(tmp_path / "a.glb").unit, contents(tmp_path / "a.glb").up) == (1.0, "y")
    soup().export(tmp_path / "a.ply")
    assert (contents(tmp_path / "a.ply").unit, contents(tmp_path / "a.ply").up) == (None, None)
