"""A function that is called in another Python, with its own libraries: a process of it stays and builds them."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from shapewright.commands.function import arguments
from shapewright.commands.results import shape_of
from shapewright.commands.spec import Spec
from shapewright.procedures import ProcedureError
from shapewright.processes.external import words_of
from shapewright.processes.resident import Gone, Resident
from shapewright.shapes import Shape

_PROGRAM = Path(__file__).with_name("caller.py")
_INFINIGEN = ("infinigen2", "procfunc", "bpy")
"""Packages that come with Infinigen 2, which wants a Python of its own."""
_kept: dict[tuple[str | None, str], Resident] = {}
"""The processes that were started, by their Python and what they call: libraries take seconds to load."""


def call_elsewhere(spec: Spec, values: dict[str, Any]) -> Shape:
    """The shape. Raises Infeasible where a constraint does not hold, ProcedureError with what went wrong there."""
    given = arguments(spec, values)
    request: dict[str, Any] = {"arguments": {name: value for name, value in given.items() if name not in spec.draws}}
    if spec.draws:
        drawn = {draw.key: draw.given(given[name]) for name, draw in spec.draws.items()}
        request["draws"] = {"values": drawn, "seed": request["arguments"].pop("rng", 0)}
    with tempfile.TemporaryDirectory(prefix="shapewright-") as folder:
        started, out = time.time(), Path(folder) / "out.obj"
        answer = ask(spec, {**request, "out": str(out)})
        return shape_of(Path(answer["file"]), spec.facts, started, spec.place, answer.get("up"))


def ask(spec: Spec, request: Mapping[str, Any]) -> Mapping[str, Any]:
    """The answer of its Python. Raises ProcedureError with what went wrong there."""
    try:
        answer = _resident(spec).ask(request).header
    except Gone as gone:
        status, said = gone.ended.status, gone.ended.last_words
        how = f"its Python ended while it built ({words_of(status)})" if status is not None else "its Python ended"
        raise ProcedureError(f"{said}; {how}" if said else how, spec.place, "crash") from gone
    if "error" in answer:
        raise _error(answer, spec)
    return answer


def _resident(spec: Spec) -> Resident:
    key = (spec.python, spec.target)
    if key not in _kept or not _kept[key].alive:
        home = str(spec.file.path.parent)
        request = {"target": spec.target, "home": home, "environment": dict(spec.environment)}
        try:
            made = Resident([str(spec.python), str(_PROGRAM)], request)
        except OSError as error:
            raise ProcedureError(f"{spec.python} cannot be started: {error.strerror}", spec.place) from error
        if "error" in made.first.header:
            made.stop()
            raise _error(made.first.header, spec)
        _kept[key] = made
    return _kept[key]


def _error(answer: Mapping[str, Any], spec: Spec) -> ProcedureError:
    said = answer["error"]
    if answer.get("missing") in _INFINIGEN:
        said += (
            "; make one that has it: python3.11 -m venv infinigen && infinigen/bin/pip install infinigen==2.0.0a3; "
            'then say: python = "infinigen/bin/python"'
        )
    return ProcedureError(said, spec.place)
