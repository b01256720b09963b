import numpy as np
import pytest

from gltf_files import Gltf, written
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from shapewright.references.readers.gltf.graph import trs


@pytest.fixture
def gltf():
    gltf = Gltf()
    gltf.cube()
    return gltf


def placed(tmp_path, gltf: Gltf):
    """The lower corners of the cubes that a file shows, and its notes."""
    mesh, notes = read(written(tmp_path, gltf))
    return mesh.vertices.reshape(-1, 8, 3).min(axis=1).tolist(), notes


def reason(tmp_path, gltf: Gltf) -> str:
    with pytest.raises(UnreadableError) as error:
        read(written(tmp_path, gltf))
    return str(error.value)


def test_a_node_stands_in_the_frame_of_its_parent(tmp_path, gltf):
    gltf.document["nodes"] = [
        {"children": [1, 2], "translation": [10, 0, 0], "rotation": [0, 0, 0.5**0.5, 0.5**0.5], "scale": [2, 2, 2]},
        {"mesh": 0, "translation": [0, 0, 5]},
        {"children": [3], "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1]},
        {"mesh": 0},
    ]
    corners, notes = placed(tmp_path, gltf.scene(0))
    np.testing.assert_allclose(corners, [[8, 0, 10], [8, 4, 0]], atol=1e-12)
    assert notes == ()


def test_rotations_of_another_length_turn_alike_and_one_of_none_turns_nothing():
    turned = trs(np.zeros((3, 3)), np.array([[0, 0, 3.0, 3.0], [0, 0, 1e308, 1e308], [0, 0, 0, 0]]), np.ones((3, 3)))
    np.testing.assert_allclose(turned[:2, :3, :3], [[[0, -1, 0], [1, 0, 0], [0, 0, 1]]] * 2, atol=1e-15)
    np.testing.assert_array_equal(turned[2], np.eye(4))


def test_a_node_that_mirrors_keeps_the_outside_outside(tmp_path, gltf):
    mesh, _ = read(written(tmp_path, gltf.shown(0, scale=[-1, 1, 1])))
    corners = mesh.triangles
    volume = (corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    assert volume == pytest.approx(1.0)


class TestScenes:
    NODES = ({"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}, {"mesh": 0, "translation": [9, 0, 0]})

    @pytest.mark.parametrize(("scene", "x"), [({}, 0), ({"scene": 0}, 0), ({"scene": 1}, 5)])
    def test_the_default_one_is_shown_else_the_first_and_the_rest_is_noted(self, tmp_path, gltf, scene, x):
        gltf.document |= {"nodes": list(self.NODES), "scenes": [{"nodes": [0]}, {"nodes": [1]}], **scene}
        corners, notes = placed(tmp_path, gltf)
        assert corners == [[x, 0, 0]]
        assert notes == ("2 x mesh left out: not in the scene that opens, one of 2",)

    def test_nodes_in_no_scene_are_noted(self, tmp_path, gltf):
        gltf.document |= {"nodes": list(self.NODES), "scenes": [{"nodes": [1]}]}
        assert placed(tmp_path, gltf) == ([[5, 0, 0]], ("2 x mesh left out: in no scene",))

    def test_where_there_is_none_all_nodes_are_shown_with_a_note(self, tmp_path, gltf):
        gltf.document["nodes"] = list(self.NODES)
        corners, notes = placed(tmp_path, gltf)
        assert corners == [[0, 0, 0], [5, 0, 0], [9, 0, 0]]
        assert notes == ("it has no scene: all its nodes are shown",)

    def test_meshes_that_nothing_shows_are_a_reason(self, tmp_path, gltf):
        assert reason(tmp_path, gltf) == "no scene shows any of its meshes"
        gltf.document |= {"nodes": list(self.NODES), "scenes": [{}, {"nodes": [0]}]}
        assert (
            reason(tmp_path, gltf)
            == "the scene shows no mesh; 3 x mesh left out: not in the scene that opens, one of 2"
        )

    def test_a_scene_that_lists_a_node_under_another_shows_it_where_that_puts_it(self, tmp_path, gltf):
        gltf.document["nodes"] = [{"children": [1], "translation": [0, 7, 0]}, {"mesh": 0, "translation": [1, 0, 0]}]
        assert placed(tmp_path, gltf.scene(1)) == ([[1, 7, 0]], ())
        assert placed(tmp_path, gltf.scene(0, 1)) == ([[1, 7, 0]], ())

    @pytest.mark.parametrize("document", [{"scenes": [{"nodes": [3]}]}, {"scenes": [{}], "scene": 1}, {"scene": 0}])
    def test_what_it_refers_to_has_to_be_there(self, tmp_path, gltf, document):
        gltf.document |= {"nodes": list(self.NODES), **document}
        assert "refers to" in reason(tmp_path, gltf)


class TestHiddenNodes:
    def hidden(self, **node):
        return {**node, "extensions": {"KHR_node_visibility": {"visible": False}}}

    def test_they_and_all_below_them_are_left_out_with_a_note(self, tmp_path, gltf):
        visible = {"mesh": 0, "translation": [1, 0, 0], "extensions": {"KHR_node_visibility": {"visible": True}}}
        gltf.document["nodes"] = [self.hidden(mesh=0, children=[1]), visible, {"mesh": 0, "translation": [4, 0, 0]}]
        assert placed(tmp_path, gltf.scene(0, 2)) == ([[4, 0, 0]], ("2 x mesh left out: hidden",))

    def test_where_all_are_hidden_that_is_the_reason(self, tmp_path, gltf):
        gltf.document["nodes"] = [self.hidden(mesh=0)]
        assert reason(tmp_path, gltf.scene(0)) == "the scene shows no mesh; 1 x mesh left out: hidden"


class TestHostileGraphs:
    @pytest.mark.parametrize(
        "nodes", [[{"children": [0], "mesh": 0}], [{"children": [1]}, {"children": [0], "mesh": 0}]]
    )
    def test_cycles_are_refused(self, tmp_path, gltf, nodes):
        gltf.document["nodes"] = nodes
        assert f"a cycle, {len(nodes)} of its nodes stand below themselves" in reason(tmp_path, gltf.scene(0))

    def test_a_node_under_two_parents_stands_in_both_places(self, tmp_path, gltf):
        gltf.document["nodes"] = [{"children": [2]}, {"children": [2], "translation": [3, 0, 0]}, {"mesh": 0}]
        assert placed(tmp_path, gltf.scene(0, 1)) == ([[0, 0, 0], [3, 0, 0]], ())

    def test_places_that_double_with_each_level_are_refused(self, tmp_path, gltf):
        levels = 60
        gltf.document["nodes"] = [{"children": [i + 1, i + 1]} for i in range(levels)] + [{"mesh": 0}]
        assert "more than 200,000 places" in reason(tmp_path, gltf.scene(0))

    def test_a_long_chain_is_read(self, tmp_path, gltf):
        links = 5000
        gltf.document["nodes"] = [{"children": [i + 1], "translation": [1, 0, 0]} for i in range(links)] + [{"mesh": 0}]
        assert placed(tmp_path, gltf.scene(0))[0] == [[links, 0, 0]]

    def test_a_child_that_is_not_there_is_refused(self, tmp_path, gltf):
        gltf.document["nodes"] = [{"children": [9], "mesh": 0}]
        assert "refers to node 9, but has 1" in reason(tmp_path, gltf.scene(0))
