import numpy as np
import pytest

from gltf_files import CUBE, CUBE_FACES, Gltf, written
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read


def instanced(**attributes) -> Gltf:
    """A cube at x = 100 with copies: attributes are arrays, or pairs of one and how it is stored."""
    gltf = Gltf(extensionsUsed=["EXT_mesh_gpu_instancing"], extensionsRequired=["EXT_mesh_gpu_instancing"])
    mesh = gltf.cube()
    stored = {
        name: gltf.array(*values) if isinstance(values, tuple) else gltf.array(values)
        for name, values in attributes.items()
    }
    more = {"extensions": {"EXT_mesh_gpu_instancing": {"attributes": stored}}}
    return gltf.shown(mesh, translation=[100, 0, 0], **more)


def corners(tmp_path, gltf: Gltf):
    """(I, 2, 3): the least and the greatest corner of each cube."""
    cubes = read(written(tmp_path, gltf))[0].vertices.reshape(-1, 8, 3)
    return np.stack([cubes.min(axis=1), cubes.max(axis=1)], axis=1).tolist()


def reason(tmp_path, gltf: Gltf) -> str:
    with pytest.raises(UnreadableError) as error:
        read(written(tmp_path, gltf))
    return str(error.value)


class TestInstances:
    def test_each_copy_has_a_place_a_turn_and_a_size(self, tmp_path):
        half = 0.5**0.5
        gltf = instanced(
            TRANSLATION=[[0, 0, 0], [5, 0, 0]],
            ROTATION=[[0, 0, 0, 1], [0, 0, half, half]],
            SCALE=[[1, 1, 1], [1, 2, 3]],
            _ID=[7, 8],
        )
        expected = [[[100, 0, 0], [101, 1, 1]], [[103, 0, 0], [105, 1, 3]]]
        np.testing.assert_allclose(corners(tmp_path, gltf), expected, atol=1e-6)

    def test_attributes_may_be_missing(self, tmp_path):
        assert corners(tmp_path, instanced(SCALE=[[1, 1, 1], [2, 2, 2]])) == [
            [[100, 0, 0], [101, 1, 1]],
            [[100, 0, 0], [102, 2, 2]],
        ]
        assert len(corners(tmp_path, instanced(_ID=[1, 2, 3]))) == 3
        assert len(corners(tmp_path, instanced())) == 1

    def test_other_numbers_of_them_are_refused(self, tmp_path):
        assert "instances of 1, 2 elements" in reason(tmp_path, instanced(SCALE=[[1, 1, 1]], _ID=[1, 2]))

    def test_with_a_skin_they_are_refused(self, tmp_path):
        gltf = instanced(SCALE=[[1, 1, 1]])
        gltf.document["nodes"][0]["skin"] = gltf.add("skins", joints=[0])
        assert "with a skin and with instances" in reason(tmp_path, gltf)


def test_more_triangles_than_fit_into_memory_are_refused_before_they_are_made(tmp_path):
    gltf = Gltf()
    mesh = gltf.mesh({"attributes": {"POSITION": gltf.array(np.zeros((10_000, 3)))}, "mode": 5})
    for _ in range(2000):
        gltf.add("nodes", mesh=mesh)
    assert reason(tmp_path, gltf.scene(*range(2000))).startswith("20,000,000 triangles, more than the 10,000,000")


def test_a_mesh_that_many_nodes_show_stands_at_each(tmp_path):
    gltf = Gltf()
    mesh = gltf.cube()
    nodes = [gltf.add("nodes", mesh=mesh, translation=[2 * i, 0, 0]) for i in range(3)]
    found, notes = read(written(tmp_path, gltf.scene(*nodes)))
    expected = np.concatenate([CUBE[CUBE_FACES] + [2 * i, 0, 0] for i in range(3)])
    np.testing.assert_array_equal(found.triangles, expected)
    assert notes == ()


def test_a_mesh_that_is_not_there_is_refused(tmp_path):
    gltf = Gltf()
    gltf.cube()
    assert "refers to mesh 5, but has 1" in reason(tmp_path, gltf.shown(5))
