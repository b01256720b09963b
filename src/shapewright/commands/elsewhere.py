"""A function that is called in another Python, with its own libraries: a process of it stays and builds them."""

from __future__ import annotations

import inspect
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from shapewright.commands.command import arguments
from shapewright.commands.results import shape_of
from shapewright.commands.spec import Spec
from shapewright.procedures import Place, ProcedureError
from shapewright.processes.external import words_of
from shapewright.processes.resident import Gone, Resident
from shapewright.shapes import Shape

_PROGRAM = Path(__file__).with_name("caller.py")
_kept: dict[tuple[str | None, str], Resident] = {}
"""The processes that were started, by their Python and what they call: libraries take seconds to load."""


@dataclass(frozen=True)
class Elsewhere:
    """What a spec calls, in the Python that it names.

    spec: what it says of the call.
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
        """The line that says what is called."""
        return self.spec.place

    def __call__(self, **values: Any) -> Shape:
        """The shape. Raises Infeasible where a constraint does not hold, ProcedureError with what went wrong there."""
        given = arguments(self.spec, values)
        with tempfile.TemporaryDirectory(prefix="shapewright-") as folder:
            started, out = time.time(), Path(folder) / "out.obj"
            try:
                answer = self._resident().ask({"arguments": given, "out": str(out)}).header
            except Gone as gone:
                status, said = gone.ended.status, gone.ended.last_words
                how = (
                    f"its Python ended while it built ({words_of(status)})"
                    if status is not None
                    else "its Python ended"
                )
                raise ProcedureError(f"{said}; {how}" if said else how, self.place, "crash") from gone
            if "error" in answer:
                raise ProcedureError(answer["error"], self.place)
            return shape_of(Path(answer["file"]), self.spec.facts, started, self.place)

    def _resident(self) -> Resident:
        spec = self.spec
        key = (spec.python, spec.target)
        if key not in _kept or not _kept[key].alive:
            home = str(spec.file.path.parent)
            request = {"target": spec.target, "home": home, "environment": dict(spec.environment)}
            try:
                made = Resident([str(spec.python), str(_PROGRAM)], request)
            except OSError as error:
                raise ProcedureError(f"{spec.python} cannot be started: {error.strerror}", self.place) from error
            if "error" in made.first.header:
                made.stop()
                raise ProcedureError(made.first.header["error"], self.place)
            _kept[key] = made
        return _kept[key]
