"""Lists of sources."""

import pytest

import shapewright as sw
from shapewright.modelling.solids import box
from shapewright.references.errors import CollectionError
from shapewright.references.origins.lists import lasting, listed
from shapewright.references.sources import find
from shapewright.shapes.files import obj


def test_a_list_gives_its_sources_relative_to_its_folder(tmp_path, monkeypatch):
    (tmp_path / "shapes").mkdir()
    for i in range(3):
        (tmp_path / "shapes" / f"box{i}.obj").write_bytes(obj(box((1, 1 + i, 1)).mesh()))
    (tmp_path / "some.txt").write_text("shapes/box0.obj\n\n  shapes/box2.obj  \n")
    monkeypatch.chdir(tmp_path)
    references = sw.Collection.load("@some.txt")
    assert references.names == ("box0", "box2")
    monkeypatch.chdir("/")
    assert references.origins == (f"@{tmp_path}/some.txt",)
    assert sw.Collection.load(references.origins).names == references.names
    both = sw.Collection.load([f"@{tmp_path}/some.txt", str(tmp_path / "shapes" / "box1.obj")])
    assert both.names == ("box0", "box1", "box2")


def test_ten_thousands_of_paths_are_listed(tmp_path):
    names = [f"part {i % 100}/shape{i}.obj" for i in range(20_000)]
    (tmp_path / "many.txt").write_text("\n".join(names))
    found = find([f"@{tmp_path}/many.txt"])
    assert len(found) == 20_000 and found[2].path == tmp_path / names[2]


@pytest.mark.parametrize(("text", "why"), [(None, "the list of sources cannot be read"), ("\n\n", "lists nothing")])
def test_a_list_that_gives_nothing_is_told(tmp_path, text, why):
    if text is not None:
        (tmp_path / "list.txt").write_text(text)
    with pytest.raises(CollectionError, match=why):
        find([f"@{tmp_path}/list.txt"])


def test_a_file_whose_name_begins_with_the_mark_is_no_list(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "@box.obj").write_bytes(obj(box((1, 2, 1)).mesh()))
    assert listed(["@box.obj"]) == ["@box.obj"]
    assert sw.Collection.load("@box.obj").names == ("@box",)


def test_addresses_stay_as_they_are(tmp_path):
    (tmp_path / "list.txt").write_text("s3://bucket/chairs\nhttps://host/a.glb\n")
    assert listed([f"@{tmp_path}/list.txt"]) == ["s3://bucket/chairs", "https://host/a.glb"]
    assert lasting("s3://bucket/chairs") == "s3://bucket/chairs"
