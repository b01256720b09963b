"""A spec: the TOML file in which an author says how a program makes shapes of parameters."""

from __future__ import annotations

import difflib
import re
import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from shapewright.commands.entries import Entries, EntryError, entries_of
from shapewright.commands.procfunc.drawn_space import Draw
from shapewright.commands.recipes import Recipe, read_recipe
from shapewright.commands.toml_files import TomlFile, read_toml
from shapewright.parameters.expressions import Expression
from shapewright.procedures import Facts, Place

PLACEHOLDER = re.compile(r"\{([^{}]*)\}")
"""What is filled in for each shape."""
PLACES = ("here", "python")
"""Placeholders of the folder of the spec, and of the Python that runs shapewright."""
KINDS: Mapping[str, tuple[type, ...]] = {
    "run": (str, list),
    "call": (str,),
    "python": (str,),
    "shell": (bool,),
    "out": (str,),
    "infeasible": (int,),
    "seconds": (int, float),
    "memory": (int,),
    "environment": (dict,),
    "name": (str,),
    "up": (str,),
    "unit": (str,),
    "size": (str,),
    "ranges": (str,),
    "parameters": (dict, str),
    "constraints": (list,),
}
"""The keys of a spec, and what their values are."""
_SAID = {str: "text", list: "a list", bool: "true or false", int: "a whole number", float: "a number", dict: "a table"}


@dataclass(frozen=True)
class Spec:
    """What a spec says.

    Attributes:
        file: the file itself.
        name: of the procedure.
        words: the program and its arguments, with placeholders; with ``shell`` one line for the shell. Empty of a call.
        target: ``module:name`` of what is called in Python; empty of a command.
        python: the Python that runs it, where it is another one than this.
        entries: the parameters.
        facts: up, unit and size.
        shell: whether the shell gets the line.
        out: name of the file that it leaves, where no placeholder says it.
        infeasible: exit status that says that parameters have no shape.
        seconds: wall time that a shape may take; None where the settings say it.
        memory_mb: megabytes that the program may write to; None without a limit.
        environment: variables that it gets.
        constraints: conditions without which parameters have no shape.
        place: the line that says what is run.
        helpers: the files that it names.
        drawn: whether its parameters are what the function draws at random.
        draws: these, by the names of the parameters, where they are known.
    """

    file: TomlFile
    name: str
    words: tuple[str, ...]
    target: str
    python: str | None
    entries: Entries
    facts: Facts
    shell: bool = False
    out: str | None = None
    infeasible: int | None = None
    seconds: float | None = None
    memory_mb: int | None = None
    environment: Mapping[str, str] = field(default_factory=dict)
    constraints: tuple[Expression, ...] = ()
    place: Place | None = None
    helpers: tuple[Path, ...] = ()
    drawn: bool = False
    draws: Mapping[str, Draw] = field(default_factory=dict)


def read_spec(path: Path, draws: Mapping[str, Draw] | None = None) -> Spec:
    """Read a spec. draws: what its function draws, where it is known. Raises ProcedureError with the line in error."""
    file = read_toml(path)
    said = file.values
    _check_keys(file)
    key = "run" if "run" in said else "call"
    recipe, recipe_files = _recipe(file)
    drawn = _is_drawn(said)
    unread = drawn and not draws
    if draws:
        drawn_tables = {name: draw.table for name, draw in draws.items()}
        recipe = replace(recipe or Recipe({}), tables={**drawn_tables, **(recipe.tables if recipe else {})})
    entries = _entries(file, recipe, may_be_empty=unread)
    words = _words(file) if key == "run" else ()
    spec = Spec(
        file=file,
        name=said.get("name", re.sub(r"\W", "_", path.stem)),
        words=words if said.get("shell") else tuple(_found(path.parent, word) for word in words),
        target=said.get("call", ""),
        python=_found(path.parent, said["python"]) if "python" in said else None,
        entries=entries,
        facts=_facts(file),
        shell=said.get("shell", False),
        out=said.get("out"),
        infeasible=said.get("infeasible"),
        seconds=said.get("seconds"),
        memory_mb=said.get("memory"),
        environment={name: str(value) for name, value in said.get("environment", {}).items()},
        constraints=(
            *(recipe.constraints if recipe else ()),
            *(() if unread else _constraints(file, entries)),
        ),
        place=file.place((key,)),
        helpers=tuple(dict.fromkeys([*_named(path.parent, words, said.get("call", "")), *recipe_files])),
        drawn=drawn,
        draws=draws or {},
    )
    if key == "run":
        _check_placeholders(spec)
    elif not re.fullmatch(r"[\w.]+:[\w.]+", spec.target):
        raise file.error(("call",), f'{spec.target!r} is no function; write "module:name"')
    return spec


def _check_keys(file: TomlFile) -> None:
    for key, value in file.values.items():
        if key not in KINDS:
            near = difflib.get_close_matches(key, KINDS, 1)
            advice = f"did you mean {near[0]}?" if near else f"there are {', '.join(KINDS)}"
            raise file.error((key,), f"there is no such key; {advice}")
        if not isinstance(value, KINDS[key]) or (isinstance(value, bool) and bool not in KINDS[key]):
            raise file.error((key,), f"{value!r} is not {' or '.join(_SAID[kind] for kind in KINDS[key])}")
    if ("run" in file.values) == ("call" in file.values):
        message = 'say what is run: run = "tool {params.json} {out.obj}", or call = "module:function"'
        raise file.error(("call",) if "call" in file.values else (), f"{message}; one of them")
    for key in ("seconds", "memory"):
        if file.values.get(key, 1) <= 0:
            raise file.error((key,), f"{file.values[key]} is not above 0")


