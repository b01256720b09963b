import shutil

import numpy as np
import pytest
import trimesh

import scenes
from shapewright.modelling.solids import box
from shapewright.references import Collection, CollectionError
from shapewright.settings import Settings
from shapewright.survey.preparation import following, leading, prepared


@pytest.fixture
def folder(tmp_path):
    """A chair, a chair on a ground, two chairs in a file, a table and copies of it."""
    table = {"top": scenes.box((1, 0.05, 0.6), (0, 0.7, 0)), "post": scenes.box((0.1, 0.7, 0.1), (0, 0.35, 0))}
    scenes.write(tmp_path / "chair.glb", scenes.chair())
    scenes.write(tmp_path / "grounded.glb", {**scenes.chair(), "Plane": scenes.sheet(5, 5)})
    two = {**scenes.chair(), **{f"second {name}": part for name, part in scenes.chair(2.0).items()}}
    scenes.write(tmp_path / "pair.glb", {**two, "Ground": scenes.sheet(9, 9)})
    scenes.write(tmp_path / "table.stl", table)
    shutil.copy(tmp_path / "table.stl", tmp_path / "table copy.stl")
    large = trimesh.load(tmp_path / "table.stl", process=False)
    large.apply_scale(39.37)
    large.export(tmp_path / "table in inches.ply")
    return tmp_path


class TestDrop:
    def test_what_stands_around_a_shape_is_left_out_and_noted(self, folder):
        raw = Collection.load(folder)
        found = prepared(raw, Settings())["grounded"]
        chair = raw["chair"]
        assert found.notes == ("left out: a ground 'Plane'",)
        assert np.allclose(found.shape.bounds, chair.shape.bounds) and len(found.shape.faces) == 72
        assert np.allclose(found.size, chair.size)
        assert np.allclose(found.to_original(found.shape.bounds), chair.to_original(chair.shape.bounds))
        assert set(found.shape.labels) == set(scenes.chair())

    def test_it_stays_on_request(self, folder):
        raw = Collection.load(folder)
        found = prepared(raw, Settings(drop="nothing"))["grounded"]
        assert found is raw["grounded"]

    def test_a_reference_without_extras_is_the_same_one(self, folder):
        raw = Collection.load(folder)
        assert prepared(raw, Settings())["chair"] is raw["chair"]

    def test_what_is_in_doubt_is_left_out_when_it_is_named(self, tmp_path):
        scenes.write(tmp_path / "a.ply", {**scenes.chair(), "slab": scenes.box((3, 0.06, 3), (0, -0.03, 0))})
        raw = Collection.load(tmp_path)
        assert len(prepared(raw, Settings())["a"].shape.faces) == 84
        assert len(prepared(raw, Settings(drop="sure,ground"))["a"].shape.faces) == 72

    def test_prepared_twice_is_prepared_once(self, folder):
        how = Settings(split="apart", leave_out="table*")
        once = prepared(Collection.load(folder), how)
        twice = prepared(once, how)
        assert twice.names == once.names and twice.left_out == once.left_out
        assert all(a is b for a, b in zip(once, twice, strict=True))

    def test_an_unknown_word_is_an_error(self):
        with pytest.raises(ValueError, match="'floor' must be sure, ground"):
            Settings(drop="sure, floor")


class TestSplit:
    def test_two_chairs_in_a_file_are_two_references_without_their_ground(self, folder):
        raw = Collection.load(folder)
        found = prepared(raw, Settings(split="apart"))
        assert [name for name in found.names if name.startswith("pair")] == ["pair/1", "pair/2"]
        for name in ("pair/1", "pair/2"):
            assert np.allclose(found[name].shape.bounds, raw["chair"].shape.bounds)
            assert found[name].part_of == "pair" and found[name].path == raw["pair"].path
            assert found[name].notes == ("left out: a ground 'Ground'", "one of 2 objects in pair")

    def test_each_name_is_one_on_request(self, folder):
        found = prepared(Collection.load(folder / "chair.glb"), Settings(split="names"))
        assert set(found.names) == {f"chair/{name}" for name in scenes.chair()}

    def test_objects_stay_together_by_default(self, folder):
        assert "pair" in prepared(Collection.load(folder), Settings()).names


class TestLeaveOut:
    def test_names_and_patterns(self, folder):
        found = prepared(Collection.load(folder), Settings(leave_out="table*, pair"))
        assert found.names == ("chair", "grounded")
        assert found.left_out["table copy"] == "left out on request" and len(found.left_out) == 4

    def test_objects_of_a_file(self, folder):
        found = prepared(Collection.load(folder), Settings(split="apart", leave_out="pair/2"))
        assert "pair/1" in found and "pair/2" not in found and "pair/2" in found.left_out

    def test_a_name_that_is_none_is_an_error(self, folder):
        with pytest.raises(CollectionError, match="no reference 'chiar'; did you mean chair"):
            prepared(Collection.load(folder), Settings(leave_out="chiar"))

    def test_nothing_left_is_an_error(self, folder):
        with pytest.raises(CollectionError, match="leaves no reference"):
            prepared(Collection.load(folder), Settings(leave_out="*"))


class TestDuplicates:
    def test_copies_and_scaled_copies_follow_the_first_whatever_their_format(self, folder):
        found = prepared(Collection.load(folder), Settings())
        like = following(found, Settings())
        assert {(each.name, each.of, each.is_equal) for each in like} == {
            ("grounded", "chair", True),
            ("table copy", "table", True),
            ("table in inches", "table", True),
        }
        assert leading(found, like).names == ("chair", "pair", "table")

    def test_each_is_fitted_on_request(self, folder):
        assert following(prepared(Collection.load(folder), Settings()), Settings(duplicates="each")) == ()

    def test_near_ones_follow_on_request_only(self):
        shapes = {f"{i}": box((1, 0.5, 0.3)) | box((0.1, 1 + 0.001 * i, 0.1)) for i in range(3)}
        collection = Collection.of(shapes)
        assert following(collection, Settings()) == ()
        assert [each.of for each in following(collection, Settings(duplicates="near"))] == ["0", "0"]

    def test_a_turned_copy_does_not_follow(self):
        shape = box((1, 0.5, 0.3)) | box((0.2, 0.2, 0.2), at=(0.3, 0.3, 0))
        turned = shape.mesh().transformed(np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]]))
        assert following(Collection.of({"a": shape, "b": turned}), Settings(duplicates="near")) == ()
