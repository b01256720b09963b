"""OpenSCAD files as procedures, built by the package openscad-evaluator."""

import csv
import pickle
import shutil
from pathlib import Path

import numpy as np
import pytest

import shapewright as sw
from shapewright.building.pool import Workers
from shapewright.fitting.samples import write_samples
from shapewright.procedures.openscad import reading
from shapewright.processes import Limits
from shapewright.runs.helpers import copy_in, helpers_of, read_helpers, write_source
from shapewright.studio.bench.workshop import Broken, Workshop

pytest.importorskip("openscad_evaluator", reason="needs the extra openscad; run `make test-adapters`")

CASE = Path(__file__).resolve().parents[3] / "shared" / "cases" / "generators" / "03-openscad-file" / "box_lid.scad"
EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "generators"
BOX = """
use <lib/feet.scad>
include <sizes.scad>
/* [Size] */
// outer width
width = 80; // [40:160]
wall = 2; // [1:0.5:4]
kind = "flat"; // [none, flat, round]
feet = true;
size = [20, 30]; // [10:50]
module lid() { translate([0, 0, TALL]) if (kind == "round") cylinder(d = 40, h = 4); else cube([width, 20, 2]); }
module body() difference() {
  cube([width, size[1], TALL]);
  translate([wall, wall, wall]) cube([width - 2*wall, size[1] - 2*wall, TALL]);
}
color("red") body();
if (kind != "none") lid();
if (feet) feet(width, size[0]);
"""


def written(folder, text, name="box.scad", **beside):
    (folder / "lib").mkdir(exist_ok=True)
    (folder / "lib" / "feet.scad").write_text("module feet(w, d) { translate([w/4, d/4, -5]) cube([w/2, d/2, 5]); }")
    (folder / "sizes.scad").write_text("TALL = 30;\n")
    (folder / name).write_text(text)
    return folder / name


@pytest.fixture
def box(tmp_path):
    return sw.load_procedure(written(tmp_path, BOX))


def test_parameters_make_the_shape_that_the_file_says(box):
    assert box.space.names == ("width", "wall", "kind", "feet", "size.x", "size.y")
    assert box.name == "box" and box.facts == sw.procedures.Facts("z", "mm")
    assert box.signature.meanings == {"width": "outer width"}
    assert box().extent == pytest.approx([80, 37, 30])  # y is up: 5 of feet, 30, 2 of the lid
    assert box(width=120, feet=False, kind="none").extent == pytest.approx([120, 30, 30])
    assert box(**{"size.y": 50}).extent == pytest.approx([80, 37, 50])
    assert box(size=(20, 45)).extent == pytest.approx([80, 37, 45])
    assert box().extent == pytest.approx([80, 37, 30])  # nothing of the calls before is left


def test_modules_are_labels_and_colours_are_kept(box):
    mesh = box()
    assert mesh.soundness().closed and set(mesh.label_names) == {"body", "lid", "feet"}
    red = mesh.face_colours[:, 0] == 255
    assert set(mesh.face_labels[red]) == {mesh.label_names.index("body")}
    assert not mesh.face_colours[~red].any()


def test_one_module_that_makes_all_gives_its_modules_as_labels(tmp_path):
    text = "w = 5; // [1:9]\nmodule all() { leg(); translate([0, 20, 0]) top(); }\nall();"
    text += "module leg() { cube(w); }\nmodule top() { cube(w); }"
    assert sw.load_procedure(written(tmp_path, text))().label_names == ("leg", "top")


def test_workers_build_the_same_as_this_process(box):
    space = box.space.sample(6, seed=3)
    with Workers(box, 2) as crew:
        builds = crew.build(space)
    for parameters, build in zip(space, builds, strict=True):
        assert build.failure is None, build.failure
        assert np.array_equal(build.shape.vertices, box(**parameters).vertices)


def test_what_is_called_can_be_pickled(box):
    again = pickle.loads(pickle.dumps(box.function))
    assert again == box.function and again.__name__ == "box"


