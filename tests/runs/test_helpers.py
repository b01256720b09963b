"""Files that a procedure imports from its own folder."""

import pytest

import shapewright as sw
from shapewright.runs.helpers import helpers_of, read_helpers, write_helpers
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
    assert texts == {"shared.py": "HEIGHT = 2.0\n", "parts/leg.py": LEG}
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
