"""The shape of an OpenSCAD file, by the package openscad-evaluator. It is imported when a shape is built."""

from __future__ import annotations

import contextlib
import io
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from shapewright.procedures.errors import ProcedureError
from shapewright.procedures.places import Place

_WHERE = re.compile(r" in file (.*?), line (\d+)")
_SYNTAX = re.compile(r"Syntax error in (.*) at line (\d+), column \d+:\n(.*)")


def evaluated(file: Path, values: Mapping[str, Any]) -> Any:
    """The bodies of a file with these values of its variables. Raises ProcedureError."""
    import manifold3d
    from openscad_evaluator import EvalError, Evaluator, resolve_use_scopes
    from openscad_lalr_parser import getASTfromFile

    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        nodes = getASTfromFile(str(file))
    if nodes is None:
        raise _syntax(file, said.getvalue())
    nodes = [_replaced(node, values) for node in nodes]
    nodes, _, scope = resolve_use_scopes(nodes, str(file), print)
    warnings: list[str] = []
    try:
        bodies, _ = Evaluator(echo_fn=warnings.append).evaluate(nodes, scope)
    except EvalError as error:
        raise _located(file, str(error)) from error
    solids = [body.body for body in bodies if body.body is not None]
    return manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add)


def _replaced(node: Any, values: Mapping[str, Any]) -> Any:
    import dataclasses

    from openscad_lalr_parser.nodes import Assignment

    if isinstance(node, Assignment) and node.name.name in values:
        return dataclasses.replace(node, expr=_literal(values[node.name.name], node.position))
    return node


def _literal(value: Any, position: Any) -> Any:
    from openscad_lalr_parser.nodes import BooleanLiteral, ListComprehension, NumberLiteral, StringLiteral

    if isinstance(value, bool):
        return BooleanLiteral(position=position, val=value)
    if isinstance(value, str):
        return StringLiteral(position=position, val=value)
    if isinstance(value, tuple | list):
        return ListComprehension(position=position, elements=[_literal(one, position) for one in value])
    return NumberLiteral(position=position, val=float(value))


def _located(file: Path, message: str) -> ProcedureError:
    head = message.splitlines()[0].removeprefix("ERROR: ")
    if not (match := _WHERE.search(head)):
        return ProcedureError(head, Place(str(file), None))
    return ProcedureError(head[: match.start()], Place(str(Path(match[1]).resolve()), int(match[2])))


def _syntax(file: Path, said: str) -> ProcedureError:
    if match := _SYNTAX.search(said):
        return ProcedureError("syntax error", Place(match[1], int(match[2]), match[3].strip()))
    return ProcedureError(said.strip() or "syntax error", Place(str(file), None))