def test_a_run_keeps_what_the_file_uses(box, tmp_path):
    run = tmp_path / "run"
    run.mkdir()
    write_source(run, str(box.path), box.source, helpers_of(box).contents)
    assert set(read_helpers(run)) == {f"procedure/{name}" for name in ("lib/feet.scad", "sizes.scad", box.path.name)}
    (box.path.parent / "sizes.scad").unlink()
    copy = sw.load_procedure(f"{copy_in(run, str(box.path))}:box")
    assert copy.name == "box" and copy().extent == pytest.approx(box().extent)


def test_an_edit_of_a_file_that_is_used_counts_when_it_is_loaded_again(tmp_path):
    file = written(tmp_path, BOX)
    before = sw.load_procedure(file)().extent[1]
    (tmp_path / "sizes.scad").write_text("TALL = 60;\n")
    assert sw.load_procedure(file)().extent[1] == pytest.approx(before + 30)


def test_a_file_beside_it_is_imported(tmp_path):
    import trimesh

    trimesh.creation.box((4, 5, 6)).export(tmp_path / "block.stl")
    part = sw.load_procedure(written(tmp_path, 's = 2; // [1:3]\nscale(s) import("block.stl");', "part.scad"))
    assert [file.name for file in part.helpers] == ["block.stl"]
    assert part(s=3).extent == pytest.approx([12, 18, 15])


def test_a_flat_file_is_a_drawing(tmp_path):
    plate = sw.load_procedure(written(tmp_path, "w = 4; // [1:9]\nsquare([w, 2]); translate([w, 0]) circle(1);"))
    drawing = plate(w=6)
    assert isinstance(drawing, sw.Drawing) and drawing.geometry.area == pytest.approx(12 + np.pi / 2, rel=0.1)


def test_modifiers_count_as_in_a_render(tmp_path):
    text = "w = 4; // [1:9]\ncube(w); % translate([50, 0, 0]) cube(1); # translate([w, 0, 0]) cube(w); * cube(100);"
    assert sw.load_procedure(written(tmp_path, text))().extent == pytest.approx([8, 4, 4])


def test_an_assertion_says_which_values_have_no_shape(tmp_path):
    text = 'w = 4; // [1:9]\nassert(w > 3, "the wall is too thin");\ncube(w);'
    with pytest.raises(sw.Infeasible, match=r"^the wall is too thin$"):
        sw.load_procedure(written(tmp_path, text))(w=2)


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("w = 4; // [1:9]\ncubee(w);", 2, "Ignoring unknown module 'cubee'"),
        ("w = 4; // [1:9]\ncylinder(h = undef, r = w);", None, "openscad-evaluator fails: float"),
        ("w = 4; // [1:9]\n\ncube(wide(w));", 3, "Ignoring unknown function 'wide'"),
        ('w = 4; // [1:9]\ncube(w);\nimport("gone.stl");', 3, "Can't open import file"),
        ("w = 4; // [1:9]\nmodule m() { }", None, "the shape is empty"),
        ("w = 4; // [1:9]\nfunction f(x) = f(x + 1);\ncube(f(w));", None, "without end|[Rr]ecursion"),
    ],
)
def test_what_is_not_there_names_its_line(tmp_path, text, line, message):
    made = sw.load_procedure(written(tmp_path, text))
    with pytest.raises(sw.ProcedureError, match=message) as raised:
        made()
    assert Path(raised.value.place.file) == made.path and (line is None or raised.value.place.line == line)


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("w = 4; // [1:9]\ncube(w;", 2, "the syntax is wrong here"),
        ("w = 4; // [1:9]\ninclude <gone.scad>\ncube(w);", 2, "gone.scad' not found"),
    ],
)
def test_what_cannot_be_read_is_told_when_it_is_loaded(tmp_path, text, line, message):
    with pytest.raises(sw.ProcedureError, match=message) as raised:
        sw.load_procedure(written(tmp_path, text))
    assert raised.value.place.line == line


def test_the_wrong_syntax_of_a_file_that_is_used_is_told_with_its_place(tmp_path):
    file = written(tmp_path, BOX)
    (tmp_path / "lib" / "feet.scad").write_text("module feet(w, d) {\n  cube(w;\n}")
    with pytest.raises(sw.ProcedureError, match=r"feet.scad:2: the syntax is wrong here"):
        sw.load_procedure(file)


