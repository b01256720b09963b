import numpy as np
import pytest

import scenes
import shapewright as sw
from shapewright.references import Collection, CollectionError
from shapewright.survey.preparation import prepared


@pytest.fixture
def folder(tmp_path):
    two = {**scenes.chair(), **{f"{name} 2": part for name, part in scenes.chair(x=3.0).items()}}
    for name in ("a", "b"):
        scenes.write(tmp_path / f"{name}.glb", {**two, "Plane": scenes.sheet(9, 5)})
    scenes.write(tmp_path / "c.ply", scenes.chair())
    return tmp_path


def listed(folder, text):
    (folder / "list.csv").write_text(text)
    return Collection.load(folder / "list.csv")


def test_a_file_is_left_out_split_and_kept_whole_by_its_line(folder):
    refs = listed(folder, "path,leave_out,split,drop\na.glb,,apart,\nb.glb,no,,nothing\nc.ply,yes,,\n")
    assert refs.names == ("a", "b") and refs.left_out == {"c": "left out by the manifest"}
    found = prepared(refs, sw.Settings())
    assert found.names == ("a/1", "a/2", "b") and found.left_out == refs.left_out
    assert len(found["b"].shape.faces) == len(refs["b"].shape.faces)
    assert len(prepared(refs, sw.Settings(split="apart", drop="sure")).names) == 3


def test_a_unit_is_the_manifests_word_whatever_the_file_states(folder):
    refs = listed(folder, "path;unit\na.glb;cm\nb.glb;\nc.ply;in\n")
    assert [refs[name].unit for name in "abc"] == [0.01, 1.0, 0.0254]
    np.testing.assert_allclose(refs["c"].size, np.array([0.5, 1.0, 0.5]) * 0.0254, atol=1e-3)


def test_points_keep_what_their_line_says(folder):
    (folder / "p.xyz").write_text("\n".join(f"{x} {y} {z}" for x, y, z in np.random.default_rng(0).random((300, 3))))
    (folder / "list.csv").write_text("path,name,keep\np.xyz,some,\np.xyz,all,strays+density floor\n")
    from shapewright.references.sources import find

    assert {one.name: one.keep for one in find([folder / "list.csv"])} == {
        "some": (),
        "all": ("floor", "strays", "density"),
    }


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("leave_out\na.glb,maybe", "line 2: leave_out is 'maybe'; use one of yes"),
        ("split\na.glb,far", "line 2: split is 'far'; use one of off, apart, names"),
        ("drop\na.glb,sure grounds", "line 2: drop is 'grounds'; use one of sure, ground"),
        ("unit\na.glb,mile", "line 2: unit is 'mile'; use one of mm, cm, m, in, ft"),
        ("keep\na.glb,dust", "line 2: keep='dust' is nothing that is taken"),
        ("leave_out\na.glb,yes", "leaves out all its files"),
    ],
)
def test_what_cannot_be_understood_is_told_with_its_line(folder, line, why):
    with pytest.raises(CollectionError, match=why):
        listed(folder, f"path,{line}\n")
