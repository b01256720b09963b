"""A program that makes a shape of parameters: called as an author's function is, once for each shape."""

from __future__ import annotations

import inspect
import json
import shlex
import sys
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from shapewright.commands.results import shape_of
from shapewright.commands.spec import PLACES, Spec, filled, placeholders
from shapewright.procedures import Infeasible, Place, ProcedureError
from shapewright.processes.external import run_program, words_of
from shapewright.shapes import Shape

SHELL = ("sh", "-c")


@dataclass(frozen=True)
class Command:
    """The program of a spec.

    spec: what it says of the program.
    """

    spec: Spec

    @property
    def __name__(self) -> str:
        return self.spec.name

    @property
    def __signature__(self) -> inspect.Signature:
        return inspect.Signature(self.spec.entries.parameters)

    @property
    def own_names(self) -> Mapping[str, str]:
        """What the tool calls its parameters."""
        return self.spec.entries.names

    @property
    def place(self) -> Place | None:
        """The line that says what is run."""
        return self.spec.place

    def __call__(self, **values: Any) -> Shape:
        """Run the program in a folder of its own, which is removed, and read the file that it leaves.

        Raises Infeasible where a constraint does not hold, or the program says so; ProcedureError for anything else
        that goes wrong, with what the program said.
        """
        given = arguments(self.spec, values)
        with tempfile.TemporaryDirectory(prefix="shapewright-") as temporary:
            folder = Path(temporary)
            (folder / "params.json").write_text(json.dumps(given), encoding="utf-8")
            out = folder / (self.spec.out or _out_name(self.spec))
            started = time.time()
            self._run(folder, {**values, **given})
            return shape_of(out, self.spec.facts, started, self.place)

    def _run(self, folder: Path, values: dict[str, Any]) -> None:
        spec = self.spec
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
            raise ProcedureError(f"{words[0]} cannot be started: {_why(error)}", self.place) from error
        if ended.status is None:
            raise ProcedureError(f"it took longer than {spec.seconds:g} s", self.place, "time")
        if ended.status == spec.infeasible:
            raise Infeasible(ended.said[-1] if ended.said else "the program says so")
        if ended.status != 0:
            told = ended.last_words or "it said nothing"
            raise ProcedureError(f"the program failed: {told} ({words_of(ended.status)})", self.place, "crash")


def arguments(spec: Spec, values: dict[str, Any]) -> dict[str, Any]:
    """What the tool gets, by the names that it knows. Raises Infeasible where a constraint does not hold."""
    for constraint in spec.constraints:
        if not constraint(values):
            raise Infeasible(f"it does not hold that {constraint.text}")
    return {spec.entries.names[name]: value for name, value in values.items()} | dict(spec.entries.fixed)


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