def test_text_with_quotes_and_variables_with_strange_names_arrive_as_they_are(tmp_path):
    text = 'in = 3; // [1:9]\nsaid = "a"; // ["a", "b"]\nassert(said != "x\\"y\\\\");\ncube([in, 1, 1]);'
    made = sw.load_procedure(written(tmp_path, text))
    assert made(_in=7).extent[0] == pytest.approx(7)
    with pytest.raises(sw.Infeasible):
        made(said='x"y\\')


program = pytest.mark.skipif(shutil.which("openscad") is None, reason="needs the program openscad on the PATH")


@program
def test_the_program_builds_the_same_solid(box, monkeypatch):
    values = {"width": 120, "kind": "round", "size": (20, 45)}
    package = box(**values)
    monkeypatch.setattr(reading, "find_spec", lambda name: None)
    assert box(**values).extent == pytest.approx(package.extent, rel=1e-4)
    assert not box(**values).label_names


@program
def test_what_the_package_does_not_know_is_left_to_the_program(tmp_path):
    old = sw.load_procedure(written(tmp_path, "w = 4; // [1:9]\nassign(a = w) cube([a, 1, 1]);"))
    assert old(w=7).extent[0] == pytest.approx(7)


@program
@pytest.mark.parametrize(
    ("text", "error", "message"),
    [
        ("w = 4; // [1:9]\nsquare(w);", sw.ProcedureError, "it is 2D"),
        ("w = 4; // [1:9]\ncube(w;", sw.ProcedureError, r"Parser error.*|syntax error"),
        ('w = 4; // [1:9]\nassert(w > 9, "too thin");', sw.Infeasible, "too thin"),
        ("w = 4; // [1:9]", sw.ProcedureError, "openscad: .*empty"),
    ],
)
def test_what_the_program_says_is_told(tmp_path, monkeypatch, text, error, message):
    monkeypatch.setattr(reading, "find_spec", lambda name: None)
    with pytest.raises(error, match=message):
        sw.load_procedure(written(tmp_path, text))()


@pytest.mark.skipif(not CASE.is_file(), reason="needs ../shared")
def test_a_file_in_the_manner_of_printables_is_fitted_as_it_is(tmp_path):
    box_lid = sw.load_procedure(CASE)
    assert len(box_lid.space) == 8 and box_lid.signature.fixed == ("label_text",)
    write_samples(box_lid, 6, tmp_path / "parts", "stl", seed=1000)
    with (tmp_path / "parts" / "manifest.csv").open(encoding="utf-8") as table:
        truth = {Path(row["path"]).stem: row for row in csv.DictReader(table)}
    found = sw.fit(box_lid, sw.Collection.load(tmp_path / "parts"), sw.Settings(samples=400, epochs=12, workers=2))
    assert sum(result.parameters["lid_type"] == truth[result.name]["lid_type"] for result in found) >= 5
    assert sum(result.grade != "different" for result in found) >= 5


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.scad")), ids=lambda path: path.stem)
def test_an_example_builds_closed_shapes_of_the_size_that_it_says(path):
    example = sw.load_procedure(path)
    assert example.facts.stated == {"up": "z", "unit": "mm", "size": "given"}
    assert len(example.space) >= 7 and not example.signature.fixed
    made = [example(**example.space.defaults)]
    for parameters in example.space.sample(6, seed=2):
        try:
            made.append(example(**parameters))
        except sw.Infeasible:
            continue
    assert len(made) >= 5 and all(mesh.soundness().closed for mesh in made)
    assert all(30 < mesh.extent.max() < 400 for mesh in made)
    assert made[0].label_names


def test_the_studio_reads_it_and_tells_an_error_with_its_line(tmp_path):
    file = written(tmp_path, BOX)
    workshop = Workshop()
    version = workshop.load(file, Limits())
    assert version.name == "box" and [p.name for p in version.parameters][:3] == ["width", "wall", "kind"]
    assert workshop.build({"width": 120}).build.shape.extent[0] == pytest.approx(120)
    file.write_text("w = 4; // [1:9]\ncube(w;")
    with pytest.raises(Broken) as raised:
        workshop.load(file, Limits())
    assert (raised.value.problem.file, raised.value.problem.line) == ("box.scad", 2)
    workshop.close()
