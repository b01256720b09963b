"""Commands as procedures, with real small programs: what they get, what becomes of what they write, how they fail."""

import json
import os
import sys
import time

import numpy as np
import pytest

import shapewright as sw
from shapewright.building import Limits, Workers
from shapewright.procedures import Infeasible, ProcedureError

pytestmark = pytest.mark.skipif(os.name != "posix", reason="the scripts are for a POSIX shell")
TETRAHEDRON = "v 0 0 0\\nv {x} 0 0\\nv 0 1 0\\nv 0 0 1\\nf 1 3 2\\nf 1 2 4\\nf 1 4 3\\nf 2 3 4\\n"
PARAMETERS = '[parameters]\nwidth = { range = [1, 4], default = 2 }\nlid = { bool = true, when = "width > 2" }\n'


def procedure(folder, script, head="", run='run = "sh tool.sh {params.json} {out.obj} {width}"'):
    (folder / "tool.sh").write_text(script)
    (folder / "spec.toml").write_text(f"{run}\n{head}\n{PARAMETERS}")
    return sw.load_procedure(folder / "spec.toml")


def writes(x="$3"):
    return f"printf '{TETRAHEDRON.format(x='%s')}' {x} > \"$2\"\n"


def failure(made, **values):
    with pytest.raises(ProcedureError) as error:
        made(**values)
    assert error.value.place.line == 1
    return error.value.message


def test_a_script_is_a_procedure(tmp_path):
    made = procedure(tmp_path, writes())
    assert (made.name, made.space.names, made.space.defaults) == (
        "spec",
        ("width", "lid"),
        {"width": 2.0, "lid": False},
    )
    assert made.space.to_schema()["properties"]["lid"]["x-when"] == "width > 2"
    assert made(width=3.5).extent.tolist() == [3.5, 1.0, 1.0]


def test_it_gets_its_parameters_as_json_and_as_words(tmp_path):
    made = procedure(
        tmp_path, f'cp "$1" {tmp_path}/got.json; echo "$4" > {tmp_path}/lid; ' + writes(),
        "[parameters.rows]\nfixed = [1, 2]\n", 'run = "sh tool.sh {params.json} {out.obj} {width} {lid} {here}"',
    )  # fmt: skip
    made(width=3.0, lid=True)
    assert json.loads((tmp_path / "got.json").read_text()) == {"width": 3.0, "lid": True, "rows": [1, 2]}
    assert (tmp_path / "lid").read_text() == "true\n"


def test_it_runs_in_a_folder_of_its_own_that_is_gone_afterwards(tmp_path):
    made = procedure(tmp_path, f"pwd > {tmp_path}/where; touch scratch; {writes()}")
    made()
    where = (tmp_path / "where").read_text().strip()
    assert where != str(tmp_path) and not os.path.exists(where)  # noqa: PTH110


def test_no_shell_reads_the_line_unless_it_is_asked(tmp_path):
    words = "echo '$HOME' > said; " + writes()
    made = procedure(tmp_path, words, "", "run = \"sh tool.sh {params.json} {out.obj} '{width}' ; false\"")
    assert made(width=3.0).extent[0] == 3.0
    line = f'run = "touch {tmp_path}/a && sh {{here}}/tool.sh {{params.json}} {{out.obj}} {{width}}"\nshell = true'
    assert procedure(tmp_path, writes(), "", line)(width=3.0).extent[0] == 3.0
    assert (tmp_path / "a").exists()


def test_names_of_parts_become_labels(tmp_path):
    made = procedure(tmp_path, f"{writes()}sed -i '1i o seat' \"$2\"\n")
    assert made().label_names == ("seat",)


def test_up_and_unit_of_the_spec_count_unless_the_format_states_its_own(tmp_path):
    made = procedure(tmp_path, writes(), 'up = "z"\nunit = "mm"\nsize = "given"')
    assert made.facts.size == "given"
    np.testing.assert_allclose(made(width=3.0).bounds, [[0, 0, -1], [3, 1, 0]])
    script = tmp_path / "tool.py"
    script.write_text(
        "import sys, trimesh\ntrimesh.creation.box((float(sys.argv[2]), 5, 1)).export(sys.argv[1])  # metres, y up\n"
    )
    run = f'run = "{sys.executable} tool.py {{out.glb}} {{width}}"'
    shape = procedure(tmp_path, "", 'up = "z"\nunit = "mm"', run)(width=3.0)
    np.testing.assert_allclose(shape.extent, [3000, 5000, 1000])


def test_a_drawing_may_be_written_as_well(tmp_path):
    run = 'run = "sh tool.sh {width} {out.svg}"'
    svg = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 9 9'><rect width='%s' height='2'/></svg>"
    assert isinstance(procedure(tmp_path, f'printf "{svg}" $1 > $2\n', "", run)(width=3.0), sw.Drawing)


