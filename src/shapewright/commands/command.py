"""A program that makes a shape of parameters: run once for each shape."""

from __future__ import annotations

import json
import shlex
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from shapewright.commands.function import arguments
from shapewright.commands.results import shape_of
from shapewright.commands.spec import PLACES, Spec, filled, placeholders
from shapewright.procedures import Infeasible, ProcedureError
from shapewright.processes.external import run_program, words_of
from shapewright.shapes import Shape

SHELL = ("sh", "-c")


def run(spec: Spec, values: dict[str, Any]) -> Shape:
    """Run the program in a folder of its own, which is removed, and read the file that it leaves.

    Raises Infeasible where a constraint does not hold, or the program says so; ProcedureError for anything else that
    goes wrong, with what the program said.
    """
    given = arguments(spec, values)
    with tempfile.TemporaryDirectory(prefix="shapewright-") as temporary:
        folder = Path(temporary)
        (folder / "params.json").write_text(json.dumps(given), encoding="utf-8")
        out = folder / (spec.out or _out_name(spec))
        started = time.time()
        _run(spec, folder, {**values, **given})
        return shape_of(out, spec.facts, started, spec.place)


def _run(spec: Spec, folder: Path, values: dict[str, Any]) -> None:
    places = dict(zip(PLACES, (str(spec.file.path.parent), sys.executable), strict=True))
    known = {**values, **places, "params.json": str(folder / "params.json")}
    known |= {name: str(folder / name) for name in placeholders(spec.words) if name.startswith("out.")}
    if spec.shell:
        words = [*SHELL, filled(spec.words[0], {name: _quoted(value) for name, value in known.items()})]
    else:
        words = [*([spec.python] if spec.python else []), *(filled(word, known) for word in spec.words)]
    try:
        ended = run_program(words, folder, spec.seconds, spec.memory_mb, spec.environment)
    except OSError as error:
        raise ProcedureError(f"{words[0]} cannot be started: {_why(error)}", spec.place) from error
    if ended.status is None:
        raise ProcedureError(f"it took longer than {spec.seconds:g} s", spec.place, "time")
    if ended.status == spec.infeasible:
        raise Infeasible(ended.said[-1] if ended.said else "the program says so")
    if ended.status != 0:
        told = ended.last_words or "it said nothing"
        raise ProcedureError(f"the program failed: {told} ({words_of(ended.status)})", spec.place, "crash")


def _out_name(spec: Spec) -> str:
    return next(name for name in placeholders(spec.words) if name.startswith("out."))


def _quoted(value: Any) -> str:
    return shlex.quote(str(value).lower() if isinstance(value, bool) else str(value))


def _why(error: OSError) -> str:
    if isinstance(error, FileNotFoundError):
        return "there is no such program on the path, and no such file beside the spec"
    if isinstance(error, PermissionError):
        return "it may not be run; a script needs its interpreter before it: sh script.sh, python3 script.py"
    return error.strerror or str(error)
