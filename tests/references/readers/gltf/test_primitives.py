import numpy as np
import pytest

from gltf_files import CUBE, CUBE_FACES, Gltf, written
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from shapewright.references.readers.gltf.accessors import accessors
from shapewright.references.readers.gltf.buffers import views
from shapewright.references.readers.gltf.document import parse
from shapewright.references.readers.gltf.primitives import geometry

ROW = np.array([[i // 2, i % 2, 0] for i in range(6)])
"""Six points of a ladder, as a strip uses them."""


def shape(gltf: Gltf, morph=(), **primitive):
    """The geometry of a file whose only mesh has one primitive."""
    gltf.mesh(primitive)
    document, _ = parse(gltf.text())
    arrays = accessors(document, views(document, None, None))
    return geometry(document.meshes[0].primitives[0], morph, arrays, None)


def triangles(mode, points, indices=None, kind="u2"):
    gltf = Gltf()
    more = {} if indices is None else {"indices": gltf.array(indices, kind)}
    found = shape(gltf, attributes={"POSITION": gltf.array(points)}, mode=mode, **more)
    return found.vertices[found.faces]


def normals(corners) -> list:
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).tolist()


@pytest.mark.parametrize("kind", ["u1", "u2", "u4"])
def test_a_list_of_triangles_with_indices_of_each_type(kind):
    np.testing.assert_array_equal(triangles(4, CUBE, CUBE_FACES.reshape(-1), kind), CUBE[CUBE_FACES])


def test_a_list_of_triangles_without_indices():
    np.testing.assert_array_equal(triangles(4, CUBE[CUBE_FACES].reshape(-1, 3)), CUBE[CUBE_FACES])


@pytest.mark.parametrize("indices", [None, [0, 1, 2, 3, 4, 5]])
def test_a_strip_turns_every_second_triangle(indices):
    found = triangles(5, ROW, indices)
    np.testing.assert_array_equal(found, ROW[[[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4]]])
    assert normals(found) == [[0, 0, -1]] * 4


@pytest.mark.parametrize("indices", [None, [0, 1, 2, 3]])
def test_a_fan_goes_round_its_first_corner(indices):
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    found = triangles(6, square, indices)
    np.testing.assert_array_equal(np.sort(found, axis=1), np.sort(square[[[1, 2, 0], [2, 3, 0]]], axis=1))
    assert normals(found) == [[0, 0, 1]] * 2


@pytest.mark.parametrize("mode", [5, 6])
def test_strips_and_fans_of_two_corners_are_nothing(mode):
    assert len(triangles(mode, ROW[:2])) == 0


def test_corners_that_are_no_whole_triangle_are_noted(tmp_path):
    gltf = Gltf()
    indices = gltf.array([*CUBE_FACES.reshape(-1), 0, 1], "u2")
    path = written(tmp_path, gltf.shown(gltf.mesh({"attributes": {"POSITION": gltf.array(CUBE)}, "indices": indices})))
    mesh, notes = read(path)
    assert len(mesh.faces) == 12
    assert notes == ("2 x corner left out: no whole triangle",)


def test_points_lines_and_meshes_without_positions_are_noted(tmp_path):
    gltf = Gltf()
    position = gltf.array(CUBE)
    indices = gltf.array(CUBE_FACES.reshape(-1), "u2")
    primitives = [{"attributes": {"POSITION": position}, "mode": mode} for mode in range(4)]
    primitives += [{"attributes": {"NORMAL": position}}, {"attributes": {"POSITION": position}, "indices": indices}]
    mesh, notes = read(written(tmp_path, gltf.shown(gltf.mesh(*primitives))))
    assert len(mesh.faces) == 12
    assert notes == ("5 x primitive left out: points, lines, or without positions",)


def test_a_mode_that_is_not_known_is_refused(tmp_path):
    gltf = Gltf()
    path = written(tmp_path, gltf.shown(gltf.mesh({"attributes": {"POSITION": gltf.array(CUBE)}, "mode": 7})))
    with pytest.raises(UnreadableError, match="a primitive of mode 7"):
        read(path)


def test_an_index_that_points_at_no_vertex_of_its_own_primitive_is_refused(tmp_path):
    gltf = Gltf()
    first = gltf.cube()
    part = {"attributes": {"POSITION": gltf.array(CUBE[:3])}, "indices": gltf.array([0, 1, 3], "u2")}
    gltf.scene(gltf.add("nodes", mesh=gltf.mesh(part)), gltf.add("nodes", mesh=first))
    with pytest.raises(UnreadableError, match="point outside its 3 vertices"):
        read(written(tmp_path, gltf))


@pytest.mark.parametrize("kind", ["f4", "i2"])
def test_indices_of_another_type_are_refused(kind):
    gltf = Gltf()
    with pytest.raises(UnreadableError, match="holds no indices"):
        shape(gltf, attributes={"POSITION": gltf.array(ROW)}, indices=gltf.array([0, 1, 2], kind))


def test_positions_of_two_numbers_are_refused():
    gltf = Gltf()
    with pytest.raises(UnreadableError, match="VEC2, not of 3 numbers"):
        shape(gltf, attributes={"POSITION": gltf.array(ROW[:, :2])})


@pytest.mark.parametrize("missing", ["positions", "indices"])
def test_a_mesh_without_data_names_what_compresses_it(missing):
    gltf = Gltf()
    attributes = {"POSITION": gltf.accessor(6, "VEC3", "f4") if missing == "positions" else gltf.array(ROW)}
    indices = gltf.accessor(6, "SCALAR", "u2")
    with pytest.raises(UnreadableError, match=f"no data for its {missing}: it is compressed by EXT_squeezed"):
        shape(gltf, attributes=attributes, indices=indices, extensions={"EXT_squeezed": {}})


def test_vertices_that_a_primitive_does_not_use_are_not_taken():
    gltf = Gltf()
    points = gltf.array(np.arange(3000).reshape(1000, 3))
    found = shape(gltf, attributes={"POSITION": points}, indices=gltf.array([10, 12, 11, 12, 10, 13], "u2"))
    assert len(found.vertices) == 4
    assert found.vertices[found.faces][:, :, 0].tolist() == [[30, 36, 33], [36, 30, 39]]
    gltf.document["meshes"].clear()
    found = shape(gltf, attributes={"POSITION": points}, indices=gltf.array([999, 0, 500], "u2"))
    assert found.vertices[found.faces][:, :, 0].tolist() == [[2997, 0, 1500]]
    assert len(found.vertices) == 3


class TestMorphTargets:
    UP, OUT = np.array([[0, 2, 0]] * 6), np.array([[3, 0, 0]] * 6)

    def gltf(self, mesh_weights=None, node_weights=None):
        gltf = Gltf()
        targets = [
            {"POSITION": gltf.array(self.UP)},
            {"NORMAL": gltf.array(self.UP)},
            {"POSITION": gltf.array(self.OUT)},
        ]
        more = {} if mesh_weights is None else {"weights": mesh_weights}
        mesh = gltf.mesh({"attributes": {"POSITION": gltf.array(ROW)}, "mode": 5, "targets": targets}, **more)
        return gltf.shown(mesh, **({} if node_weights is None else {"weights": node_weights}))

    @pytest.mark.parametrize(
        ("mesh_weights", "node_weights", "moved"),
        [
            (None, None, [0, 0, 0]),
            ([0.5, 1, 0], None, [0, 1, 0]),
            ([0.5, 1, 2], None, [6, 1, 0]),
            ([0.5, 1, 2], [1, 0, 0], [0, 2, 0]),
            (None, [0, 0, -1], [-3, 0, 0]),
            ([1], None, [0, 2, 0]),
        ],
    )
    def test_default_weights_count_and_a_nodes_own_come_first(self, tmp_path, mesh_weights, node_weights, moved):
        mesh, _ = read(written(tmp_path, self.gltf(mesh_weights, node_weights)))
        np.testing.assert_allclose(mesh.bounds[0], moved)

    def test_a_target_of_another_length_is_refused(self):
        gltf = Gltf()
        with pytest.raises(UnreadableError, match="a morph target has 3 values for 6 vertices"):
            shape(gltf, [1.0], attributes={"POSITION": gltf.array(ROW)}, targets=[{"POSITION": gltf.array(ROW[:3])}])


ENDS = {"min": CUBE.min(axis=0).tolist(), "max": CUBE.max(axis=0).tolist()}


@pytest.mark.parametrize(
    ("ends", "noted"),
    [
        (ENDS, False),
        (ENDS | {"max": (np.array(ENDS["max"]) * 1.001).tolist()}, False),
        (ENDS | {"max": (np.array(ENDS["min"]) * 0.5).tolist()}, True),
        (ENDS | {"max": (np.array(ENDS["max"]) * 1.5).tolist()}, True),
        (ENDS | {"max": "far"}, False),
        ({"min": [0], "max": [1]}, False),
    ],
)
def test_positions_elsewhere_than_the_file_says_are_noted(tmp_path, ends, noted):
    gltf = Gltf()
    indices = gltf.array(CUBE_FACES.reshape(-1), "u2")
    primitive = {"attributes": {"POSITION": gltf.array(CUBE, **ends)}, "indices": indices}
    _, notes = read(written(tmp_path, gltf.shown(gltf.mesh(primitive))))
    assert notes == (("1 x mesh with positions elsewhere than the file says of them",) if noted else ())


@pytest.mark.parametrize(
    ("row", "by", "noted"), [("accessors", 0, False), ("accessors", 1, True), ("bufferViews", 1, True)]
)
def test_positions_that_begin_within_a_number_are_noted(tmp_path, row, by, noted):
    gltf = Gltf()
    view = gltf.view(np.ascontiguousarray(CUBE, "<f4").tobytes() + bytes(4))
    positions = gltf.accessor(len(CUBE), "VEC3", "f4", bufferView=view)
    indices = gltf.array(CUBE_FACES.reshape(-1), "u2")
    scene = gltf.shown(gltf.mesh({"attributes": {"POSITION": positions}, "indices": indices}))
    scene.document[row][0]["byteOffset"] = by
    if row == "bufferViews":
        scene.document[row][0]["byteLength"] = 12 * len(CUBE)
    _, notes = read(written(tmp_path, scene))
    assert notes == (("1 x mesh whose positions or indices begin within a number",) if noted else ())
