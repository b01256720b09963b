"""The shape of an OpenSCAD file, by the program ``openscad``: some hundred times slower than the package."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from shapewright.procedures.errors import ProcedureError
from shapewright.procedures.openscad.messages import failure, is_lacking, located
from shapewright.procedures.openscad.text import literal
from shapewright.procedures.places import Place
from shapewright.processes.external import run_program
from shapewright.processes.limits import memory_left

_FLAT = "not a 3D object"


def built(program: str, file: Path, values: Mapping[str, Any]) -> Any:
    """The mesh of a file with these values of its variables. program: the path of ``openscad``.

    Raises Infeasible where an assertion of the file fails, ProcedureError with the file's line.
    """
    import trimesh

    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "shape.off"
        given = [f"-D{name}={literal(value)}" for name, value in values.items()]
        ended = run_program([program, "-o", str(made), *given, str(file)], file.parent, memory_mb=memory_left())
        if wrong := next((line for line in ended.said if line.startswith("ERROR: ")), None):
            raise failure(file, wrong)
        for line in ended.said:
            if line.startswith("WARNING: ") and is_lacking(line):
                raise ProcedureError(*located(file, line.removeprefix("WARNING: ")))
        if any(_FLAT in line for line in ended.said):
            advice = "it is 2D, and the program openscad makes no drawings here: pip install 'shapewright[openscad]'"
            raise ProcedureError(advice, Place(str(file), None))
        if ended.status or not made.is_file():
            said = ended.last_words or f"it ended with status {ended.status}"
            raise ProcedureError(f"openscad: {said}", Place(str(file), None))
        mesh: Any = trimesh.load(made, force="mesh", process=False)
        return mesh.vertices, mesh.faces
