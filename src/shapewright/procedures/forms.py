"""Parameters as other programs and people write them: a call in Python, OpenSCAD's -D and sets, Blender, a CSV."""

from __future__ import annotations

import csv
import io
import json
import shlex
from collections.abc import Mapping
from enum import Enum
from typing import Any, Literal, TypeAlias

from shapewright.parameters import Parameters
from shapewright.procedures.errors import ProcedureError
from shapewright.procedures.openscad.text import literal
from shapewright.procedures.procedure import Procedure

Form: TypeAlias = Literal["python", "openscad", "blender", "json", "csv"]
SETS, VERSION = "parameterSets", {"fileFormatVersion": "1"}
"""Keys of a file of OpenSCAD's parameter sets, as its Customizer writes them."""


def written(procedure: Procedure, sets: Mapping[str, Parameters], form: Form) -> str:
    """Parameters by the name of their shape, as text of some lines.

    python: a call of the procedure's function for each, its name behind it. openscad: the arguments of ``openscad`` for
    each, its name above them. blender: a script that makes an object for each. json: parameter sets of OpenSCAD's
    Customizer. csv: a row for each, with a header. Parameters have the names that the procedure's own program knows.
    Raises ProcedureError for a script of Blender where the procedure is no node group.
    """
    if form == "csv":
        table = io.StringIO(newline="")
        names = procedure.space.names
        rows = [[name, *(_plain(values[key]) for key in names)] for name, values in sets.items()]
        csv.writer(table, lineterminator="\n").writerows([["name", *(_own(procedure, key) for key in names)], *rows])
        return table.getvalue()
    arguments = {name: procedure.signature.arguments(values) for name, values in sets.items()}
    if form == "blender":
        script = getattr(procedure.function, "script", None)
        if script is None:
            raise ProcedureError(
                "the form blender is for node groups of .blend files; use another one", procedure.place
            )
        return str(script(arguments))
    if form == "python":
        calls = [f"{procedure.name}({_keywords(given)})  # {name}" for name, given in arguments.items()]
        return "".join(f"{call}\n" for call in calls)
    if form == "openscad":
        return "".join(f"# {name}\n{_definitions(procedure, given)}\n" for name, given in arguments.items())
    found = {
        name: {_own(procedure, key): _unquoted(value) for key, value in given.items()}
        for name, given in arguments.items()
    }
    return json.dumps({SETS: found, **VERSION}, indent=4, ensure_ascii=False) + "\n"


def _own(procedure: Procedure, name: str) -> str:
    return procedure.own_names.get(name, name)


def _keywords(given: Mapping[str, Any]) -> str:
    return ", ".join(f"{name}={_python(value)}" for name, value in given.items())


def _python(value: Any) -> str:
    if isinstance(value, Enum):
        return f"{type(value).__name__}.{value.name}"
    if type(value) is tuple:
        return f"({', '.join(map(_python, value))}{',' if len(value) == 1 else ''})"
    return repr(value)


def _definitions(procedure: Procedure, given: Mapping[str, Any]) -> str:
    return " ".join(f"-D {shlex.quote(f'{_own(procedure, name)}={literal(v)}')}" for name, v in given.items())


def _unquoted(value: Any) -> str:
    """As a parameter set has it: text without quotation marks."""
    text = value.name if isinstance(value, Enum) else value
    return text if isinstance(text, str) else literal(text)


def _plain(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
