import numpy as np
import pytest

from gltf_files import CUBE, CUBE_FACES, Gltf, written
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read

MOVED = np.eye(4)
MOVED[:3, 3] = [0, 0, 7]
RIGHT = np.array([1, 0, 0])
TOP = CUBE[:, 1] == 1


def skinned(joints, weights, inverse=None, weight_kind="f4", **node) -> Gltf:
    """A cube whose node is scaled, with two joints: one at x = 1, one below it at y = 2, turned a quarter about z."""
    gltf = Gltf()
    attributes = {"POSITION": gltf.array(CUBE)}
    for i, (joint, weight) in enumerate(zip(joints, weights, strict=True)):
        attributes[f"JOINTS_{i}"] = gltf.array(joint, "u1")
        attributes[f"WEIGHTS_{i}"] = gltf.array(weight, weight_kind, normalized=weight_kind != "f4")
    mesh = gltf.mesh({"attributes": attributes, "indices": gltf.array(CUBE_FACES.reshape(-1), "u1")})
    more = {} if inverse is None else {"inverseBindMatrices": gltf.array(inverse)}
    gltf.add("skins", joints=[1, 2], **more)
    half = 0.5**0.5
    gltf.document["nodes"] = [
        {"mesh": mesh, "skin": 0, "scale": [100, 100, 100], "translation": [50, 0, 0], **node},
        {"translation": [1, 0, 0], "children": [2]},
        {"translation": [0, 2, 0], "rotation": [0, 0, half, half]},
    ]
    return gltf.scene(0, 1)


def rows(*values) -> list:
    return [list(values)] * 8


def vertices(tmp_path, gltf: Gltf):
    return read(written(tmp_path, gltf))[0].vertices


def test_joints_place_a_mesh_and_its_own_node_does_not(tmp_path):
    found = vertices(tmp_path, skinned([rows(0, 0, 0, 0)], [rows(1, 0, 0, 0)]))
    np.testing.assert_allclose(found, CUBE + RIGHT)
    found = vertices(tmp_path, skinned([rows(1, 0, 0, 0)], [rows(1, 0, 0, 0)]))
    np.testing.assert_allclose(found, np.stack([1 - CUBE[:, 1], 2 + CUBE[:, 0], CUBE[:, 2]], axis=1), atol=1e-12)


def test_inverse_bind_matrices_come_first(tmp_path):
    found = vertices(tmp_path, skinned([rows(0, 0, 0, 0)], [rows(1, 0, 0, 0)], [MOVED, np.eye(4)]))
    np.testing.assert_allclose(found, CUBE + RIGHT + MOVED[:3, 3])


def test_weights_mix_joints_in_up_to_several_sets(tmp_path):
    both = (
        CUBE * [0.75, 0.75, 1]
        + np.array([1, 0.5, 0])
        + 0.25 * np.stack([-CUBE[:, 1], CUBE[:, 0], 0 * CUBE[:, 0]], axis=1)
    )
    one = skinned([rows(0, 1, 0, 0)], [rows(0.75, 0.25, 0, 0)])
    np.testing.assert_allclose(vertices(tmp_path, one), both, atol=1e-12)
    two = skinned([rows(0, 0, 0, 0), rows(1, 0, 0, 0)], [rows(0.5, 0.25, 0, 0), rows(0.25, 0, 0, 0)])
    np.testing.assert_allclose(vertices(tmp_path, two), both, atol=1e-12)


def test_weights_as_whole_numbers_are_made_to_add_up_to_one(tmp_path):
    found = vertices(tmp_path, skinned([rows(0, 0, 0, 0)], [rows(200, 50, 0, 0)], weight_kind="u1"))
    np.testing.assert_allclose(found, CUBE + RIGHT)


def test_a_vertex_without_weights_follows_its_first_joint(tmp_path):
    weights = np.where(TOP[:, None], [1, 0, 0, 0], 0)
    np.testing.assert_allclose(vertices(tmp_path, skinned([rows(0, 1, 0, 0)], [weights])), CUBE + RIGHT)


def test_joints_that_are_not_there_count_only_with_a_weight(tmp_path):
    found = vertices(tmp_path, skinned([rows(0, 99, 0, 0)], [rows(1, 0, 0, 0)]))
    np.testing.assert_allclose(found, CUBE + RIGHT)
    with pytest.raises(UnreadableError, match="refers to joint 99 of 2"):
        vertices(tmp_path, skinned([rows(0, 99, 0, 0)], [rows(0.5, 0.5, 0, 0)]))


def test_a_skin_on_a_mesh_without_joints_leaves_it_at_its_node(tmp_path):
    np.testing.assert_allclose(vertices(tmp_path, skinned([], [])), 100 * CUBE + 50 * RIGHT)


def test_fewer_inverse_bind_matrices_than_joints_are_refused(tmp_path):
    with pytest.raises(UnreadableError, match="2 joints, but 1 inverse bind"):
        vertices(tmp_path, skinned([rows(0, 0, 0, 0)], [rows(1, 0, 0, 0)], [MOVED]))


def test_what_a_skin_refers_to_has_to_be_there(tmp_path):
    gltf = skinned([rows(0, 0, 0, 0)], [rows(1, 0, 0, 0)])
    gltf.document["skins"][0]["joints"] = [1, 9]
    with pytest.raises(UnreadableError, match="refers to node 9, but has 3"):
        vertices(tmp_path, gltf)
    with pytest.raises(UnreadableError, match="refers to skin 4, but has 1"):
        vertices(tmp_path, skinned([rows(0, 0, 0, 0)], [rows(1, 0, 0, 0)], skin=4))


def test_joints_without_weights_are_refused(tmp_path):
    gltf = skinned([rows(0, 0, 0, 0)], [rows(1, 0, 0, 0)])
    del gltf.document["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"]
    with pytest.raises(UnreadableError, match="JOINTS_0 without WEIGHTS_0"):
        vertices(tmp_path, gltf)
