"""Files that a procedure imports from its own folder."""

import sys
from types import SimpleNamespace

import pytest

import shapewright as sw
from shapewright.building import Workers
from shapewright.runs.folder import RunError
from shapewright.runs.helpers import copy_in, helpers_of, read_helpers, text_in, write_source
from shapewright.runs.inputs import procedure_of

MODEL = """from typing import Annotated
from shapewright import Range, procedure
from shared import HEIGHT
from parts.leg import leg

@procedure
def part(w: Annotated[float, Range(1, 2)] = 1.5):
    return leg(w, HEIGHT)
"""
ALONE = """from typing import Annotated
from shapewright import Range, procedure

@procedure
def part(w: Annotated[float, Range(1, 2)] = 1.5):
    return [[0, 0, 0], [w, 0, 0], [0, w, 0]], [[0, 1, 2]]
"""
READING = """import csv, pathlib
from typing import Annotated
from shapewright import Range, procedure

@procedure
def part(w: Annotated[float, Range(1, 2)] = 1.5):
    with open(FILE) as file:
        height = float(next(csv.reader(file))[0])
    return [[0, 0, 0], [w, 0, 0], [0, height, 0]], [[0, 1, 2]]
"""
SPEC = """run = "python make.py {params.json} {out.obj}"
[parameters]
w = { default = 1.5, range = [1, 2] }
"""
SCRIPT = """import json, pathlib, sys
w = json.loads(pathlib.Path(sys.argv[1]).read_text())["w"]
height = pathlib.Path(__file__).with_name("profile.csv").read_text().strip()
pathlib.Path(sys.argv[2]).write_text(f"v 0 0 0\\nv {w} 0 0\\nv 0 {height} 0\\nf 1 2 3\\n")
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
    path = folder / "model.py"
    kept = helpers_of(sw.load_procedure(path)).contents
    beside = {"shared.py": b"HEIGHT = 2.0\n", "parts/leg.py": LEG.encode(), "model.py": MODEL.encode()}
    assert kept == {f"procedure/{name}": content for name, content in beside.items()}
    run = tmp_path / "run"
    run.mkdir()
    write_source(run, str(path), MODEL, kept)
    assert read_helpers(run) == kept and text_in(run) == run / "procedure.py"
    assert sw.load_procedure(copy_in(run, str(path)))().vertices.max() == 2.0
    assert read_helpers(run) == kept, "what Python compiles is none of the author's"


def test_of_a_procedure_without_helpers_there_is_the_text_alone(tmp_path):
    (tmp_path / "model.py").write_text(ALONE)
    assert helpers_of(sw.load_procedure(tmp_path / "model.py")).contents == {}
    run = tmp_path / "run"
    run.mkdir()
    write_source(run, str(tmp_path / "model.py"), ALONE, {})
    assert list(run.iterdir()) == [run / "procedure.py"] == [copy_in(run, "model.py")] and read_helpers(run) == {}


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


def fitted(path, run):
    """A run of the procedure, loaded again."""
    loaded = sw.load_procedure(path)
    with Workers(loaded, 1) as crew:
        references = sw.Collection.of({"a": crew.build([loaded.space.defaults])[0].shape})
    settings = sw.Settings(samples=20, epochs=1, workers=1, refine="off", facing="given", rounds=0)
    sw.fit(loaded, references, settings).save(run)
    return sw.Iteration.load(run)


def saved(path, run):
    """What a run has of its procedure, without a fit."""
    loaded = sw.load_procedure(path)
    with Workers(loaded, 1) as crew:
        crew.build([loaded.space.defaults])
        kept = helpers_of(loaded, crew.opened)
    run.mkdir()
    write_source(run, str(path), loaded.source, kept.contents)
    procedure = {"name": loaded.name, "path": str(path), "digest": loaded.digest}
    return SimpleNamespace(procedure=procedure, helpers=read_helpers(run))


def height(procedure):
    with Workers(procedure, 1) as crew:
        (build,) = crew.build([procedure.space.defaults])
    return build.shape and build.shape.extent[1]


@pytest.mark.parametrize(
    "file",
    [
        "pathlib.Path(__file__).with_name('profile.csv')",
        "pathlib.Path(__file__).parent / f'pro{len([1])}.csv'.replace('1', 'file')",
        "pathlib.Path(__file__).with_suffix('.csv')",
    ],
)
def test_a_file_that_the_procedure_reads_beside_itself_is_as_it_was(file, tmp_path):
    path = tmp_path / "profile.py"
    path.write_text(READING.replace("FILE", file))
    (tmp_path / "profile.csv").write_text("3\n")
    iteration = saved(path, tmp_path / "run")
    assert procedure_of(tmp_path / "run", iteration).path == path
    (tmp_path / "profile.csv").write_text("5\n")
    assert height(sw.load_procedure(path)) == 5
    assert height(procedure_of(tmp_path / "run", iteration)) == 3
    (tmp_path / "profile.csv").unlink()
    path.unlink()
    assert height(procedure_of(tmp_path / "run", iteration)) == 3


@pytest.mark.parametrize("there", ["changed", "deleted", "elsewhere"])
def test_a_file_that_it_reads_from_the_working_folder_is_as_it_was(there, tmp_path, monkeypatch):
    (tmp_path / "code").mkdir()
    path = tmp_path / "code" / "model.py"
    opening = "FOUND = open('data/' + 'profile.csv').read()\n"
    path.write_text(opening + READING.replace("FILE", "'data/' + 'profile.csv'"))
    table = tmp_path / "data" / "profile.csv"
    table.parent.mkdir()
    table.write_text("3\n")
    monkeypatch.chdir(tmp_path)
    iteration = saved(path, tmp_path / "run")
    assert procedure_of(tmp_path / "run", iteration).path == path
    if there == "changed":
        table.write_text("5\n")
    elif there == "deleted":
        table.unlink()
    else:
        monkeypatch.chdir(tmp_path / "code")
    assert height(procedure_of(tmp_path / "run", iteration)) == 3


def test_an_edited_helper_is_not_taken_for_the_one_of_the_run(folder, tmp_path):
    iteration = saved(folder / "model.py", tmp_path / "run")
    (folder / "shared.py").write_text("HEIGHT = 4.0\n")
    assert procedure_of(tmp_path / "run", iteration)().vertices.max() == 2.0


@pytest.mark.parametrize("place", ["", "the folder"])
def test_nor_is_one_of_the_working_folder(folder, tmp_path, monkeypatch, place):
    iteration = saved(folder / "model.py", tmp_path / "run")
    (folder / "shared.py").write_text("HEIGHT = 4.0\n")
    monkeypatch.chdir(folder)
    before = [place and str(folder), *sys.path]
    monkeypatch.setattr(sys, "path", list(before))
    copy = procedure_of(tmp_path / "run", iteration)
    assert copy().vertices.max() == height(copy) == 2.0
    assert sys.path[: len(before)] == before


def test_a_file_that_is_too_large_is_told_and_asked_for_only_after_an_edit(tmp_path, monkeypatch):
    monkeypatch.setattr("shapewright.runs.helpers.MOST_BYTES", 3)
    path = tmp_path / "model.py"
    path.write_text(READING.replace("FILE", "pathlib.Path(__file__).with_name('pro' + 'file.csv')"))
    (tmp_path / "profile.csv").write_text("3,4\n")
    iteration = fitted(path, tmp_path / "run")
    (notice,) = [each for each in iteration.metrics["notices"] if each["kind"] == "not kept"]
    assert str(tmp_path / "profile.csv") in notice["text"]
    assert procedure_of(tmp_path / "run", iteration).path == path
    path.write_text(path.read_text() + "# an edit\n")
    with pytest.raises(RunError, match=r"no copy of .*profile.csv"):
        procedure_of(tmp_path / "run", iteration)


@pytest.mark.parametrize("name", ["iteration.json", "parameters.csv", "thumbnails/a.png"])
def test_a_file_of_a_name_that_runs_use_overwrites_nothing(name, tmp_path):
    path = tmp_path / "model.py"
    path.write_text(READING.replace("FILE", f"pathlib.Path(__file__).parent / {name!r}"))
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text("3\n")
    iteration = saved(path, tmp_path / "run")
    (tmp_path / name).unlink()
    assert height(procedure_of(tmp_path / "run", iteration)) == 3


def test_a_spec_keeps_its_script_and_what_that_names(tmp_path):
    (tmp_path / "spec.toml").write_text(SPEC)
    (tmp_path / "make.py").write_text(SCRIPT)
    (tmp_path / "profile.csv").write_text("3\n")
    iteration = saved(tmp_path / "spec.toml", tmp_path / "run")
    for name, text in (("make.py", "raise SystemExit(1)"), ("spec.toml", SPEC + "#"), ("profile.csv", "5")):
        (tmp_path / name).write_text(text)
    assert height(procedure_of(tmp_path / "run", iteration)) == 3


def test_the_copy_of_a_procedure_that_is_no_python_is_the_same_kind_of_file(tmp_path):
    write_source(tmp_path, "/somewhere/Model.SCAD", "width = 3;", {"procedure/lib/feet.scad": b"cube(1);"})
    assert copy_in(tmp_path) == text_in(tmp_path) == tmp_path / "procedure.scad"
    assert (tmp_path / "procedure.scad").read_text() == "width = 3;"
    assert read_helpers(tmp_path) == {"procedure/lib/feet.scad": b"cube(1);"}


def test_of_a_binary_procedure_a_run_keeps_the_file_and_a_line_that_says_which_it_is(folder, tmp_path):
    binary = folder / "model.blend"
    binary.write_bytes(b"BLENDER\xff\0")
    loaded = sw.load_procedure(folder / "model.py")
    loaded.path, loaded.helpers = binary, ()
    run = tmp_path / "run"
    run.mkdir()
    write_source(run, str(binary), loaded.source, helpers_of(loaded).contents)
    assert (
        copy_in(run, str(binary)).name == "model.blend" and copy_in(run, str(binary)).read_bytes() == b"BLENDER\xff\0"
    )
    assert text_in(run) == run / "procedure.txt"
    assert text_in(run).read_text() == loaded.source and "9 bytes, SHA-256 " in loaded.source
