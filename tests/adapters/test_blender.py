"""Geometry node groups of .blend files as procedures, built by the real Blender beside this process."""

import csv
import json
import os
import subprocess
import sys
import threading
import time
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from shapewright import load_procedure
from shapewright.building import Limits, Workers
from shapewright.cli.main import app
from shapewright.procedures import ProcedureError
from shapewright.procedures.blender import node_group
from shapewright.procedures.blender.installed import SETTING, words
from shapewright.procedures.forms import written
from shapewright.runs.helpers import copy_in, helpers_of, write_source

if not (os.environ.get(SETTING) or find_spec("bpy")):
    pytest.skip(f"needs Blender: run `make test-blender`, or set {SETTING}", allow_module_level=True)

TESTS = Path(__file__).resolve().parents[1]
MODELS = TESTS.parent / "examples" / "generators" / "blender"


def blender(script: Path, *arguments: str) -> str:
    """What a script prints that runs in Blender's Python."""
    own = words(script)
    own = [*own, "--"] if "--python" in own else own
    done = subprocess.run([*own, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def strange(tmp_path_factory) -> Path:
    """A file of node groups with sockets of every kind, and some that fail."""
    folder = tmp_path_factory.mktemp("strange")
    blender(TESTS / "helpers" / "strange_blend.py", str(folder))
    return folder / "strange.blend"


@pytest.fixture(scope="module")
def shelf():
    return load_procedure(MODELS / "shelf.blend")


def test_limits_and_defaults_of_sockets_are_the_space(shelf):
    properties = shelf.space.to_schema()["properties"]
    assert shelf.name == "Shelf" and shelf.signature.fixed == ("bevel",)
    assert {name: (p["minimum"], p["maximum"]) for name, p in properties.items() if "minimum" in p} == {
        "width": (0.5, 1.4),
        "height": (0.7, 2.0),
        "depth": (0.2, 0.5),
        "board_thickness": (0.015, 0.06),
        "boards": (2, 7),
        "foot_height": (0.04, 0.2),
    }
    assert properties["feet"]["enum"] == ["Posts", "Pegs", "Plinth"]
    assert shelf.space.defaults == {
        "width": 0.8,
        "height": 1.2,
        "depth": 0.35,
        "board_thickness": 0.03,
        "boards": 4,
        "foot_height": 0.1,
        "back": True,
        "feet": "Posts",
    }
    assert shelf.facts.stated == {"up": "z", "unit": "m", "size": "given"}


@pytest.mark.parametrize("values", [{}, {"width": 1.3, "feet": "Plinth"}, {"height": 0.9, "depth": 0.5, "boards": 7}])
def test_a_shape_has_the_size_that_its_values_say(shelf, values):
    values = shelf.space.defaults | values
    mesh = shelf(**values)
    size = [values["width"], values["height"] + values["foot_height"], values["depth"]]
    assert mesh.extent == pytest.approx(size, abs=1e-6)
    boards = sum(label == "board" for label in mesh.labels)
    assert boards == 12 * values["boards"]


def test_named_attributes_are_the_labels(shelf):
    mesh = shelf(feet="Pegs", back=True)
    assert set(mesh.label_names) == {"board", "side", "back", "foot"} and None not in mesh.labels
    back = mesh.triangles[np.array(mesh.labels) == "back"]
    assert back[..., 2].max() < 0.0  # the front looks towards +Z, which is -Y in Blender
    assert "back" not in shelf(back=False).label_names


def test_the_unit_of_the_scene_and_a_text_of_the_file_are_facts(strange):
    assert load_procedure(f"{strange}:Kinds").facts.stated == {"up": "z", "unit": "mm"}


def test_materials_are_labels_and_colours():
    column = load_procedure(MODELS / "column.blend")
    assert column.space.names == ("height", "radius", "top_foot", "sides", "head_height", "plinth", "head")
    mesh = column(plinth=True)
    assert set(mesh.label_names) == {"shaft", "head", "plinth"}
    (colour,) = {tuple(c) for c, label in zip(mesh.face_colours, mesh.labels, strict=True) if label == "plinth"}
    assert colour == (149, 149, 153, 255)  # linear .3, .3, .32 in sRGB


def test_sockets_of_all_kinds_are_parameters_or_held(strange):
    kinds = load_procedure(f"{strange}:Kinds")
    assert kinds.space.names == ("class_", "below", "size.x", "size.y", "size.z", "legs_radius", "top_radius")
    assert kinds.space.defaults["below"] == 0.5
    assert kinds.signature.fixed == ("half", "seed", "where", "colour", "thing", "paint", "own")
    mesh = kinds(**{"size.x": 2.0})
    assert mesh.extent[0] == pytest.approx(2.0)
    assert mesh.bounds[1][1] == pytest.approx(5.0), "the object is the one that the file's modifier has"


def test_a_socket_that_blender_greys_out_does_not_matter(strange):
    space = load_procedure(f"{strange}:Switches").space
    found = {parameter.name: parameter.when.text for parameter in space if parameter.when}
    if not found:
        pytest.skip("Blender before 4.5 greys nothing out")
    assert found == {"knob": "drawers >= 1", "panel": "back or drawers >= 1", "span": "form == 'Wide'"}
    assert "panel" in space.active({**space.defaults, "back": True}) and "panel" not in space.active(space.defaults)


def test_without_a_name_the_file_has_to_have_one_group(strange):
    with pytest.raises(
        ProcedureError, match=r"several node groups \(Grid, Kinds, Loose, Switches, Wire\); say which: .*:Grid"
    ):
        load_procedure(strange)
    with pytest.raises(
        ProcedureError, match="no node group 'Chair' in it; there is Grid, Kinds, Loose, Switches, Wire"
    ):
        load_procedure(f"{strange}:Chair")


def test_a_group_without_a_space_names_its_sockets(strange):
    with pytest.raises(ProcedureError, match=r"no socket .* 'Loose' .* \(Size: it needs a minimum and a maximum\)"):
        load_procedure(f"{strange}:Loose")


def test_a_file_that_is_no_blend_file_says_so(tmp_path):
    (tmp_path / "text.blend").write_text("nothing of Blender's")
    with pytest.raises(ProcedureError, match=r"text\.blend: Blender says: .*"):
        load_procedure(tmp_path / "text.blend")


def test_a_python_without_bpy_is_told(tmp_path, monkeypatch):
    if find_spec("bpy"):
        pytest.skip("this Python has bpy")
    monkeypatch.setenv(SETTING, sys.executable)
    (tmp_path / "other.blend").write_bytes((MODELS / "shelf.blend").read_bytes())
    with pytest.raises(ProcedureError, match=r"other\.blend: .* has no module bpy\. Install Blender"):
        load_procedure(tmp_path / "other.blend")


def test_the_shapes_do_not_depend_on_what_was_built_before_nor_on_the_workers(shelf):
    vectors = shelf.space.sample(12, seed=5)
    alone = [shelf(**values) for values in vectors[::-1]][::-1]
    with Workers(shelf, 2) as workers:
        built = workers.build(vectors)
    for one, other in zip(alone, built, strict=True):
        assert np.array_equal(one.vertices, other.shape.vertices) and one.labels == other.shape.labels


def test_an_empty_mesh_is_told_from_a_crash(strange):
    wire = load_procedure(f"{strange}:Wire")
    with Workers(wire, 1) as workers:
        empty, solid = workers.build([{"solid": False, "radius": 1.0}, {"solid": True, "radius": 1.0}])
    assert empty.failure.kind == "no shape" and "16 edges and no face: curves need a Curve to Mesh" in str(
        empty.failure
    )
    assert solid.failure is None and len(solid.shape.faces) == 14


def test_too_much_time_is_blamed_on_the_shape_and_the_next_one_is_built(strange):
    with Workers(load_procedure(f"{strange}:Grid"), 1, Limits(1.0, 100_000)) as workers:
        first, late, last = workers.build([{"count": 5}, {"count": 12_000}, {"count": 6}])
    assert late.failure.kind == "time"
    assert (len(first.shape.faces), len(last.shape.faces)) == (32, 50)


def test_too_much_memory_is_blamed_on_the_shape_and_the_next_one_is_built(strange):
    with Workers(load_procedure(f"{strange}:Grid"), 1, Limits(60.0, 600)) as workers:
        first, large, last = workers.build([{"count": 5}, {"count": 12_000}, {"count": 6}])
    assert large.failure.kind == "memory" and "600 MB" in large.failure.message
    assert (len(first.shape.faces), len(last.shape.faces)) == (32, 50)


def test_a_blender_that_dies_is_told_and_another_one_takes_its_place(strange):
    grid = load_procedure(f"{strange}:Grid")
    grid(count=5)
    death = threading.Timer(0.3, node_group._residents[strange].stop)
    death.start()
    with pytest.raises(ProcedureError, match="Blender ended") as caught:
        grid(count=8000)
    death.join()
    assert caught.value.kind == "crash"
    assert len(grid(count=5).faces) == 32


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
def test_blender_ends_with_its_parent_even_while_it_builds(strange):
    start = (
        "import sys, threading\nfrom pathlib import Path\nfrom shapewright import load_procedure\n"
        "from shapewright.procedures.blender import node_group\n"
        f"grid = load_procedure({f'{strange}:Grid'!r})\n"
        f"print(node_group._residents[Path({str(strange)!r})]._process.pid, flush=True)\ngrid(count=20_000)"
    )
    with subprocess.Popen([sys.executable, "-c", start], stdout=subprocess.PIPE, text=True) as process:
        pid = int(process.stdout.readline())
        time.sleep(0.3)
        process.kill()
    deadline = time.monotonic() + 10.0
    while Path(f"/proc/{pid}").exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not Path(f"/proc/{pid}").exists()


def test_builds_leave_no_data_blocks_behind(tmp_path):
    script = tmp_path / "count.py"
    script.write_text(
        f"import sys\nsys.path.insert(0, {str(Path(node_group.__file__).parent)!r})\nimport bpy, program\n"
        f"file = program.File({str(MODELS / 'shelf.blend')!r})\n"
        "boards = next(s['identifier'] for s in file.inside['groups'][0]['sockets'] if s['name'] == 'Boards')\n"
        "kinds = ('meshes', 'objects', 'node_groups', 'scenes', 'materials', 'collections')\n"
        "for i in range(40):\n    file.bench('Shelf').built({boards: 2 + i % 6})\n"
        "    print('blocks', [len(getattr(bpy.data, kind)) for kind in kinds])\n"
    )
    counts = {line for line in blender(script).splitlines() if line.startswith("blocks")}
    assert len(counts) == 1


def test_a_script_makes_the_same_shapes_in_blender(shelf, tmp_path):
    chosen = {"wide": {"width": 1.3, "feet": "Plinth"}, "it's high": {"height": 1.9, "boards": 2, "back": False}}
    sets = {name: shelf.space.defaults | values for name, values in chosen.items()}
    shown = (
        "\nbpy.context.view_layer.update()\ngraph = bpy.context.evaluated_depsgraph_get()\n"
        "for thing in bpy.context.scene.objects:\n"
        "    print('made', thing.name, len(thing.evaluated_get(graph).data.polygons), "
        "*(round(d, 4) for d in thing.evaluated_get(graph).dimensions), sep='|')\n"
    )
    program = tmp_path / "program.py"
    opening = f"import bpy\nbpy.ops.wm.open_mainfile(filepath={str(MODELS / 'shelf.blend')!r}, load_ui=False)\n"
    program.write_text(opening + written(shelf, sets, "blender") + shown)
    made = [line.split("|") for line in blender(program).splitlines() if line.startswith("made")]
    sizes = {name: [float(d) for d in size] for _, name, _, *size in made}
    for name, values in sets.items():
        x, z, y = shelf(**values).extent
        assert sizes[name] == pytest.approx([x, y, z], abs=1e-3)


def test_a_run_keeps_the_file(shelf):
    assert helpers_of(shelf).contents == {"procedure/shelf.blend": (MODELS / "shelf.blend").read_bytes()}


def test_a_linked_group_is_built_and_a_run_keeps_the_file_that_it_is_in(strange, tmp_path):
    linking = load_procedure(strange.with_name("linking.blend"))
    assert linking.name == "Wire" and linking.helpers == (strange,)
    write_source(tmp_path, str(linking.path), linking.source, helpers_of(linking).contents)
    assert len(load_procedure(copy_in(tmp_path, str(linking.path)))(solid=True).faces) == 14


def test_another_file_is_another_procedure(shelf, tmp_path):
    copy = tmp_path / "copy.blend"
    copy.write_bytes((MODELS / "shelf.blend").read_bytes())
    assert load_procedure(copy).digest == shelf.digest
    copy.write_bytes((MODELS / "column.blend").read_bytes())
    assert load_procedure(copy).digest != shelf.digest and load_procedure(copy).name == "Column"


def test_the_commands_take_a_node_group(strange, tmp_path):
    told = CliRunner().invoke(app, ["describe", f"{strange}:Kinds", "--json"])
    assert told.exit_code == 0, told.output
    described = json.loads(told.stdout.splitlines()[-1])
    assert described["title"] == "Kinds" and "thing" in described["x-fixed"]
    sampled = CliRunner().invoke(
        app, ["sample", str(MODELS / "column.blend"), "-n", "3", "--out", str(tmp_path / "out")]
    )
    assert sampled.exit_code == 0, sampled.output
    with (tmp_path / "out" / "manifest.csv").open() as table:
        assert {row["closed"] for row in csv.DictReader(table)} == {"True"}
