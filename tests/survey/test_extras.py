from pathlib import Path

import pytest

import scenes
from shapewright.references import Collection
from shapewright.references.orientation import AXES, Orientation
from shapewright.survey.extras import found
from shapewright.survey.pieces import Pieces

DATA = Path(__file__).resolve().parents[3] / "shared" / "data" / "references"


def extras(path, parts) -> list[tuple[str, bool, int]]:
    """Kind, whether it is sure, and how many triangles, of what is found in a file of these parts."""
    (reference,) = Collection.load(scenes.write(path, parts))
    pieces = Pieces.of(reference.shape)
    return [(extra.kind, extra.sure, len(pieces.faces(extra.pieces))) for extra in found(pieces)]


@pytest.mark.parametrize("name", ["a.glb", "a.ply", "a.stl"])
@pytest.mark.parametrize("width", [1.6, 3, 20])
def test_a_sheet_below_a_chair_is_a_ground_without_doubt_whatever_it_is_called(tmp_path, name, width):
    parts = {**scenes.chair(), "Plane.001": scenes.sheet(width, width)}
    assert extras(tmp_path / name, parts) == [("ground", True, 2)]


def test_tiles_are_one_ground(tmp_path):
    tiles = {f"t{i}{j}": scenes.sheet(1, 1, (i - 1, 0, j - 1)) for i in range(3) for j in range(3)}
    assert extras(tmp_path / "a.ply", {**scenes.chair(), **tiles}) == [("ground", True, 18)]


def test_a_chair_alone_has_no_extras(tmp_path):
    assert extras(tmp_path / "a.glb", scenes.chair()) == []


def test_a_narrow_foot_is_no_ground(tmp_path):
    lamp = {"foot": scenes.sheet(0.4, 0.4), "pole": scenes.box((0.03, 1.2, 0.03), (0, 0.6, 0))}
    assert extras(tmp_path / "a.ply", lamp) == []


def test_a_sheet_that_is_called_ground_may_be_small(tmp_path):
    parts = {**scenes.chair(), "Ground": scenes.sheet(0.6, 0.6)}
    assert extras(tmp_path / "a.glb", parts) == [("ground", True, 2)]
    assert extras(tmp_path / "a.ply", parts) == []


def test_a_thick_slab_may_be_a_ground(tmp_path):
    parts = {**scenes.chair(), "slab": scenes.box((3, 0.06, 3), (0, -0.03, 0))}
    assert extras(tmp_path / "a.ply", parts) == [("ground", False, 12)]


def test_a_sheet_behind_may_be_a_backdrop_and_is_one_by_its_name(tmp_path):
    wall = scenes.box((3, 3, 0.01), (0, 1, -0.6))
    assert extras(tmp_path / "a.ply", {**scenes.chair(), "Wall": wall}) == [("backdrop", False, 12)]
    assert extras(tmp_path / "b.glb", {**scenes.chair(), "Backdrop": wall}) == [("backdrop", True, 12)]


def test_a_frustum_looks_at_the_shape_from_afar(tmp_path):
    parts = {**scenes.chair(), "ground": scenes.sheet(4, 4), "x": scenes.frustum()}
    assert extras(tmp_path / "a.ply", parts) == [("frustum", True, 6), ("ground", True, 2)]


def test_a_pyramid_that_stands_on_a_house_or_looks_elsewhere_is_none(tmp_path):
    roof = scenes.frustum((0, 2, 0), (0.001, 0, 0), 0.5)
    assert extras(tmp_path / "a.ply", {"house": scenes.box((0.6, 1.5, 0.4), (0, 0.75, 0)), "roof": roof}) == []
    away = scenes.frustum((2, 1, 2), (4, 1, 4))
    assert extras(tmp_path / "b.ply", {**scenes.chair(), "x": away}) == []


def test_small_things_are_loose_by_their_names_only(tmp_path):
    parts = {**scenes.chair(), "Books_02": scenes.box((0.1, 0.05, 0.2), (0.1, 0.52, 0))}
    assert extras(tmp_path / "a.glb", parts) == [("loose", False, 12)]
    assert extras(tmp_path / "a.ply", parts) == []


@pytest.mark.skipif(not DATA.is_dir(), reason="needs the shared references")
@pytest.mark.parametrize("folder", ["furniture/lamp", "furniture/stool", "furniture/bench", "trees", "vessels"])
def test_real_shapes_keep_their_feet_and_tops_whichever_way_is_up(folder):
    for reference in Collection.load(DATA / folder):
        for up in AXES:
            turned = reference.shape.transformed(Orientation.of(up).matrix)
            assert not [extra for extra in found(Pieces.of(turned)) if extra.sure], (reference.name, up)
