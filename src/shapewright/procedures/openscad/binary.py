"""The shape of an OpenSCAD file, by the program ``openscad``: some hundred times slower than the package."""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from shapewright.procedures.errors import ProcedureError
from shapewright.procedures.openscad.messages import failure
from shapewright.procedures.places import Place


def built(program: str, file: Path, values: Mapping[str, Any]) -> Any:
    """The mesh of a file with these values of its variables. program: the path of ``openscad``.

    Raises Infeasible where an assertion of the file fails, ProcedureError with the file's line.
    """
    import trimesh

    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "shape.off"
        given = [f"-D{name}={_spelt(value)}" for name, value in values.items()]
        ran = subprocess.run(
            [program, "-o", str(made), *given, str(file)],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors="replace",
            check=False,
        )
        lines = ran.stderr.splitlines()
        wrong = next((line for line in lines if line.startswith("ERROR: ")), None)
        if wrong:
            raise failure(file, wrong)
        if ran.returncode or not made.is_file():
            said = next((line for line in reversed(lines) if line.strip()), f"it ended with status {ran.returncode}")
            raise ProcedureError(f"openscad: {said}", Place(str(file), None))
        return trimesh.load(made, force="mesh", process=False)


def _spelt(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"')
        return f'"{escaped}"'
    if isinstance(value, tuple | list):
        return f"[{', '.join(map(_spelt, value))}]"
    return repr(value)
