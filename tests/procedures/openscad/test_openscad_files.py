"""OpenSCAD files as far as no evaluator is needed: what they use, what is wrong with them, what is missing."""

from importlib.util import find_spec

import pytest

import shapewright as sw
from shapewright.procedures.openscad import reading
from shapewright.procedures.openscad.messages import failure, located
from shapewright.procedures.openscad.text import Text


def test_the_files_that_it_names_are_found_and_those_in_comments_are_not():
    text = (
        'include <lib/a.scad>\nuse <b.scad>\n// use <c.scad>\n/* import("d.stl"); */\n'
        'echo("use <e.scad>");\nimport("f.stl", convexity = 3);\nimport(file = "g.svg");\nsurface(file="h.png");\n'
        "include <lib/a.scad>"
    )
    assert Text.of(text).files == ("lib/a.scad", "b.scad", "f.stl", "g.svg", "h.png")


def test_code_and_comments_stay_where_they_are():
    text = 'a = "// no"; // yes\n/* b\n*/ c = 1;'
    parts = Text.of(text)
    assert parts.code == 'a = "// no";       \n    \n   c = 1;' and len(parts.bare) == len(text)
    assert [comment.text for comment in parts.comments] == [" yes", " b\n"]
    assert parts.line(text.index("c")) == 3


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("a = 1;\nb = 7; // [9:3]", 2, "the lower end first"),
        ("\na = 1;\nb = 7;", 2, r"nothing in this file .* \(held are a, b\); write one: a = 1; // \[low:high\]"),
        ('a = "x";\nb = 7;', 1, r"\(held are a, b\); write one: b = 7; // \[low:high\]"),
        ("cube(1);", None, r"write one: width = 80; // \[40:160\]"),
    ],
)
def test_a_file_without_a_space_says_so_with_its_line(tmp_path, text, line, message):
    file = tmp_path / "plate.scad"
    file.write_text(text)
    with pytest.raises(sw.ProcedureError, match=message) as raised:
        sw.load_procedure(file)
    assert (raised.value.place.file, raised.value.place.line) == (str(file), line)


def test_a_missing_extra_names_the_command(tmp_path, monkeypatch):
    monkeypatch.setattr(reading, "find_spec", lambda name: None if "openscad" in name else find_spec(name))
    monkeypatch.setenv("PATH", "")
    file = tmp_path / "plate.scad"
    file.write_text("a = 1; // [0:3]\ncube(a);")
    with pytest.raises(sw.ProcedureError, match=r"pip install 'shapewright\[openscad\]'"):
        sw.load_procedure(file)


def test_a_file_that_is_no_text_is_refused(tmp_path):
    (tmp_path / "plate.scad").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(sw.ProcedureError, match=r"plate.scad: cannot be read as UTF-8"):
        sw.load_procedure(tmp_path / "plate.scad")


def test_what_evaluators_say_names_the_line(tmp_path):
    file = tmp_path / "plate.scad"
    file.write_text("a = 1;\ncubee(a);\n")
    said = f"Ignoring unknown module 'cubee' in file {file}, line 2\nTRACE: called by 'x' in file {file}, line 1"
    message, place = located(file, said)
    assert (message, str(place), place.text) == ("Ignoring unknown module 'cubee'", f"{file}:2", "cubee(a);")
    message, place = located(file, "Can't open import file '/x.stl', import() at line 2")
    assert (message, str(place)) == ("Can't open import file '/x.stl'", f"{file}:2")
    message, place = located(file, f"Can't open import file '/x.stl', import() at line 9, from {file}, line 1")
    assert (message, str(place)) == ("Can't open import file '/x.stl'", f"{file}:1")


def test_an_assertion_that_fails_means_that_there_is_no_shape(tmp_path):
    file = tmp_path / "plate.scad"
    wrong = failure(file, f"ERROR: Assertion '(a > 2)' failed: \"too thin\" in file {file}, line 2")
    assert isinstance(wrong, sw.Infeasible) and str(wrong) == "too thin"
    wrong = failure(file, f"ERROR: Assertion '(a > 2)' failed in file {file}, line 2")
    assert isinstance(wrong, sw.Infeasible) and str(wrong) == "(a > 2)"


@pytest.mark.parametrize(
    ("line", "facts"),
    [
        ("", {"up": "z", "unit": "mm"}),
        ("// shapewright: size=given", {"up": "z", "unit": "mm", "size": "given"}),
        ('/* shapewright: up = "y" */', None),
        ("// shapewright: up=y, unit=cm size='given'", {"unit": "cm", "size": "given"}),
    ],
)
def test_a_line_of_the_file_may_say_its_facts(tmp_path, monkeypatch, line, facts):
    monkeypatch.setattr(reading, "_check", lambda path, stamp: None)
    file = tmp_path / "plate.scad"
    file.write_text(f"{line}\na = 1; // [0:3]\ncube(a);")
    if facts is None:
        with pytest.raises(sw.ProcedureError, match=r"plate.scad:1: .*write for example: // shapewright: up=z"):
            sw.load_procedure(file)
    else:
        assert sw.load_procedure(file).facts.stated == facts


@pytest.mark.parametrize("name", ["in", "2d", "lambda"])
def test_a_variable_whose_name_is_none_in_python_gets_an_underscore(tmp_path, monkeypatch, name):
    monkeypatch.setattr(reading, "_check", lambda path, stamp: None)
    file = tmp_path / "plate.scad"
    file.write_text(f"{name} = 1; // [0:3]\ncube({name});")
    plate = sw.load_procedure(file)
    assert plate.space.names == (f"_{name}",) and plate.own_names == {f"_{name}": name}