def _named(home: Path, words: Sequence[str], target: str) -> list[Path]:
    """The files beside the spec that it names: words of the program, or the module that is called."""
    module = home / f"{target.partition(':')[0].replace('.', '/')}.py"
    return [home / word for word in words if _beside(home, word)] + ([module] if target and module.is_file() else [])


def _recipe(file: TomlFile) -> tuple[Recipe | None, list[Path]]:
    """The ranges that stand in another file, and that file."""
    key = "ranges" if "ranges" in file.values else "parameters"
    named = file.values.get(key)
    if not isinstance(named, str):
        return None, []
    path = (file.path.parent / named).resolve()
    if not path.is_file():
        raise file.error((key,), f"there is no file {path}")
    return read_recipe(path), [path]


def _is_drawn(said: Mapping[str, Any]) -> bool:
    """Whether a function has no ranges beside it, or the name by which procfunc's functions say that they draw."""
    beside = said.get("parameters", {})
    ranges = isinstance(beside, str) or any(
        isinstance(table, dict) and "fixed" not in table for table in beside.values()
    )
    return "python" in said and (said.get("call", "").endswith("_rand") or not (ranges or "ranges" in said))


def _entries(file: TomlFile, recipe: Recipe | None, may_be_empty: bool = False) -> Entries:
    said = file.values.get("parameters", {})
    tables = {**(recipe.tables if recipe else {}), **(said if isinstance(said, dict) else {})}
    try:
        entries = entries_of(tables)
    except EntryError as error:
        where = ("parameters", error.name, *([error.key] if error.key else []))
        raise file.error(where, str(error)) from error
    if not entries.parameters and not may_be_empty:
        raise file.error(
            ("parameters",), "no parameter has a range; write [parameters] and: width = { range = [1, 2] }"
        )
    return entries


def _facts(file: TomlFile) -> Facts:
    given = {key: file.values[key] for key in ("up", "unit", "size") if key in file.values}
    try:
        return Facts(**given)
    except ValueError as error:
        raise file.error((str(error).partition("=")[0],), str(error)) from error


def _constraints(file: TomlFile, entries: Entries) -> list[Expression]:
    found = []
    for text in file.values.get("constraints", []):
        try:
            expression = Expression(str(text))
        except ValueError as error:
            raise file.error(("constraints",), str(error)) from error
        if unknown := [name for name in expression.names if name not in entries.names]:
            raise file.error(("constraints",), f"there is no parameter {unknown[0]!r}")
        found.append(expression)
    return found


def _words(file: TomlFile) -> tuple[str, ...]:
    line = file.values["run"]
    if file.values.get("shell"):
        if not isinstance(line, str):
            raise file.error(("run",), "with shell = true it is one line of text")
        return (line,)
    try:
        words = shlex.split(line) if isinstance(line, str) else [str(word) for word in line]
    except ValueError as error:
        raise file.error(("run",), f"{line!r}: {str(error).lower()}") from error
    if not words:
        raise file.error(("run",), "it names no program")
    return tuple(words)


def _beside(home: Path, word: str) -> bool:
    """Whether a word names a file in the folder of the spec."""
    return not PLACEHOLDER.search(word) and not Path(word).is_absolute() and (home / word).is_file()


def _found(home: Path, word: str) -> str:
    """The word as the program finds it: a file beside the spec by its whole path, since it runs in another folder."""
    return str((home / word).absolute()) if _beside(home, word) else word


def _check_placeholders(spec: Spec) -> None:
    found = placeholders(spec.words)
    known = {*spec.entries.names, *spec.entries.names.values(), *spec.entries.fixed, *PLACES, "params.json"}
    if unknown := [name for name in found if name not in known and not name.startswith("out.")]:
        fillings = ", ".join(
            f"{{{name}}}" for name in ("params.json", "out.obj", *PLACES, *spec.entries.names.values())
        )
        raise spec.file.error(("run",), f"nothing is known of {{{unknown[0]}}}; there are {fillings}")
    outs = [name for name in found if name.startswith("out.")]
    if bool(outs) == bool(spec.out) or len(outs) > 1:
        raise spec.file.error(
            ("out",) if spec.out else ("run",),
            'say once which file it writes: {out.obj} in run, or out = "model.stl" where it has a name of its own',
        )
    if not {"params.json"} & set(found) and not set(found) & {*spec.entries.names, *spec.entries.names.values()}:
        raise spec.file.error(("run",), "it gets no parameters; write {params.json}, or names such as {width}")


def placeholders(words: Sequence[str]) -> list[str]:
    """The names in braces, in order, each once."""
    return list(dict.fromkeys(name for word in words for name in PLACEHOLDER.findall(word)))


def filled(word: str, values: Mapping[str, Any]) -> str:
    """A word with its placeholders filled; true and false as JSON and OpenSCAD spell them."""
    return PLACEHOLDER.sub(lambda found: _spelled(values[found[1]]), word)


def _spelled(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
