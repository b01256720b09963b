"""The parameters of a spec: what a table says of one, as the annotation that a Python author would write."""

from __future__ import annotations

import difflib
import inspect
import keyword
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, Literal

from shapewright.parameters import Range, When
from shapewright.parameters.expressions import Expression
from shapewright.procedures.annotations import SignatureError, read

KEYS = frozenset(
    {"range", "choices", "bool", "integer", "log", "step", "steps", "default", "description", "when", "fixed"}
)
"""What a table may say of a parameter."""
_MOST_STEPS = 10_000


@dataclass(frozen=True)
class Entries:
    """The parameters of a spec.

    Attributes:
        parameters: those of the space, as they stand in a signature.
        names: the name that the tool knows for the name of each in the signature.
        fixed: values that the tool always gets, by its names.
    """

    parameters: tuple[inspect.Parameter, ...] = ()
    names: Mapping[str, str] = field(default_factory=dict)
    fixed: Mapping[str, Any] = field(default_factory=dict)


class EntryError(ValueError):
    """A table says something wrong of a parameter. name: of the parameter; key: that is wrong, None for all of it."""

    def __init__(self, name: str, key: str | None, message: str) -> None:
        super().__init__(message)
        self.name, self.key = name, key


def entries_of(tables: Mapping[str, Any]) -> Entries:
    """The parameters that tables describe, by the names that the tool knows; see docs/generators.md for the keys.

    A value that is no table is fixed. Raises EntryError.
    """
    names: dict[str, str] = {}
    fixed: dict[str, Any] = {}
    parameters = []
    for own, table in tables.items():
        if not isinstance(table, Mapping) or "fixed" in table:
            fixed[own] = table["fixed"] if isinstance(table, Mapping) else table
            continue
        name = identifier(own)
        if name in names:
            raise EntryError(own, None, f"it has the same name as {names[name]!r} in Python: {name}; rename one")
        names[name] = own
        parameters.append(_parameter(own, name, table))
    _check_conditions(parameters, names, tables)
    return Entries(tuple(parameters), names, fixed)


def identifier(name: str) -> str:
    """The name of a parameter as Python can have it: ``Legs Type`` becomes ``Legs_Type``."""
    plain = re.sub(r"\W|^(?=\d)", "_", name)
    return f"{plain}_" if keyword.iskeyword(plain) or plain.startswith("__") else plain or "_"


def _parameter(own: str, name: str, table: Mapping[str, Any]) -> inspect.Parameter:
    if unknown := next((key for key in table if key not in KEYS), None):
        near = difflib.get_close_matches(unknown, KEYS, 1)
        advice = f"did you mean {near[0]}?" if near else f"there are {', '.join(sorted(KEYS))}"
        raise EntryError(own, unknown, f"there is no such key; {advice}")
    for key in ("bool", "integer", "log"):
        if not isinstance(table.get(key, False), bool):
            raise EntryError(own, key, f"{table[key]!r} is not true or false")
    kinds = [key for key in ("range", "choices", "bool") if key in table and table[key] is not False]
    if len(kinds) != 1:
        raise EntryError(own, None, "say one of: range = [low, high], choices = [...], bool = true, fixed = value")
    annotation = _annotation(own, table)
    default = table.get("default", inspect.Parameter.empty)
    if kinds == ["bool"] and not isinstance(table.get("default", False), bool):
        raise EntryError(own, "default", f"{default!r} is not true or false")
    try:
        read(name, annotation, None if default is inspect.Parameter.empty else default, "default" not in table)
    except (SignatureError, ValueError, TypeError) as error:
        key = "default" if "default" in str(error) else "steps" if "steps" in str(error) else kinds[0]
        raise EntryError(
            own, key, str(error).removeprefix(f"parameter {name!r}: ").removeprefix(f"{name}: ")
        ) from error
    if "description" in table:
        annotation = Annotated[annotation, str(table["description"])]
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


def _annotation(own: str, table: Mapping[str, Any]) -> Any:
    condition = None
    if "when" in table:
        try:
            condition = Expression(str(table["when"]))
        except ValueError as error:
            raise EntryError(own, "when", str(error)) from error
    if "range" in table:
        low, high = _numbers(own, "range", table["range"], 2)
        limits = Range(low, high, _steps(own, table, low, high), condition, bool(table.get("log", False)))
        return Annotated[int if table.get("integer") else float, limits]
    kind: Any = bool
    if "choices" in table:
        choices = table["choices"]
        if not isinstance(choices, list) or len(choices) < 2:
            raise EntryError(own, "choices", "a list of two values or more")
        kind = Literal[tuple(choices)]
    return Annotated[kind, When(condition)] if condition else kind


def _numbers(own: str, key: str, value: Any, count: int | None = None) -> list[float]:
    numbers = isinstance(value, list) and all(isinstance(v, int | float) and not isinstance(v, bool) for v in value)
    if not numbers or (count is not None and len(value) != count):
        wanted = "[low, high]" if count else "a list of numbers"
        raise EntryError(own, key, f"{value!r} is not {wanted}")
    return list(value)


def _steps(own: str, table: Mapping[str, Any], low: float, high: float) -> int | tuple[float, ...] | None:
    """How many steps there are, or the values themselves: from the lower end on, a step after the other."""
    if "steps" in table:
        steps = table["steps"]
        return steps if isinstance(steps, int) else tuple(_numbers(own, "steps", steps))
    if "step" not in table:
        return None
    step = table["step"]
    if isinstance(step, bool) or not isinstance(step, int | float) or step <= 0.0:
        raise EntryError(own, "step", f"{step!r} is no number above 0")
    if table.get("integer") and step == 1:
        return None
    count = int((high - low) / step + 1e-9) + 1
    if not 2 <= count <= _MOST_STEPS:
        raise EntryError(own, "step", f"it gives {count} values in the range; there may be 2 to {_MOST_STEPS}")
    return tuple(round(low + i * step, 12) for i in range(count))


def _check_conditions(parameters: list[inspect.Parameter], names: Mapping[str, str], tables: Mapping[str, Any]) -> None:
    for parameter in parameters:
        table = tables[names[parameter.name]]
        if "when" in table:
            unknown = [name for name in Expression(str(table["when"])).names if name not in names]
            if unknown:
                raise EntryError(
                    names[parameter.name], "when", f"there is no parameter {unknown[0]!r}; there are {', '.join(names)}"
                )
