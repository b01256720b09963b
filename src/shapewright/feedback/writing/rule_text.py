"""The code of a rule of the library, as an author would have it in the procedure's own file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import libcst as cst

from shapewright.feedback.writing.source import EditError, code, imports_in, names_in, parsed
from shapewright.rules.rule import Rule


@dataclass(frozen=True)
class RuleText:
    """The text of a rule and of what it needs.

    Attributes:
        functions: definitions, with two empty lines between them.
        imports: the names that they need, by module.
    """

    functions: str
    imports: Mapping[str, tuple[str, ...]]


@lru_cache(maxsize=128)
def rule_text(rule: Rule) -> RuleText:
    """The function of a rule without its annotations, and the functions, constants and imports of its file it uses.

    Raises EditError where the file cannot be read, or imports in a way that cannot be copied.
    """
    try:
        module = parsed(Path(rule.function.__code__.co_filename).read_text("utf-8"))
    except OSError as error:
        raise EditError(f"the file of the rule {rule.name} cannot be read: {error}") from error
    defined = {name: statement for statement in module.body for name in _defined(statement)}
    imported = {name: place for statement in module.body for name, place in _imported(statement)}
    needed = _closure(rule.name, defined)
    taken = [statement for statement in module.body if any(name in needed for name in _defined(statement))]
    plain = [_plain(statement) for statement in taken]
    used = {name for statement in plain for name in names_in(statement)}
    imports: dict[str, tuple[str, ...]] = {}
    for name in sorted(used & set(imported)):
        place, spelled = imported[name]
        imports[place] = (*imports.get(place, ()), spelled)
    return RuleText("\n\n\n".join(code(statement) for statement in plain), imports)


def _closure(name: str, defined: Mapping[str, Any]) -> set[str]:
    """The names at the file's top level that a function needs, its own with them."""
    needed, todo = {name}, [name]
    while todo:
        more = set(names_in(_plain(defined[todo.pop()]))) & set(defined) - needed
        needed |= more
        todo += sorted(more)
    return needed


def _plain(statement: Any) -> Any:
    """A function without decorators and annotations; any other statement as it is."""
    if not isinstance(statement, cst.FunctionDef):
        return statement
    params = [item.with_changes(annotation=None, equal=_tight(item)) for item in statement.params.params]
    bare = statement.with_changes(
        decorators=(), returns=None, params=cst.Parameters(params=[_in_line(item) for item in params])
    )
    return cst.ensure_type(bare, cst.FunctionDef).with_changes(
        whitespace_before_params=cst.SimpleWhitespace(""), leading_lines=()
    )


def _tight(item: cst.Param) -> Any:
    space = cst.SimpleWhitespace("")
    return cst.AssignEqual(space, space) if item.default else cst.MaybeSentinel.DEFAULT


def _in_line(item: cst.Param) -> cst.Param:
    return item.with_changes(comma=cst.MaybeSentinel.DEFAULT, whitespace_after_param=cst.SimpleWhitespace(""))


def _defined(statement: Any) -> list[str]:
    """The names that a statement at the top level defines."""
    if isinstance(statement, cst.FunctionDef | cst.ClassDef):
        return [statement.name.value]
    parts = statement.body if isinstance(statement, cst.SimpleStatementLine) else ()
    targets = [target.target for part in parts if isinstance(part, cst.Assign) for target in part.targets]
    return [name for target in targets for name in names_in(target)]


def _imported(statement: Any) -> list[tuple[str, tuple[str, str]]]:
    """The names that a statement imports, with the module and how it spells the name."""
    found = []
    for part in imports_in(statement):
        if isinstance(part, cst.ImportFrom) and part.module and not isinstance(part.names, cst.ImportStar):
            for alias in part.names:
                spelled = code(alias.with_changes(comma=cst.MaybeSentinel.DEFAULT))
                found.append((spelled.split()[-1], (code(part.module), spelled)))
    return found
