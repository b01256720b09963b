"""Collections of pictures of objects."""

import pytest

import shapewright as sw
from stools import cut_out, encoded, photograph, stool, views


@pytest.fixture()
def folder(tmp_path):
    (tmp_path / "a.png").write_bytes(encoded(cut_out(stool())))
    (tmp_path / "b_1.jpg").write_bytes(encoded(photograph(stool())[0], "JPEG"))
    (tmp_path / "b_2.jpg").write_bytes(encoded(photograph(stool(), (-30.0, 10.0, 0.4))[0], "JPEG"))
    (tmp_path / "b_2.mask.png").write_bytes(encoded(cut_out(stool(), (-30.0, 10.0, 0.4)).getchannel("A")))
    return tmp_path


def test_each_picture_is_an_object_and_a_mask_is_none(folder):
    references = sw.Collection.load(folder, pictures="views")
    assert references.names == ("a", "b_1", "b_2") and references.in_views and references.pictures == "views"
    assert references["b_2"].notes == ("the object is what its mask shows",)
    assert (
        all(len(reference.shape) == 1 for reference in references) and repr(references["a"]) == "Reference('a', 1 view)"
    )


def test_the_column_object_of_a_manifest_joins_pictures(folder):
    manifest = folder / "list.csv"
    manifest.write_text("path,object\na.png,\nb_1.jpg,b\nb_2.jpg,b\nb_2.mask.png,\n")
    references = sw.Collection.load(manifest, pictures="views")
    assert [(reference.name, len(reference.shape)) for reference in references] == [("a", 1), ("b", 2)]
    assert len(references["b"].notes) == 2


def test_drawings_become_views(folder):
    drawings = sw.Collection.load(folder / "a.png")
    assert not drawings.in_views and drawings.as_views()["a"].shape.views[0].picture is not None
    in_memory = sw.Collection.of({"a": drawings["a"].shape}).as_views()
    assert in_memory.in_views and len(in_memory) == 1


def test_views_do_not_mix_with_other_shapes():
    with pytest.raises(sw.CollectionError, match="1 objects in views"):
        sw.Collection.of({"a": views(stool()), "b": stool()})


def test_views_in_memory_stay_as_they_are_and_do_not_turn():
    shape = views(stool())
    references = sw.Collection.of({"a": shape})
    assert references["a"].shape is shape and references.turned([1])["a"].shape is shape
