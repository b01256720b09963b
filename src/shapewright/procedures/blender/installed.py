"""Which Blender builds: one that is named, the module bpy of this environment, or the program on the PATH."""

from __future__ import annotations

import importlib.util
import os
import shutil
import sys
from collections.abc import Mapping
from pathlib import Path

from shapewright.procedures.errors import ProcedureError

SETTING = "SHAPEWRIGHT_BLENDER"
"""Environment variable: path of a Python that has bpy, or of Blender itself."""
ADVICE = (
    "Install Blender 4.2 or later (blender.org) so that the command blender is found, or its Python module in an "
    "environment of its own: python3.11 -m venv blender && blender/bin/pip install bpy==4.5.0 && "
    f"export {SETTING}=$PWD/blender/bin/python"
)
"""What a person does who has no Blender."""


def words(script: Path, environment: Mapping[str, str] = os.environ) -> list[str]:
    """The command that runs a script in Blender's Python. Raises ProcedureError that says what to install."""
    if named := environment.get(SETTING):
        program = shutil.which(str(Path(named).expanduser()))
        if program is None:
            raise ProcedureError(f"{SETTING}={named}: there is no such program. {ADVICE}")
        return _python(program, script) if "python" in Path(named).name.lower() else _blender(program, script)
    if importlib.util.find_spec("bpy"):
        return [sys.executable, "-P", str(script)]
    if program := shutil.which("blender"):
        return _blender(program, script)
    raise ProcedureError(f"a .blend file needs Blender, and there is none. {ADVICE}")


def _python(program: str, script: Path) -> list[str]:
    return [program, "-I", str(script)]


def _blender(program: str, script: Path) -> list[str]:
    return [
        program,
        "--background",
        "--factory-startup",
        "--threads",
        "1",
        "--python-exit-code",
        "1",
        "--python",
        str(script),
    ]
