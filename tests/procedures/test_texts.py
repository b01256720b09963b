"""Files that are no Python: which they are, and what their text is."""

import inspect
from pathlib import Path
from typing import Annotated

import pytest

import shapewright as sw
from shapewright.procedures import loading, source_digest, text_of
from shapewright.procedures.places import Place
from shapewright.procedures.procedure import Procedure
from shapewright.procedures.texts import FOREIGN


def test_there_is_a_reader_for_each_kind_of_file():
    assert set(loading._READERS) == FOREIGN


def test_the_text_of_a_binary_file_says_how_long_it_is_and_changes_with_it(tmp_path):
    (tmp_path / "a.blend").write_bytes(b"\xff\0")
    before = text_of(tmp_path / "a.blend")
    (tmp_path / "a.blend").write_bytes(b"\xff\1")
    assert before.startswith("2 bytes, SHA-256 ") and text_of(tmp_path / "a.blend") != before


class Plate:
    """What a reader makes of a file: something to call, with a signature."""

    def __init__(self, file, name):
        self.__name__, self.place = name, Place(str(file), None)
        width = Annotated[float, sw.Range(1, 3)]
        items = [inspect.Parameter("width", inspect.Parameter.KEYWORD_ONLY, default=2.0, annotation=width)]
        items += [inspect.Parameter("height", inspect.Parameter.KEYWORD_ONLY, default=1.0)]
        self.__signature__ = inspect.Signature(items)

    def __call__(self, width, height=1.0):
        return [[0, 0, 0], [width, 0, 0], [0, 0, height]], [[0, 1, 2]]


@pytest.fixture
def plates(monkeypatch):
    def read(path: Path, name):
        return Procedure(Plate(path, name or path.stem), facts=sw.procedures.Facts("z", "mm"))

    monkeypatch.setattr(loading, "_READERS", {".scad": read})


@pytest.mark.parametrize(("named", "name"), [("", "plate"), (":other", "other"), (":a:b", "a:b")])
def test_a_file_is_read_by_its_suffix_and_the_name_behind_it(plates, tmp_path, named, name):
    file = tmp_path / "plate.SCAD"
    file.write_text("width = 2;")
    plate = sw.load_procedure(f"{file}{named}")
    assert (plate.name, plate.path, plate.place.file) == (name, file, str(file))
    assert plate.space.names == ("width",) and plate.signature.fixed == ("height",)
    assert plate.digest == source_digest("width = 2;")
    assert plate(width=3.0).extent.tolist() == [3.0, 1.0, 0.0]


def test_a_file_beside_is_no_module(plates, tmp_path, monkeypatch):
    (tmp_path / "plate.scad").write_text("")
    monkeypatch.chdir(tmp_path)
    assert sw.load_procedure("plate.scad:plate").name == "plate"
    with pytest.raises(sw.ProcedureError, match=r"plates.scad: no such file"):
        sw.load_procedure("plates.scad:plate")
