"""What a spec says, and what is wrong with one, with its line."""

import re
from pathlib import Path

import pytest

from shapewright.commands import read_spec
from shapewright.commands.entries import KEYS
from shapewright.commands.spec import KINDS as SPEC_KEYS
from shapewright.procedures import ProcedureError

HEAD = 'run = "tool {params.json} {out.obj}"\n'
ONE = "[parameters]\nwidth = { range = [1, 2] }\n"


def spec(folder, text):
    path = folder / "spec.toml"
    path.write_text(text)
    return read_spec(path)


def test_a_spec_says_what_is_run_and_of_what(tmp_path):
    (tmp_path / "tool.py").write_text("")
    said = spec(
        tmp_path,
        'run = "python3 tool.py --width={width} -o \'{out.stl}\'"\nseconds = 2.5\nmemory = 900\nup = "z"\nunit = "mm"\n'
        "[environment]\nTHREADS = 1\n[parameters]\nresolution = 32\n"
        '"wall thickness" = { range = [0.5, 4], log = true }\n'
        "width = { range = [10, 20], step = 2.5 }\nnames = { fixed = { a = [1] } }\n",
    )
    assert said.words == ("python3", str(tmp_path / "tool.py"), "--width={width}", "-o", "{out.stl}")
    assert said.helpers == (tmp_path / "tool.py",)
    assert (said.seconds, said.memory_mb, said.name, said.environment) == (2.5, 900, "spec", {"THREADS": "1"})
    assert (said.facts.up, said.facts.unit, said.facts.size) == ("z", "mm", "relative")
    assert said.entries.names == {"wall_thickness": "wall thickness", "width": "width"}
    assert said.entries.fixed == {"resolution": 32, "names": {"a": [1]}}
    assert said.place.line == 1


@pytest.mark.parametrize(
    ("text", "line", "says"),
    [
        ("run = 'tool\n", 1, "no TOML"),
        (HEAD + "unti = 'mm'\n" + ONE, 2, "unti: there is no such key; did you mean unit?"),
        (HEAD + "unit = 'km'\n" + ONE, 2, "unit: unit='km': use one of mm, cm, m, in, ft"),
        (HEAD + "seconds = 'long'\n" + ONE, 2, "seconds: 'long' is not a whole number or a number"),
        (HEAD + "seconds = 0\n" + ONE, 2, "seconds: 0 is not above 0"),
        (HEAD + "shell = 1\n" + ONE, 2, "shell: 1 is not true or false"),
        (ONE, None, "say what is run"),
        (HEAD + 'call = "math:sin"\n' + ONE, 2, "one of them"),
        ('call = "sin"\n' + ONE, 1, "'sin' is no function"),
        (HEAD, None, "no parameter has a range"),
        (HEAD + "[parameters]\nwidth = 3\n", 2, "no parameter has a range"),
        (HEAD + "[parameters]\nwidth = { rang = [1, 2] }\n", 3, "there is no such key; did you mean range?"),
        (HEAD + "[parameters]\nwidth = { default = 2 }\n", 3, "say one of: range = [low, high]"),
        (HEAD + "[parameters]\n\n[parameters.width]\nrange = [1]\n", 5, "[1] is not [low, high]"),
        (HEAD + "[parameters]\n\n[parameters.width]\nrange = [1, 2]\ndefault = 3\n", 6, "outside Range(1, 2), by 1"),
        (HEAD + "[parameters]\nwidth = { range = [2, 1] }\n", 3, "needs two finite ends, the lower one first"),
        (HEAD + "[parameters]\nwidth = { range = [0, 1], log = true }\n", 3, "needs ends above 0"),
        (HEAD + "[parameters]\nwidth = { range = [0, 1], step = 0 }\n", 3, "step: 0 is no number above 0"),
        (HEAD + "[parameters]\nwidth = { range = [0, 1], step = 3 }\n", 3, "it gives 1 values"),
        (HEAD + "[parameters]\nn = { range = [0.5, 3], integer = true }\n", 3, "needs whole ends"),
        (HEAD + "[parameters]\nkind = { choices = ['a'] }\n", 3, "a list of two values or more"),
        (HEAD + "[parameters]\nkind = { choices = ['a', 'b'], default = 'c' }\n", 3, "the default 'c'"),
        (HEAD + "[parameters]\nlid = { bool = true, default = 1 }\n", 3, "1 is not true or false"),
        (HEAD + "[parameters]\nn = { range = [1, 3], integer = 'yes' }\n", 3, "'yes' is not true or false"),
        (HEAD + "[parameters]\nlegs.x = { range = [1, 3] }\n", 3, "there is no such key; there are bool, ch"),
        (HEAD + ONE + "lid = { bool = true, when = 'widht > 1' }\n", 4, "there is no parameter 'widht'"),
        (HEAD + ONE + "lid = { bool = true, when = 'open()' }\n", 4, "call has no place in it"),
        (HEAD + ONE + '"a b" = { range = [0, 1] }\na_b = { range = [0, 1] }\n', 5, "the same name as 'a b'"),
        ('run = "tool {params.json} {widht} {out.obj}"\n' + ONE, 1, "nothing is known of {widht}"),
        ('run = "tool {params.json}"\n' + ONE, 1, "say once which file it writes"),
        ('run = "tool {params.json} {out.obj} {out.stl}"\n' + ONE, 1, "say once which file it writes"),
        ('run = "tool {out.obj}"\n' + ONE, 1, "it gets no parameters"),
        ('run = "tool \'{params.json}"\n' + ONE, 1, "no closing quotation"),
        (HEAD + "constraints = ['width > hight']\n" + ONE, 2, "there is no parameter 'hight'"),
        (HEAD + "ranges = 'recipe.yml'\n" + ONE, 2, "there is no file"),
    ],
)
def test_what_is_wrong_is_told_with_its_key_and_line(tmp_path, text, line, says):
    with pytest.raises(ProcedureError) as error:
        spec(tmp_path, text)
    assert says in str(error.value)
    assert str(tmp_path / "spec.toml") in str(error.value)
    assert (error.value.place.line if error.value.place else None) == line


def test_the_specs_of_the_page_are_specs(tmp_path):
    page = (Path(__file__).resolve().parents[2] / "docs" / "generators.md").read_text(encoding="utf-8")
    (tmp_path / "cabinet.sh").write_text("")
    command, call, vase, chair = (spec(tmp_path, block) for block in re.findall(r"```toml\n(.*?)```", page, re.DOTALL))
    assert command.words[1] == str(tmp_path / "cabinet.sh") and command.entries.fixed == {"finish": "matt"}
    assert call.target == "scene_synthesizer.procedural_assets:TableAsset" and len(call.entries.parameters) == 4
    assert len(vase.entries.parameters) == 4 and not vase.drawn
    assert chair.drawn and chair.entries.fixed == {"base_fn": "chair_straight_base"}
    for key in (*KEYS, *SPEC_KEYS):
        assert re.search(rf"`\[?{key}\b", page), key