def test_a_program_may_write_into_a_name_of_its_own(tmp_path):
    run = 'run = "sh tool.sh {params.json} part.obj {width}"\nout = "part.obj"'
    assert procedure(tmp_path, writes(), "", run)(width=3.0).extent[0] == 3.0


def test_each_way_to_leave_no_shape_has_a_message_of_its_own(tmp_path):
    def says(script, **head):
        return failure(procedure(tmp_path, script, **head))

    crash = says("echo loading >&2; echo 'no such node: Legs' >&2; exit 3")
    assert crash == "the program failed: no such node: Legs (before it: loading) (exit status 3)"
    assert says("kill -SEGV $$") == "the program failed: it said nothing (signal 11, SIGSEGV)"
    assert says("exit 0") == "the program ended well, but there is no out.obj; it wrote nothing"
    assert says("echo > model.stl") == "the program ended well, but there is no out.obj; it wrote model.stl"
    assert "left an old out.obj" in says(writes() + 'touch -d "2001-01-01" "$2"')
    assert says('touch "$2"') == "the program left an empty out.obj"
    cloud = 'i=0; while [ $i -lt 150 ]; do echo "v $i $((i * i)) 0"; i=$((i + 1)); done > "$2"'
    assert says(cloud) == "the program wrote points into out.obj; a shape needs surfaces"
    assert says('printf "f 1 2 3\\n" > "$2"').startswith("what the program wrote is no shape: out.obj: ")
    flat = "v 0 0 0\\nv 1 0 0\\nv 2 0 0\\nf 1 2 3\\n"
    assert "its triangles have no area" in says(f'printf "{flat}" > "$2"')
    missing = says("", run='run = "no-such-tool {width} {out.obj}"')
    assert missing.startswith("no-such-tool cannot be started: there is no such program")
    (tmp_path / "tool.sh").chmod(0o644)
    assert "it may not be run" in says("", run='run = "tool.sh {width} {out.obj}"')


def test_an_open_mesh_is_a_shape_that_is_told_as_open(tmp_path):
    shape = procedure(tmp_path, writes() + "sed -i '$d' \"$2\"\n")()
    assert not shape.soundness().closed


def test_parameters_without_a_shape_are_infeasible(tmp_path):
    made = procedure(tmp_path, "echo too thin >&2; exit 77", "infeasible = 77\nconstraints = ['width < 3.5']")
    with pytest.raises(Infeasible, match="too thin"):
        made(width=2.0)
    with pytest.raises(Infeasible, match=r"it does not hold that width < 3\.5"):
        made(width=3.8)


def test_what_takes_too_long_is_ended_with_its_children_and_only_that_shape_is_lost(tmp_path):
    slow = f"case $3 in 4*) sleep 60 & echo $! > {tmp_path}/child; wait;; esac; {writes()}"
    made = procedure(tmp_path, slow, "seconds = 3")
    vectors = [{"width": width, "lid": False} for width in (1.0, 4.0, 3.0)]
    with Workers(made, 1, Limits(seconds=30.0)) as crew:
        builds = crew.build(vectors)
    assert [build.failure.kind if build.failure else None for build in builds] == [None, "time", None]
    child = int((tmp_path / "child").read_text())
    deadline = time.monotonic() + 5.0
    while os.path.exists(f"/proc/{child}") and time.monotonic() < deadline:  # noqa: PTH110
        time.sleep(0.02)
    assert not os.path.exists(f"/proc/{child}")  # noqa: PTH110


@pytest.mark.skipif(sys.platform != "linux", reason="the limit of memory holds on Linux")
def test_a_program_has_the_memory_that_its_spec_says(tmp_path):
    hungry = f"{sys.executable} -c 'import time; time.sleep(0.1); b = bytearray(500 * 2**20)' && {writes()}"
    assert procedure(tmp_path, hungry)(width=3.0).extent[0] == 3.0
    assert "MemoryError" in failure(procedure(tmp_path, hungry, "memory = 300"))


def test_failures_of_workers_say_what_the_program_said(tmp_path):
    made = procedure(tmp_path, "echo no licence >&2; exit 1")
    with Workers(made, 1) as crew:
        (build,) = crew.build([made.space.defaults])
    assert build.failure.kind == "crash"
    assert str(build.failure).startswith(f"crash: {tmp_path / 'spec.toml'}:1: the program failed: no licence")


def test_another_python_runs_a_tool_in_its_own_environment(tmp_path):
    (tmp_path / "tool.py").write_text("import sys\nprint(sys.executable)\nsys.exit('from there')\n")
    (tmp_path / "spec.toml").write_text(
        f'run = "tool.py {{width}} {{out.obj}}"\npython = "{sys.executable}"\n{PARAMETERS}'
    )
    assert "from there" in failure(sw.load_procedure(tmp_path / "spec.toml"))
