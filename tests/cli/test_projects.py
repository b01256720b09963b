import importlib.util
import shutil

import pytest
from typer.testing import CliRunner

import shapewright as sw
from shapewright.building import Workers
from shapewright.cli.main import app
from shapewright.cli.projects import NEEDED, place_procedure, starter
from shapewright.demo import procedures
from shapewright.shapes import Drawing, Mesh


def made(folder, kind):
    result = CliRunner().invoke(app, ["new", str(folder), "--kind", kind])
    assert result.exit_code == 0, result.output
    return " ".join(result.output.split())


@pytest.mark.parametrize(("kind", "shape"), [("python", Mesh), ("drawing", Drawing)])
def test_a_new_procedure_builds_shapes_at_once(tmp_path, kind, shape):
    told = made(tmp_path / "chairs", kind)
    assert "shapewright fit procedure.py references" in told and "pip" not in told
    assert ("drawings" in told) == (kind == "drawing")
    first = sw.load_procedure(tmp_path / "chairs" / "procedure.py")
    with Workers(first, 2) as crew:
        builds = crew.build(first.space.sample(30, seed=0))
    assert all(isinstance(build.shape, shape) for build in builds), [str(b.failure) for b in builds if b.failure]


@pytest.mark.parametrize("kind", list(NEEDED))
def test_a_library_that_is_missing_is_named_with_its_command(tmp_path, kind, monkeypatch):
    monkeypatch.setattr("shapewright.cli.projects.find_spec", lambda name: None)
    assert f"pip install 'shapewright[{kind}]'" in made(tmp_path / "parts", kind)
    monkeypatch.setattr("shapewright.cli.projects.find_spec", lambda name: object())
    assert "pip" not in made(tmp_path / "others", kind)


@pytest.mark.parametrize("kind", [kind for kind in NEEDED if kind != "openscad"])
def test_running_it_without_the_library_names_the_command_too(tmp_path, kind):
    if importlib.util.find_spec(NEEDED[kind]):
        pytest.skip(f"{kind} is installed here")
    with pytest.raises(sw.ProcedureError, match=rf"{kind}.py:\d+: .*; pip install 'shapewright\[{kind}\]'"):
        sw.load_procedure(shutil.copyfile(starter(kind), tmp_path / f"my_{kind}.py"))


def test_a_page_of_openscad_has_its_own_name_in_every_command(tmp_path):
    told = made(tmp_path / "trays", "openscad")
    assert "trays/procedure.scad and" in told and "fit procedure.scad references" in told
    assert "--procedure procedure.scad" in told and (tmp_path / "trays" / "procedure.scad").is_file()


def test_the_demos_procedure_fits_its_references_and_an_authors_own_stays(tmp_path):
    place = tmp_path / "procedure.py"
    for drawn in (False, True, False):
        assert place_procedure(place, procedures.path("v5", drawn))
        assert place.read_bytes() == procedures.path("v5", drawn).read_bytes()
    place.write_text(place.read_text() + "# mine\n")
    mine = place.read_bytes()
    assert not place_procedure(place, procedures.path("v5", True)) and place.read_bytes() == mine
