"""Parameters in the forms of other programs, and read back from them."""

import enum
import json
import shlex
from typing import Annotated, Literal

import pytest

import shapewright as sw
from shapewright import Range
from shapewright.procedures import ProcedureError
from shapewright.procedures.forms import written
from shapewright.procedures.sets import read_sets


class Style(enum.Enum):
    PLAIN = 1
    ROUND = 2


@sw.procedure
def box(
    size: tuple[Annotated[float, Range(1, 9)], Annotated[float, Range(1, 9)]] = (2.0, 3.0),
    count: Annotated[int, Range(1, 4)] = 2,
    teeth: Annotated[int, Range(0, 400)] = 20,
    lid: bool = False,
    style: Style = Style.PLAIN,
    kind: Literal["a b", "c"] = "c",
    width: Literal[10, 20] = 10,
    hole: Annotated[float | None, Range(1, 2)] = None,
    note: str = "fixed",
):
    return None


CHOSEN = box.space.defaults | {"size.x": 4.5, "lid": True, "style": "ROUND", "kind": "a b", "with_hole": True}
SETS = {"plain": box.space.defaults, "oak, wide": CHOSEN}


def test_a_call_in_python_is_what_the_function_gets():
    plain, wide = written(box, SETS, "python").splitlines()
    assert plain == (
        "box(size=(2.0, 3.0), count=2, teeth=20, lid=False, style=Style.PLAIN, kind='c', width=10, hole=None)  # plain"
    )
    got = eval(wide, {"box": lambda **given: given, "Style": Style})
    assert got == box.signature.arguments(CHOSEN) and got["style"] is Style.ROUND and got["hole"] == 1.5


def test_arguments_of_openscad_are_words_of_a_shell():
    name, line = written(box, {"oak": CHOSEN}, "openscad").splitlines()
    assert name == "# oak"
    assert shlex.split(line)[1::2] == [
        "size=[4.5, 3.0]", "count=2", "teeth=20", "lid=true", 'style="ROUND"', 'kind="a b"', "width=10", "hole=1.5",
    ]  # fmt: skip


def test_parameter_sets_are_as_the_customizer_writes_them():
    found = json.loads(written(box, {"plain": box.space.defaults}, "json"))
    assert found["fileFormatVersion"] == "1"
    assert found["parameterSets"]["plain"] == {
        "size": "[2.0, 3.0]", "count": "2", "teeth": "20", "lid": "false", "style": "PLAIN", "kind": "c",
        "width": "10", "hole": "undef",
    }  # fmt: skip


def test_a_table_has_a_row_for_each_and_is_read_back(tmp_path):
    (tmp_path / "rows.csv").write_text(written(box, SETS, "csv"))
    assert (tmp_path / "rows.csv").read_text().splitlines()[0].startswith("name,size.x,size.y,count")
    assert read_sets(tmp_path / "rows.csv", box).vectors == tuple(SETS.items())


def test_sets_are_read_back_by_the_names_of_the_tool(tmp_path):
    (tmp_path / "spec.toml").write_text(
        'run = "tool {params.json} {out.obj}"\n[parameters]\n"Leg Type" = { choices = ["a", "b"] }\n'
        "width = { range = [1, 9] }\ncolour = 'red'\n"
    )
    tool = sw.load_procedure(tmp_path / "spec.toml")
    sets = {"one": {"Leg_Type": "b", "width": 2.5}}
    for form, suffix in (("json", "json"), ("csv", "csv")):
        path = tmp_path / f"sets.{suffix}"
        path.write_text(written(tool, sets, form))
        assert "Leg Type" in path.read_text()
        assert read_sets(path, tool).vectors == tuple(sets.items())


def test_sets_as_openscad_writes_them_are_read(tmp_path):
    path = tmp_path / "sets.json"
    sets = {"small": {"size": "[1, 2.5]", "lid": "true", "count": "3", "note": "x"}, "": {"kind": "a b"}}
    path.write_text(json.dumps({"parameterSets": sets, "fileFormatVersion": "1"}, indent=4))
    found = read_sets(path, box)
    assert found.held == ("note",)
    assert [name for name, _ in found.vectors] == ["small", ""]
    small, other = (values for _, values in found.vectors)
    assert small == box.space.defaults | {"size.x": 1.0, "size.y": 2.5, "lid": True, "count": 3}
    assert other == box.space.defaults | {"kind": "a b"}


def test_plain_lists_of_values_are_read_as_well(tmp_path):
    path = tmp_path / "list.json"
    path.write_text('[{"count": 4, "lid": true, "width": 20.0}, {}]')
    assert [values["width"] for _, values in read_sets(path, box).vectors] == [20, 10]


@pytest.mark.parametrize(
    ("name", "text", "line", "says"),
    [
        ("a.csv", "count,lidd\n1,true\n", 2, "row 1: there is no parameter 'lidd'; there are size.x"),
        ("a.csv", "name,count\none,1\ntwo,9\n", 3, "row 2 (two): count = 9 lies outside 1 to 4"),
        ("a.csv", "count\n1.5\n", 2, "row 1: count = 1.5 is no whole number"),
        ("a.csv", "count\nmany\n", 2, "row 1: count = many is no number"),
        ("a.csv", "teeth\n1.5\n", 2, "row 1: teeth = 1.5 is no whole number"),
        ("a.csv", "lid\nmaybe\n", 2, "row 1: lid = maybe is not true or false"),
        ("a.csv", "kind\nd\n", 2, "row 1: kind = d is none of a b, c"),
        ("a.csv", "count,lid\n1\n", 2, "row 1: it has 1 values, and the header 2 names"),
        ("a.csv", "count\n", None, "it lists no parameters"),
        (
            "a.json",
            '{"parameterSets": {\n"wide": {\n"size": "[1, 20]"}}}',
            2,
            "set wide: size.y = 20 lies outside 1 to 9",
        ),
        ("a.json", '{"parameterSets": {', 1, "no JSON"),
        ("a.json", '{"width": 3}', None, "width: no parameters; write"),
    ],
)
def test_what_is_wrong_is_told_with_its_row(tmp_path, name, text, line, says):
    (tmp_path / name).write_text(text)
    with pytest.raises(ProcedureError) as error:
        read_sets(tmp_path / name, box)
    assert says in str(error.value) and name in str(error.value)
    assert (error.value.place.line if error.value.place else None) == line


def test_the_manifest_of_samples_is_read_by_its_parameters(tmp_path):
    from shapewright.fitting.samples import COLUMNS

    path = tmp_path / "manifest.csv"
    path.write_text("path,count,sound,closed,failure\nbox-00000.stl,3,True,True,\n")
    assert read_sets(path, box, COLUMNS).vectors == (("box-00000", box.space.defaults | {"count": 3}),)
