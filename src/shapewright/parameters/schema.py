"""A parameter space as a JSON Schema."""

from __future__ import annotations

import linecache
from collections.abc import Iterable
from types import CodeType
from typing import Any

from shapewright.parameters.kinds import Binary, Choice, Condition, Parameter, Scalar

DIALECT = "https://json-schema.org/draft/2020-12/schema"


def schema_of(parameters: Iterable[Parameter]) -> dict[str, Any]:
    """An object with a property for each parameter: type, limits, default.

    What JSON Schema has no word for is under ``x-``: ``x-steps``, the values that a number is sampled at or how many;
    ``x-scale``, "log"; ``x-when``, the author's condition as text, "..." where it is not known.
    """
    properties = {parameter.name: _property(parameter) for parameter in parameters}
    return {"$schema": DIALECT, "type": "object", "properties": properties, "additionalProperties": False}


def condition_text(condition: Condition) -> str:
    """The expression of a lambda as the author wrote it, or a function's name; "..." where it is not on one line.

    A condition with an attribute ``text`` has that text.
    """
    if isinstance(text := getattr(condition, "text", None), str):
        return text
    code: CodeType | None = getattr(condition, "__code__", None)
    if code is None or code.co_name != "<lambda>":
        return code.co_name if code else "..."
    places = [place for place in code.co_positions() if place[2] != place[3]]  # others are of no text
    if len({line for first, last, *_ in places for line in (first, last)}) != 1:
        return "..."
    line = linecache.getline(code.co_filename, places[0][0] or 0).encode()  # columns count bytes
    return line[min(place[2] or 0 for place in places) : max(place[3] or 0 for place in places)].decode() or "..."


def _property(parameter: Parameter) -> dict[str, Any]:
    if isinstance(parameter, Binary):
        found: dict[str, Any] = {"type": "boolean"}
    elif isinstance(parameter, Choice):
        found = {"enum": list(parameter.options)}
    else:
        found = {"type": "integer" if parameter.whole else "number"}
        found |= {"minimum": parameter.low, "maximum": parameter.high}
    if isinstance(parameter, Scalar) and parameter.steps is not None:
        found["x-steps"] = parameter.steps if isinstance(parameter.steps, int) else list(parameter.steps)
    if isinstance(parameter, Scalar) and parameter.log:
        found["x-scale"] = "log"
    if parameter.when is not None:
        found["x-when"] = condition_text(parameter.when)
    return found | {"default": parameter.default}
