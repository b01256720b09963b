import pytest
import trimesh

from shapewright.references import Collection, CollectionError
from shapewright.references.manifests.folder_tables import TABLE, with_cells
from shapewright.settings import Settings
from shapewright.survey.preparation import prepared


@pytest.fixture
def folder(tmp_path):
    for name in ("a.stl", "b.stl", "below/a.stl"):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        trimesh.creation.box((1, 2, 3)).export(path)
    return tmp_path


def axes(collection):
    return {each.name: (each.orientation.up, each.axes_by) for each in collection}


@pytest.mark.parametrize("origin", ["", "*.stl", "a.stl"])
def test_a_table_in_a_folder_tells_of_single_files_of_it_however_they_are_named(folder, origin):
    (folder / TABLE).write_text("path,up\na.stl,z\ngone.stl,x\n")
    found = axes(Collection.load(folder / origin if origin else folder))
    assert {name: found.pop(name) for name in list(found) if name in ("a", "a.stl")}.popitem()[1] == ("z", "author")
    assert set(found.values()) <= {("y", "default")}, "other files, those of folders below too, are as ever"


def test_what_a_table_says_holds_against_the_arguments_and_where_up_is_found(folder):
    (folder / TABLE).write_text("path,up,split\nb.stl,-x,apart\n")
    assert axes(Collection.load(folder, up="z"))["b"] == ("-x", "author")
    assert axes(Collection.load(folder, up="auto"))["b"] == ("-x", "author")
    assert Collection.load(folder)["b"].switches.split == "apart"


def test_objects_of_a_file_become_references_where_its_folders_table_says_so(folder):
    far = [trimesh.creation.box((1, 1, 1)), trimesh.creation.box((1, 2, 1)).apply_translation((9, 0, 0))]
    trimesh.util.concatenate(far).export(folder / "two.stl")
    (folder / TABLE).write_text("path,split\ntwo.stl,apart\n")
    names = prepared(Collection.load(folder), Settings()).names
    assert {"two/1", "two/2"} <= set(names) and "two" not in names


def test_a_wrong_word_is_told_with_its_line(folder):
    (folder / TABLE).write_text("path,split\na.stl,often\n")
    with pytest.raises(CollectionError, match=f"{TABLE}, line 2: split is 'often'"):
        Collection.load(folder)


def test_cells_are_written_beside_what_is_there_and_taken_away_again():
    first = with_cells("", "a.stl", {"up": "z", "split": ""})
    assert first == "path,up,split\na.stl,z,\n"
    second = with_cells(first, "b, c.stl", {"up": "", "split": "apart"})
    assert second == 'path,up,split\na.stl,z,\n"b, c.stl",,apart\n'
    assert with_cells(second, "a.stl", {"up": "", "split": ""}) == 'path,up,split\n"b, c.stl",,apart\n'
    assert with_cells(first, "a.stl", {"up": "", "split": ""}) == ""
    kept = with_cells("\ufeffPath;unit\na.stl;mm\n", "a.stl", {"up": "z"})
    assert kept == "path;unit;up\na.stl;mm;z\n"
