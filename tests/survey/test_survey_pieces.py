import numpy as np

import scenes
from shapewright.references import Collection
from shapewright.survey.objects import objects
from shapewright.survey.pieces import Pieces


def pieces(path, parts) -> Pieces:
    return Pieces.of(Collection.load(scenes.write(path, parts)).references[0].shape)


def test_faces_that_share_places_are_one_piece_in_a_soup_too(tmp_path):
    found = pieces(tmp_path / "a.stl", scenes.chair())
    assert len(found) == found.components == 6
    assert found.counts.tolist() == [12] * 6


def test_a_label_parts_what_hangs_together(tmp_path):
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng a\nf 1 2 3\ng b\nf 1 3 4\n")
    found = Pieces.of(Collection.load(tmp_path).references[0].shape)
    assert (len(found), found.components) == (2, 1)
    assert [found.names([i]) for i in range(2)] == [("a",), ("b",)]


def test_each_piece_knows_its_faces_and_its_bounds(tmp_path):
    found = pieces(tmp_path / "a.ply", scenes.chair())
    for i in range(len(found)):
        corners = found.mesh.triangles[found.faces([i])].reshape(-1, 3)
        assert np.array_equal(found.bounds([i]), [corners.min(axis=0), corners.max(axis=0)])


def test_objects_are_apart_and_a_mesh_that_hangs_loosely_together_is_one(tmp_path):
    found = pieces(tmp_path / "a.ply", scenes.chair() | {f"other {n}": p for n, p in scenes.chair(2.0).items()})
    two = objects(found, np.arange(len(found)))
    assert [len(one.pieces) for one in two] == [6, 6]
    gap = {**scenes.chair(), "cushion": scenes.box((0.4, 0.05, 0.4), (0, 0.55, 0))}
    found = pieces(tmp_path / "b.ply", gap)
    assert len(objects(found, np.arange(len(found)))) == 1


def test_what_is_small_goes_with_the_nearest_object(tmp_path):
    other = {f"other {n}": p for n, p in scenes.chair(2.0).items()}
    found = pieces(tmp_path / "a.ply", {**scenes.chair(), **other, "ball": scenes.box((0.1, 0.1, 0.1), (1.3, 0.05, 0))})
    assert [len(one.pieces) for one in objects(found, np.arange(len(found)))] == [6, 7]


def test_each_name_can_be_an_object(tmp_path):
    found = pieces(tmp_path / "a.glb", scenes.chair())
    assert {one.name for one in objects(found, np.arange(len(found)), "names")} == set(scenes.chair())


def test_a_mesh_is_closed_by_its_places_and_open_without_a_face(tmp_path):
    assert pieces(tmp_path / "a.stl", scenes.chair()).closed
    assert not pieces(tmp_path / "b.ply", {"sheet": scenes.sheet(1, 2)}).closed
