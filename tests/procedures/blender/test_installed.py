"""Which Blender is used, and what is said where there is none."""

import shutil
import sys
from pathlib import Path

import pytest

from shapewright.procedures import ProcedureError
from shapewright.procedures.blender import installed
from shapewright.procedures.blender.installed import SETTING, words

SCRIPT = Path("program.py")


def none_of(monkeypatch, bpy=False, blender=None):
    monkeypatch.setattr(installed.importlib.util, "find_spec", lambda name: bpy or None)
    monkeypatch.setattr(installed.shutil, "which", lambda name: blender if name == "blender" else shutil.which(name))


def test_a_python_that_is_named_runs_the_script_apart_from_this_environment():
    assert words(SCRIPT, {SETTING: sys.executable}) == [sys.executable, "-I", "program.py"]


def test_a_blender_that_is_named_runs_the_script_in_the_background(tmp_path):
    program = tmp_path / "blender-4.5"
    program.write_text("")
    program.chmod(0o755)
    started = words(SCRIPT, {SETTING: str(program)})
    assert started[:2] == [str(program), "--background"] and started[-2:] == ["--python", "program.py"]


def test_the_module_of_this_environment_comes_before_the_program_on_the_path(monkeypatch):
    none_of(monkeypatch, bpy=True, blender="/usr/bin/blender")
    assert words(SCRIPT, {})[0] == sys.executable
    none_of(monkeypatch, blender="/usr/bin/blender")
    assert words(SCRIPT, {})[0] == "/usr/bin/blender"


def test_without_any_the_error_says_what_to_install(monkeypatch):
    none_of(monkeypatch)
    with pytest.raises(ProcedureError, match=rf"needs Blender.*pip install bpy.*export {SETTING}="):
        words(SCRIPT, {})


def test_a_named_program_that_is_not_there_is_told(monkeypatch):
    with pytest.raises(ProcedureError, match=f"{SETTING}=/no/such/python: there is no such program"):
        words(SCRIPT, {SETTING: "/no/such/python"})
