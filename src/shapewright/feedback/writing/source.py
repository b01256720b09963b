"""What an author's file says, as its syntax tree: functions, imports, names that are taken, what a change added."""

from __future__ import annotations

import builtins
import keyword
import re
from collections.abc import Iterator
from functools import lru_cache
from typing import Any

import libcst as cst

_BOM = "\ufeff"


class EditError(ValueError):
    """The file is written in a way that the change does not know; the message says what it looked for."""


def can_edit(source: str, procedure: str) -> bool:
    """Whether the source is that of a file with the procedure at its top level."""
    try:
        function_of(parsed(source), procedure)
    except EditError:
        return False
    return True


def free_name(source: str, procedure: str, wanted: str) -> str:
    """A name like the one wanted, free in the procedure and at the file's top level: ``shelf``, ``shelf_2``, ..."""
    taken = _taken(source, procedure)
    stem = re.sub(r"\W+", "_", wanted).strip("_").lower() or "part"
    stem = stem if stem[0].isalpha() else f"part_{stem}"
    name, number = stem, 1
    while name in taken or keyword.iskeyword(name) or hasattr(builtins, name):
        number += 1
        name = f"{stem}_{number}"
    return name


def snippet(before: str, after: str) -> str:
    """The statements at the top level of ``after`` that ``before`` has not: they run at the end of the old file."""
    old = {code(statement) for statement in parsed(before).body}
    new = [statement for statement in parsed(after).body if code(statement) not in old]
    head = [code(statement) for statement in new if imports_in(statement)]
    rest = [code(statement) for statement in new if not imports_in(statement)]
    return "\n\n\n".join(["\n".join(head), *rest] if head else rest) + "\n"


@lru_cache(maxsize=32)  # dozens of changes begin from one file
def parsed(source: str) -> cst.Module:
    try:
        return cst.parse_module(source.removeprefix(_BOM))
    except cst.ParserSyntaxError as error:
        raise EditError(f"the file is no Python: {error.message}") from error


def text_of(source: str, module: Any) -> str:
    """The text of a changed module, with the byte order mark of the source."""
    return _BOM * source.startswith(_BOM) + str(module.code)


def code(node: cst.CSTNode) -> str:
    """The text of a node, without the comments before it."""
    bare = node.with_changes(leading_lines=()) if hasattr(node, "leading_lines") else node
    return cst.Module(()).code_for_node(bare).strip()


def functions_in(module: cst.Module) -> list[cst.FunctionDef]:
    """Those at its top level."""
    return [node for node in module.body if isinstance(node, cst.FunctionDef)]


def function_of(module: cst.Module, name: str) -> cst.FunctionDef:
    found = [function for function in functions_in(module) if function.name.value == name]
    if not found:
        raise EditError(f"there is no function {name} at the top level of the file")
    return found[-1]


def imports_in(statement: cst.CSTNode) -> list[cst.Import | cst.ImportFrom]:
    body = statement.body if isinstance(statement, cst.SimpleStatementLine) else ()
    return [part for part in body if isinstance(part, cst.Import | cst.ImportFrom)]


def names_in(node: cst.CSTNode) -> Iterator[str]:
    """The names in a node that are variables: not attributes, nor keywords of calls."""
    match node:
        case cst.Name():
            yield node.value
        case cst.Attribute() | cst.Arg():
            yield from names_in(node.value)
        case _:
            for child in node.children:
                yield from names_in(child)


@lru_cache(maxsize=8)
def _taken(source: str, procedure: str) -> frozenset[str]:
    module = parsed(source)
    taken = set(names_in(function_of(module, procedure)))
    for statement in module.body:
        taken |= set(names_in(statement.name if isinstance(statement, cst.FunctionDef | cst.ClassDef) else statement))
    return frozenset(taken)
