"""Ranges that stand in files of other programs, as the tables of a spec: GeoCode's recipes, PyTorchGeoNodes' JSON.

GeoCode (github.com/threedle/GeoCode, dataset_generator/recipe_files): ``dataset_generation`` has min, max and samples
of each parameter, or of each axis of a vector; ``base`` the defaults; ``data_types`` the kinds, where its program wrote
the recipe; ``visibility_conditions`` say when parameters matter whose names contain a word; ``constraints`` are what
has to hold.

PyTorchGeoNodes (github.com/vevenom/pytorchgeonodes, configs_shape_programs): ``params`` are nested tables with type and
range, whose upper end an integer does not reach; ``or_dependencies`` name what has to be on, or to have a value, one of
them; ``not_dependencies`` what has to be off. Its own program only orders its search by them.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from shapewright.commands.entries import identifier
from shapewright.parameters.expressions import Expression
from shapewright.procedures import Place, ProcedureError

_SWITCH = re.compile(r"(?:is|has)_")
"""How names of GeoCode's parameters begin that are on or off, in recipes without data_types."""


@dataclass(frozen=True)
class Recipe:
    """What another program's file says of a space.

    Attributes:
        tables: of the parameters, as ``entries_of`` takes them.
        constraints: what has to hold.
    """

    tables: Mapping[str, Any]
    constraints: tuple[Expression, ...] = ()


def read_recipe(path: Path) -> Recipe:
    """Read ranges. Raises ProcedureError where the file cannot be read, or has another form."""
    values = _parsed(path)
    try:
        if isinstance(values, dict) and isinstance(values.get("dataset_generation"), dict):
            return _geocode(values)
        if isinstance(values, dict) and isinstance(values.get("params"), dict):
            return _geonodes(values["params"])
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise ProcedureError(f"{path}: it cannot be understood: {type(error).__name__}: {error}") from error
    raise ProcedureError(
        f"{path}: no ranges are found; a recipe of GeoCode has dataset_generation, a shape program of PyTorchGeoNodes "
        "has params"
    )


def _parsed(path: Path) -> Any:
    try:
        text = path.read_text("utf-8")
        if path.suffix.lower() == ".json":
            return json.loads(text)
        try:
            import yaml
        except ImportError as error:
            raise ProcedureError(f"{path}: YAML needs another package; install it with: pip install pyyaml") from error
        try:
            return yaml.safe_load(text)
        except yaml.MarkedYAMLError as error:
            line = error.problem_mark.line + 1 if error.problem_mark else None
            raise ProcedureError(f"no YAML: {error.problem}", Place(str(path), line)) from error
    except json.JSONDecodeError as error:
        raise ProcedureError(f"no JSON: {error.msg}", Place(str(path), error.lineno)) from error
    except (OSError, UnicodeDecodeError) as error:
        raise ProcedureError(f"{path}: it cannot be read: {error}") from error


def _geocode(recipe: Mapping[str, Any]) -> Recipe:
    base, kinds = recipe.get("base", {}), recipe.get("data_types", {})
    known = set(recipe["dataset_generation"])
    tables: dict[str, Any] = {}
    for name, limits in recipe["dataset_generation"].items():
        kind = kinds.get(name, {}).get("type")
        default = base.get(name)
        if "min" in limits:
            tables[name] = _geocode_table(name, limits, kind, default)
        else:
            for axis, own in limits.items():
                inner = default.get(axis) if isinstance(default, Mapping) else None
                tables[f"{name} {axis}"] = _geocode_table(name, own, kind, inner)
    for name, table in tables.items():
        conditions = recipe.get("visibility_conditions") or {}
        text = next((str(text) for part, text in conditions.items() if part in name), None)
        if text is not None:
            table["when"] = _renamed(text, known)
    rules = (recipe.get("constraints") or {}).values()
    return Recipe(tables, tuple(Expression(_renamed(str(rule), known)) for rule in rules))


def _geocode_table(name: str, limits: Mapping[str, Any], kind: str | None, default: Any) -> dict[str, Any]:
    low, high = limits["min"], limits["max"]
    whole = kind in ("Integer", "Boolean") or (kind is None and isinstance(low, int) and "samples" not in limits)
    if whole and (low, high) == (0, 1) and (kind == "Boolean" or (kind is None and _SWITCH.match(name))):
        return {"bool": True} | ({} if default is None else {"default": bool(default)})
    table: dict[str, Any] = {"range": [low, high]}
    if whole:
        table["integer"] = True
    elif "samples" in limits:
        table["steps"] = limits["samples"]
    if default is not None:
        table["default"] = min(max(default, low), high)  # recipes keep numbers of 32 bits, which pass an end a little
    return table


def _renamed(text: str, known: set[str]) -> str:
    """A condition with the names of a signature in place of the tool's."""
    for name in sorted(known, key=len, reverse=True):
        if not name.isidentifier():
            text = text.replace(name, identifier(name))
    return text


def _geonodes(params: Mapping[str, Any]) -> Recipe:
    leaves = dict(_leaves(params))
    return Recipe({name: _geonodes_table(leaf, leaves) for name, leaf in leaves.items()})


def _leaves(params: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    for name, entry in params.items():
        if entry["type"] == "nested":
            yield from _leaves(entry["params"])
        else:
            yield name, entry


def _geonodes_table(entry: Mapping[str, Any], leaves: Mapping[str, Any]) -> dict[str, Any]:
    if entry["type"] == "bool":
        table: dict[str, Any] = {"bool": True}
    elif entry["type"] == "float":
        table = {"range": list(entry["range"])}
    elif entry["type"] == "int":
        values = list(entry["valid_values"]) if "valid_values" in entry else list(range(*entry["range"]))
        even = len(values) > 1 and values == list(range(values[0], values[-1] + 1))
        table = {"fixed": values[0]} if len(values) == 1 else {"choices": values}
        if even:
            table = {"range": [values[0], values[-1]], "integer": True}
    else:
        raise ValueError(f"type {entry['type']!r} is none of float, int, bool, nested")
    on = [_depends(each) for each in entry.get("or_dependencies", []) if _name(each) in leaves]
    off = [f"not {_depends(each)}" for each in entry.get("not_dependencies", []) if _name(each) in leaves]
    conditions = [f"({' or '.join(on)})" if off and len(on) > 1 else " or ".join(on)] if on else []
    if (conditions := [*conditions, *off]) and "fixed" not in table:
        table["when"] = " and ".join(conditions)
    return table


def _name(dependency: Any) -> str:
    return str(dependency[0] if isinstance(dependency, list) else dependency)


def _depends(dependency: Any) -> str:
    if isinstance(dependency, list):
        return f"{identifier(str(dependency[0]))} == {dependency[1]!r}"
    return identifier(str(dependency))
