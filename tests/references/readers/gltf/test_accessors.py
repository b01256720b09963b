import numpy as np
import pytest

from gltf_files import CUBE, CUBE_FACES, Gltf, written
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from shapewright.references.readers.gltf.accessors import accessors
from shapewright.references.readers.gltf.buffers import views
from shapewright.references.readers.gltf.document import parse


def arrays(gltf: Gltf):
    document, _ = parse(gltf.text())
    return accessors(document, views(document, None, None))


def bounds(path) -> list:
    return read(path)[0].bounds.tolist()


@pytest.mark.parametrize(
    ("kind", "stored", "meant"),
    [
        ("i1", [-128, -127, 0, 64, 127], [-1, -1, 0, 64 / 127, 1]),
        ("u1", [0, 51, 255], [0, 0.2, 1]),
        ("i2", [-32768, -32767, 32767], [-1, -1, 1]),
        ("u2", [0, 13107, 65535], [0, 0.2, 1]),
        ("f4", [-3, 0.5, 7], [-3, 0.5, 7]),
    ],
)
def test_normalised_numbers_stand_for_fractions(kind, stored, meant):
    gltf = Gltf()
    gltf.array(stored, kind, normalized=True)
    gltf.array(stored, kind)
    np.testing.assert_allclose(arrays(gltf).floats(0, 1)[:, 0], meant, atol=1e-7)
    np.testing.assert_array_equal(arrays(gltf).floats(1, 1)[:, 0], stored)


def test_elements_may_stand_apart_and_begin_inside_their_view():
    gltf = Gltf()
    rows = np.arange(20, dtype="<f4").reshape(4, 5)
    view = gltf.view(rows.tobytes(), byteStride=20)
    gltf.accessor(4, "VEC3", "f4", bufferView=view, byteOffset=8)
    gltf.accessor(3, "VEC2", "f4", bufferView=view, byteOffset=20)
    np.testing.assert_array_equal(arrays(gltf).stored(0), rows[:, 2:])
    np.testing.assert_array_equal(arrays(gltf).stored(1), rows[1:, :2])


def test_a_stride_of_zero_is_none():
    gltf = Gltf()
    gltf.accessor(2, "VEC2", "u1", bufferView=gltf.view(bytes([1, 2, 3, 4]), byteStride=0))
    np.testing.assert_array_equal(arrays(gltf).stored(0), [[1, 2], [3, 4]])


@pytest.mark.parametrize(
    ("accessor", "why"),
    [
        ({"count": 3, "width": "VEC3", "kind": "f4"}, "do not fit into 24"),
        ({"count": 2**40, "width": "VEC3", "kind": "f4"}, "do not fit into 24"),
        ({"count": 1, "width": "VEC3", "kind": "f4", "byteOffset": 16}, "do not fit into 8"),
        ({"count": 1, "width": "VEC7", "kind": "f4"}, "accessor 0 is VEC7"),
    ],
)
def test_more_than_there_is_is_refused(accessor, why):
    gltf = Gltf()
    gltf.accessor(**accessor, bufferView=gltf.view(bytes(24)))
    with pytest.raises(UnreadableError, match=why):
        arrays(gltf).stored(0)


def test_a_stride_shorter_than_an_element_is_refused():
    gltf = Gltf()
    gltf.accessor(2, "VEC3", "f4", bufferView=gltf.view(bytes(24), byteStride=8))
    with pytest.raises(UnreadableError, match="8 apart"):
        arrays(gltf).stored(0)


def test_a_type_of_numbers_that_is_not_known_is_refused():
    gltf = Gltf()
    gltf.accessor(2, "VEC3", "f4", bufferView=gltf.view(bytes(24)))
    gltf.document["accessors"][0]["componentType"] = 5130
    with pytest.raises(UnreadableError, match="VEC3 of type 5130"):
        arrays(gltf).stored(0)


def sparse(gltf: Gltf, rows, values, kind="u2", **more) -> dict:
    return {"count": len(rows), "indices": {"bufferView": gltf.view(np.array(rows, "<" + kind).tobytes()),
            "componentType": {"u1": 5121, "u2": 5123, "u4": 5125}[kind]},
            "values": {"bufferView": gltf.view(np.array(values, "<f4").tobytes())}, **more}  # fmt: skip


