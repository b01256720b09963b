"""Files that a procedure imports from its own folder."""

import pytest

import shapewright as sw
from shapewright.runs.helpers import copy_in, helpers_of, read_helpers, text_in, write_helpers, write_source
from shapewright.runs.inputs import procedure_of

MODEL = """from typing import Annotated
from shapewright import Range, procedure
from shared import HEIGHT
from parts.leg import leg

@procedure
def part(w: Annotated[float, Range(1, 2)] = 1.5):
    return leg(w, HEIGHT)
"""
LEG = "def leg(w, h):\n    return [[0, 0, 0], [w, 0, 0], [0, h, 0]], [[0, 1, 2]]\n"


@pytest.fixture
def folder(tmp_path):
    home = tmp_path / "project"
    (home / "parts").mkdir(parents=True)
    (home / "model.py").write_text(MODEL)
    (home / "shared.py").write_text("HEIGHT = 2.0\n")
    (home / "parts" / "leg.py").write_text(LEG)
    return home


def test_a_run_keeps_them_where_its_copy_of_the_procedure_finds_them(folder, tmp_path):
    texts = helpers_of(sw.load_procedure(folder / "model.py"))
    assert texts == {"shared.py": b"HEIGHT = 2.0\n", "parts/leg.py": LEG.encode()}
    run = tmp_path / "run"
    run.mkdir()
    write_helpers(run, texts)
    (run / "procedure.py").write_text(MODEL)
    assert read_helpers(run) == texts
    assert sw.load_procedure(run / "procedure.py")().vertices.max() == 2.0


def test_a_procedure_without_helpers_has_no_list(tmp_path):
    write_helpers(tmp_path, {})
    assert not list(tmp_path.iterdir()) and read_helpers(tmp_path) == {}


def test_an_explanation_after_an_edit_runs_the_procedure_as_it_was(folder, tmp_path):
    references = sw.Collection.of({"a": sw.load_procedure(folder / "model.py")(w=1.25)})
    settings = sw.Settings(samples=40, epochs=1, workers=1, refine="off")
    iteration = sw.fit(sw.load_procedure(folder / "model.py"), references, settings)
    run = iteration.save(tmp_path / "run")
    (folder / "model.py").write_text(MODEL.replace("HEIGHT)", "3.0)"))
    (folder / "shared.py").unlink()
    loaded = sw.Iteration.load(run)
    assert loaded.helpers == iteration.helpers and procedure_of(run, loaded)().vertices.max() == 2.0
    again = loaded.save(tmp_path / "again")
    assert read_helpers(again) == iteration.helpers


def test_the_copy_of_a_procedure_that_is_no_python_is_the_same_kind_of_file(tmp_path):
    write_source(tmp_path, "/somewhere/Model.SCAD", "width = 3;", {"lib/feet.scad": b"cube(1);", "logo.stl": b"\xff\0"})
    assert copy_in(tmp_path) == text_in(tmp_path) == tmp_path / "procedure.scad"
    assert (tmp_path / "procedure.scad").read_text() == "width = 3;"
    assert read_helpers(tmp_path) == {"lib/feet.scad": b"cube(1);", "logo.stl": b"\xff\0"}


def test_of_a_binary_procedure_a_run_keeps_the_file_and_a_line_that_says_which_it_is(folder, tmp_path):
    binary = folder / "model.blend"
    binary.write_bytes(b"BLENDER\xff\0")
    loaded = sw.load_procedure(folder / "model.py")
    loaded.path, loaded.helpers = binary, ()
    run = tmp_path / "run"
    run.mkdir()
    write_source(run, str(binary), loaded.source, helpers_of(loaded))
    assert (run / "procedure.blend").read_bytes() == b"BLENDER\xff\0"
    assert text_in(run) == run / "procedure.txt"
    assert text_in(run).read_text() == loaded.source and "9 bytes, SHA-256 " in loaded.source
