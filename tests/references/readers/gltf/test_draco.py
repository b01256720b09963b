import DracoPy
import numpy as np
import pytest

from gltf_files import CUBE, CUBE_FACES, Gltf, written
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read


def compressed(data: bytes, used="extensionsRequired", attributes=None, **primitive) -> Gltf:
    gltf = Gltf(**{used: ["KHR_draco_mesh_compression"]})
    draco = {"bufferView": gltf.view(data), "attributes": {"POSITION": 0} if attributes is None else attributes}
    position = gltf.accessor(8, "VEC3", "f4")
    indices = gltf.accessor(36, "SCALAR", "u2")
    return gltf.shown(
        gltf.mesh({"attributes": {"POSITION": position}, "indices": indices, **primitive,
                   "extensions": {"KHR_draco_mesh_compression": draco}})
    )  # fmt: skip


@pytest.fixture(scope="module")
def data() -> bytes:
    return DracoPy.encode(CUBE * [1, 2, 3], CUBE_FACES, quantization_bits=16, preserve_order=True)


@pytest.mark.parametrize("used", ["extensionsRequired", "extensionsUsed"])
def test_the_triangles_are_decompressed(tmp_path, data, used):
    mesh, notes = read(written(tmp_path, compressed(data, used)))
    np.testing.assert_allclose(mesh.triangles, (CUBE * [1, 2, 3])[CUBE_FACES], atol=1e-3)
    assert notes == ()


def test_morph_targets_beside_them_count(tmp_path, data):
    gltf = compressed(data)
    up = gltf.array(np.tile([0, 10, 0], (8, 1)))
    gltf.document["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": up}]
    gltf.document["meshes"][0]["weights"] = [1]
    np.testing.assert_allclose(read(written(tmp_path, gltf))[0].bounds, [[0, 10, 0], [1, 12, 3]], atol=1e-3)


@pytest.mark.parametrize("used", ["extensionsRequired", "extensionsUsed"])
def test_what_cannot_be_decompressed_is_refused_and_names_draco(tmp_path, data, used):
    for broken in (b"DRACO", b"not compressed at all", data[: len(data) // 2]):
        with pytest.raises(UnreadableError, match="Draco"):
            read(written(tmp_path, compressed(broken, used)))


@pytest.mark.parametrize(("row", "count", "why"), [(0, 9, "8 vertices and 12 triangles, not 9 and 12"),
                                                   (1, 33, "8 vertices and 12 triangles, not 8 and 11")])  # fmt: skip
def test_a_stream_with_another_number_of_things_than_announced_is_refused(tmp_path, data, row, count, why):
    gltf = compressed(data)
    gltf.document["accessors"][row]["count"] = count
    with pytest.raises(UnreadableError, match=why):
        read(written(tmp_path, gltf))


@pytest.mark.parametrize("attributes", [{}, {"POSITION": 7}, {"NORMAL": 0}])
def test_a_stream_without_positions_is_refused(tmp_path, data, attributes):
    with pytest.raises(UnreadableError, match="Draco compression has no positions"):
        read(written(tmp_path, compressed(data, attributes=attributes)))
