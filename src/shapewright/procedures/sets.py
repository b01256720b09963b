"""Parameters that a file lists: OpenSCAD's parameter sets, a table in CSV, the manifest of samples."""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from shapewright.parameters import Binary, Choice, Integer, Parameter, Parameters, Scalar, Value
from shapewright.procedures.annotations import AXES
from shapewright.procedures.errors import ProcedureError
from shapewright.procedures.forms import SETS
from shapewright.procedures.places import Place
from shapewright.procedures.procedure import Procedure

_YES, _NO = ("true", "1", "yes", "1.0"), ("false", "0", "no", "0.0")


@dataclass(frozen=True)
class Sets:
    """What a file lists.

    Attributes:
        vectors: parameters by the name of their shape, which may be empty.
        held: names in the file that stay at the procedure's defaults: they have no Range.
    """

    vectors: tuple[tuple[str, Parameters], ...]
    held: tuple[str, ...] = ()


@dataclass(frozen=True)
class _Row:
    """name: for errors; label: its own name, or empty; place: where it stands; values: as the file has them."""

    name: str
    label: str
    place: Place
    values: Mapping[str, Any]


def read_sets(path: Path, procedure: Procedure, ignored: Collection[str] = ()) -> Sets:
    """Read parameters of a procedure, those that are left out at their defaults.

    Names are those of the space, or of the procedure's own program. Raises ProcedureError, with the row, for a name
    that is not known, a value that cannot be read or lies outside its Range.

    Args:
        path: a JSON or CSV file.
        procedure: whose parameters they are.
        ignored: columns that are none.
    """
    try:
        text = path.read_text("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise ProcedureError(f"{path}: it cannot be read: {error}") from error
    rows = list(_json(path, text) if path.suffix.lower() == ".json" else _csv(path, text))
    if not rows:
        raise ProcedureError(f"{path}: it lists no parameters")
    own = {own: name for name, own in procedure.own_names.items()}
    held: dict[str, None] = {}
    vectors = []
    for row in rows:
        values = dict(procedure.space.defaults)
        for key, value in _spread(row.values, own, procedure.space.names):
            name = key if key in values else re.sub(r"[^\w.]", "_", key)
            if name in values:
                values[name] = _value(procedure.space[name], value, row)
            elif name in procedure.signature.fixed:
                held[name] = None
            elif key not in ignored:
                known = ", ".join(procedure.space.names)
                raise ProcedureError(f"{row.name}: there is no parameter {key!r}; there are {known}", row.place)
        vectors.append((row.label, values))
    return Sets(tuple(vectors), tuple(held))


def _json(path: Path, text: str) -> Iterator[_Row]:
    try:
        found = json.loads(text)
    except json.JSONDecodeError as error:
        raise ProcedureError(f"no JSON: {error.msg}", Place(str(path), error.lineno)) from error
    sets = found.get(SETS, found) if isinstance(found, dict) else found
    named = list(sets.items()) if isinstance(sets, dict) else [(f"{i}", each) for i, each in enumerate(sets, 1)]
    lines = text.splitlines()
    for name, values in named:
        if not isinstance(values, dict):
            raise ProcedureError(f'{path}: {name}: no parameters; write {{"{SETS}": {{"name": {{"width": "2"}}}}}}')
        line = next(
            (i for i, line in enumerate(lines, 1) if re.match(rf"\s*{re.escape(json.dumps(name))}\s*:", line)), None
        )
        yield _Row(f"set {name}", name if isinstance(sets, dict) else "", Place(str(path), line), values)


def _csv(path: Path, text: str) -> Iterator[_Row]:
    reader = csv.reader(io.StringIO(text, newline=""))
    header = [name.strip() for name in next(reader, [])]
    for number, cells in enumerate(reader, 1):
        if not any(cell.strip() for cell in cells):
            continue
        row = f"row {number}"
        if len(cells) != len(header):
            place = Place(str(path), reader.line_num)
            raise ProcedureError(f"{row}: it has {len(cells)} values, and the header {len(header)} names", place)
        values = dict(zip(header, cells, strict=True))
        name = values.pop("name", "") or Path(values.get("path", "")).stem
        yield _Row(f"{row} ({name})" if name else row, name, Place(str(path), reader.line_num), values)


def _spread(values: Mapping[str, Any], own: Mapping[str, str], names: tuple[str, ...]) -> Iterator[tuple[str, Any]]:
    """The values by the names of the space; a vector value by value."""
    for key, value in values.items():
        name = own.get(key, key)
        if f"{name}.x" not in names or name in names:
            yield name, value
            continue
        parts = (
            json.loads(value) if isinstance(value, str) and re.fullmatch(r"\s*\[[-+\d.eE,\s]*\]\s*", value) else value
        )
        if isinstance(parts, list):
            yield from ((f"{name}.{axis}", part) for axis, part in zip(AXES, parts, strict=False))
        else:
            yield f"{name}.x", value


def _value(parameter: Parameter, value: Any, row: _Row) -> Value:
    """A value of a parameter. Raises ProcedureError where it is none."""
    text = str(value).strip()
    if isinstance(parameter, Binary):
        if text.lower() in (*_YES, *_NO):
            return text.lower() in _YES
        raise _refused(parameter, value, row, "is not true or false")
    if isinstance(parameter, Choice):
        option = next((option for option in parameter.options if value == option or text == str(option)), None)
        if option is None:
            option = next((o for o in parameter.options if not isinstance(o, str) and _number(text) == o), None)
        if option is None:
            raise _refused(parameter, value, row, f"is none of {', '.join(map(str, parameter.options))}")
        return option
    number = _number(text)
    if number is None or isinstance(value, bool):
        raise _refused(parameter, value, row, "is no number")
    if not parameter.low <= number <= parameter.high:
        raise _refused(parameter, value, row, f"lies outside {parameter.low:g} to {parameter.high:g}")
    if isinstance(parameter, Integer) or (isinstance(parameter, Scalar) and parameter.whole):
        if number != int(number):
            raise _refused(parameter, value, row, "is no whole number")
        return int(number)
    return number


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _refused(parameter: Parameter, value: Any, row: _Row, why: str) -> ProcedureError:
    return ProcedureError(f"{row.name}: {parameter.name} = {value} {why}", row.place)
