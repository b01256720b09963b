"""A procedure of a spec, for ``load_procedure``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from shapewright.commands.call import call, called
from shapewright.commands.command import run
from shapewright.commands.drawn import with_draws
from shapewright.commands.elsewhere import call_elsewhere
from shapewright.commands.function import Function
from shapewright.commands.spec import read_spec
from shapewright.procedures import Procedure


def read(path: Path, name: str | None) -> Procedure:
    """The procedure of a TOML file. name: it gets, if any. Raises ProcedureError with the line where it is wrong."""
    spec = read_spec(path)
    if spec.drawn:
        spec = with_draws(spec)
    if name is not None:
        spec = replace(spec, name=name)
    if spec.target and not spec.python:
        called(spec)  # what is not there says so now
    make = run if not spec.target else call_elsewhere if spec.python else call
    procedure = Procedure(Function(spec, make), facts=spec.facts)
    procedure.helpers, procedure.seconds = spec.helpers, spec.seconds
    return procedure