class TestSparse:
    @pytest.mark.parametrize("kind", ["u1", "u2", "u4"])
    def test_positions_are_replaced(self, tmp_path, kind):
        gltf = Gltf()
        top = np.flatnonzero(CUBE[:, 1])
        position = gltf.array(CUBE, sparse=sparse(gltf, top, CUBE[top] * [1, 5, 1], kind))
        indices = gltf.array(CUBE_FACES.reshape(-1), "u1")
        path = written(tmp_path, gltf.shown(gltf.mesh({"attributes": {"POSITION": position}, "indices": indices})))
        assert bounds(path) == [[0, 0, 0], [1, 5, 1]]

    def test_without_a_base_the_others_are_zeros(self, tmp_path):
        gltf = Gltf()
        rows = np.arange(1, 8)
        position = gltf.accessor(8, "VEC3", "f4", sparse=sparse(gltf, rows, CUBE[rows] * [1, 2, 3]))
        indices = gltf.array(CUBE_FACES.reshape(-1), "u1")
        path = written(tmp_path, gltf.shown(gltf.mesh({"attributes": {"POSITION": position}, "indices": indices})))
        mesh, _ = read(path)
        assert mesh.bounds.tolist() == [[0, 0, 0], [1, 2, 3]]
        np.testing.assert_array_equal(mesh.triangles, (CUBE * [1, 2, 3])[CUBE_FACES])

    def test_a_row_that_is_not_there_is_refused(self):
        gltf = Gltf()
        gltf.array(CUBE, sparse=sparse(gltf, [8], [[0, 0, 0]]))
        with pytest.raises(UnreadableError, match="replaces element 8 of 8"):
            arrays(gltf).stored(0)

    def test_rows_of_another_type_are_refused(self):
        gltf = Gltf()
        replaced = sparse(gltf, [1], [[0, 0, 0]])
        replaced["indices"]["componentType"] = 5126
        gltf.array(CUBE, sparse=replaced)
        with pytest.raises(UnreadableError, match="sparse indices of type 5126"):
            arrays(gltf).stored(0)

    def test_more_elements_than_any_mesh_has_are_refused(self):
        gltf = Gltf()
        gltf.accessor(10**9, "VEC3", "f4", sparse=sparse(gltf, [1], [[0, 0, 0]]))
        with pytest.raises(UnreadableError, match="announces 1000000000 elements without data"):
            arrays(gltf).stored(0)


def test_sparse_positions_of_a_large_buffer_beside_a_small_file_are_read(tmp_path):
    gltf = Gltf()
    points = np.repeat(CUBE[CUBE_FACES].reshape(-1, 3), 100, axis=0)
    position = gltf.accessor(3600, "VEC3", "f4", sparse=sparse(gltf, np.arange(3600), points))
    indices = gltf.array(np.arange(0, 3600, 100), "u2")
    gltf.shown(gltf.mesh({"attributes": {"POSITION": position}, "indices": indices}))
    (tmp_path / "a.bin").write_bytes(gltf.binary)
    (tmp_path / "a.gltf").write_bytes(gltf.text(uri="a.bin"))
    np.testing.assert_array_equal(read(tmp_path / "a.gltf")[0].triangles, CUBE[CUBE_FACES])


def test_quantised_positions_are_whole_numbers_that_the_node_scales(tmp_path):
    gltf = Gltf(extensionsUsed=["KHR_mesh_quantization"], extensionsRequired=["KHR_mesh_quantization"])
    stored = (CUBE * [100, 200, 300]).astype("<i2")
    view = gltf.view(np.pad(stored, ((0, 0), (0, 1))).tobytes(), byteStride=8)
    position = gltf.accessor(8, "VEC3", "i2", bufferView=view)
    indices = gltf.array(CUBE_FACES.reshape(-1), "u1")
    mesh = gltf.mesh({"attributes": {"POSITION": position}, "indices": indices})
    path = written(tmp_path, gltf.shown(mesh, scale=[0.01, 0.01, 0.01], translation=[5, 0, 0]))
    np.testing.assert_allclose(bounds(path), [[5, 0, 0], [6, 2, 3]])


def test_normalised_positions_are_fractions_without_any_extension(tmp_path):
    gltf = Gltf()
    position = gltf.array(CUBE * [127, 64, 32], "i1", normalized=True)
    indices = gltf.array(CUBE_FACES.reshape(-1), "u1")
    path = written(tmp_path, gltf.shown(gltf.mesh({"attributes": {"POSITION": position}, "indices": indices})))
    np.testing.assert_allclose(bounds(path), [[0, 0, 0], [1, 64 / 127, 32 / 127]])
