"""Procedures in Python that use bpy themselves, in an environment that has it; and node groups without a setting."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from shapewright import load_procedure
from shapewright.building import Workers

pytest.importorskip("bpy", reason="needs bpy; run `make test-blender`")

CHAIR = """
import bpy
from typing import Annotated
from shapewright import Range, procedure

@procedure(up="z")
def seat(width: Annotated[float, Range(0.4, 0.5)] = 0.45, legs: bool = True):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_cube_add(size=1, scale=(width, 0.4, 0.05))
    if legs:
        bpy.ops.mesh.primitive_cylinder_add(vertices=12, radius=0.05, depth=0.4, location=(0, 0, -0.2))
    parts = {}
    for part in bpy.context.scene.objects:
        vertices = [part.matrix_world @ vertex.co for vertex in part.data.vertices]
        parts[part.name] = [tuple(v) for v in vertices], [tuple(p.vertices) for p in part.data.polygons]
    return parts
"""
BUILD = """
from shapewright.building import Workers
with Workers(seat, 2) as workers:
    for build in workers.build(seat.space.sample(4, seed=1)):
        print("built", build.failure)
"""


def check(procedure):
    with Workers(procedure, 2) as workers:
        builds = workers.build(procedure.space.sample(4, seed=1))
    assert [build.failure for build in builds] == [None] * 4
    for build in builds:
        assert build.shape.extent[0] == pytest.approx(build.parameters["width"])
        assert set(build.shape.label_names) == {"Cube", "Cylinder"} if build.parameters["legs"] else {"Cube"}


def test_a_file_with_bpy_at_its_top_is_built_in_workers(tmp_path):
    (tmp_path / "chair.py").write_text(CHAIR)
    check(load_procedure(tmp_path / "chair.py"))


def test_a_script_with_bpy_at_its_top_is_built_in_workers(tmp_path):
    (tmp_path / "script.py").write_text(CHAIR + BUILD)
    done = subprocess.run([sys.executable, tmp_path / "script.py"], capture_output=True, text=True, check=False)
    assert done.stdout.splitlines() == ["built None"] * 4, done.stderr


def test_the_module_of_this_environment_builds_node_groups_in_a_process_of_its_own(monkeypatch):
    monkeypatch.delenv("SHAPEWRIGHT_BLENDER", raising=False)
    models = Path(__file__).resolve().parents[2] / "examples" / "generators" / "blender"
    code = (
        "import sys\nfrom shapewright import load_procedure\n"
        f"print(load_procedure({str(models / 'shelf.blend')!r})().extent.round(6), 'bpy' in sys.modules)"
    )
    environment = {name: value for name, value in os.environ.items() if name != "SHAPEWRIGHT_BLENDER"}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=False)
    assert done.stdout == "[0.8  1.3  0.35] False\n", done.stderr
