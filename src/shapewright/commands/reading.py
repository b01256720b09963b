"""A procedure of a spec, for ``load_procedure``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from shapewright.commands.call import Call, called
from shapewright.commands.command import Command
from shapewright.commands.elsewhere import Elsewhere
from shapewright.commands.spec import read_spec
from shapewright.procedures import Procedure


def read(path: Path, name: str | None) -> Procedure:
    """The procedure of a TOML file. name: it gets, if any. Raises ProcedureError with the line where it is wrong."""
    spec = read_spec(path)
    if name is not None:
        spec = replace(spec, name=name)
    if spec.target and not spec.python:
        called(spec)  # what is not there says so now
    kind = Command if not spec.target else Elsewhere if spec.python else Call
    procedure = Procedure(kind(spec), facts=spec.facts)
    procedure.helpers, procedure.seconds = spec.helpers, spec.seconds
    return procedure
