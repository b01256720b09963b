"""What the source calls a random draw."""

from __future__ import annotations

import ast
import functools
from dataclasses import dataclass

Position = tuple[int, int | None]
"""The line and the column where a call ends, as ``ast`` has them; no column where it was made before Python 3.11."""


@dataclass(frozen=True)
class Site:
    """What stands around a call.

    Attributes:
        name: the variable or the argument that gets its value, alone or in an expression; "" where none does.
        function: that it is in; "" where it is in none.
        choice: where the call of ``choice`` ends among whose options it stands; None where it stands in none.
        option: the index of that option.
        options: the variables that the options of a choice are, "" for those that are none.
    """

    name: str = ""
    function: str = ""
    choice: Position | None = None
    option: int = 0
    options: tuple[str, ...] = ()


def site(text: str, end: Position) -> Site:
    """What the source says around the call that ends there. Nothing where the text has no such call."""
    parents, calls = _read(text)
    call = calls.get(end) or next((found for (line, _), found in calls.items() if end == (line, None)), None)
    if call is None:
        return Site()
    name: str | None = None
    function, choice, option = "", None, 0
    inner: ast.AST = call
    while (outer := parents.get(inner)) is not None and not function:
        if isinstance(outer, ast.FunctionDef | ast.AsyncFunctionDef):
            function = outer.name
        elif isinstance(outer, ast.Call) and choice is None and _called(outer) == "choice":
            choice = (outer.end_lineno or 0, outer.end_col_offset)
            option = next((i for i, each in enumerate(_options(outer)) if call in ast.walk(each)), 0)
        elif name is None:
            name = _given(outer, inner)
        inner = outer
    own = [each.elts[0] if isinstance(each, ast.Tuple) else each for each in _options(call)]
    options = tuple(each.id if isinstance(each, ast.Name) else "" for each in own) if _called(call) == "choice" else ()
    return Site(name or "", function, choice, option, options)


@functools.lru_cache(maxsize=64)
def _read(text: str) -> tuple[dict[ast.AST, ast.AST], dict[Position, ast.Call]]:
    """The node around each node, and the calls by where they end."""
    tree = ast.parse(text)
    parents = {inner: outer for outer in ast.walk(tree) for inner in ast.iter_child_nodes(outer)}
    calls = {(c.end_lineno or 0, c.end_col_offset): c for c in ast.walk(tree) if isinstance(c, ast.Call)}
    return parents, dict(calls)


def _called(call: ast.Call) -> str:
    return call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")


def _options(choice: ast.Call) -> list[ast.expr]:
    lists = [each for each in [*choice.args, *(k.value for k in choice.keywords)] if isinstance(each, ast.List)]
    return lists[0].elts if lists else []


def _given(outer: ast.AST, inner: ast.AST) -> str | None:
    """The name that a node gives to what stands in it, "" where it gives none and no node around it does."""
    if isinstance(outer, ast.keyword):
        return outer.arg or ""
    if isinstance(outer, ast.NamedExpr | ast.AnnAssign | ast.AugAssign):
        return _target(outer.target)
    if isinstance(outer, ast.Assign):
        return _target(outer.targets[0])
    if isinstance(outer, ast.Tuple) and len(outer.elts) > 1:
        return None
    return "" if isinstance(outer, ast.Return) else None


def _target(target: ast.AST) -> str:
    return target.id if isinstance(target, ast.Name) else target.attr if isinstance(target, ast.Attribute) else ""
