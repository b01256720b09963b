"""The shape of an OpenSCAD file, by the package openscad-evaluator. It is imported when a shape is built."""

from __future__ import annotations

import contextlib
import gc
import io
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import manifold3d
from openscad_evaluator import EvalError, Evaluator, resolve_use_scopes
from openscad_lalr_parser import getASTfromFile
from openscad_lalr_parser.nodes import Assignment, BooleanLiteral, ListComprehension, NumberLiteral, StringLiteral

from shapewright.procedures.errors import ProcedureError
from shapewright.procedures.openscad.labels import meshed
from shapewright.procedures.openscad.messages import failure, is_lacking, located, place
from shapewright.procedures.places import Place

_SYNTAX = re.compile(r"Syntax error in (.*) at line (\d+), column \d+:\n(.*)")


class Lacking(ProcedureError):
    """A part of the shape could not be built here; another evaluator may know how."""


@dataclass(frozen=True)
class Program:
    """A file that has been parsed.

    Attributes:
        nodes: its statements, and those of the files that it includes.
        scope: what names mean in them.
        given: its assignments at the top level, by the name of the variable.
    """

    nodes: list[Any]
    scope: Any
    given: Mapping[str, Sequence[Any]]

    @contextlib.contextmanager
    def at(self, values: Mapping[str, Any]) -> Iterator[None]:
        """With these values in the place of those in the file."""
        changed = [(node, node.expr, values[name]) for name in values for node in self.given.get(name, ())]
        try:
            for node, _, value in changed:
                node.expr = _literal(value, node.position)
            yield
        finally:
            for node, expression, _ in changed:
                node.expr = expression


def evaluated(file: Path, values: Mapping[str, Any], stamp: str) -> Any:
    """The shape of a file with these values of its variables: a mesh, a cross-section, or a list of these.

    stamp: changes when the file does, or one that it uses.
    Raises Infeasible where an assertion of the file fails, Lacking, and ProcedureError with the file's line.
    """
    program = parsed(file, stamp)
    said: list[str] = []
    evaluator = Evaluator(echo_fn=said.append)
    try:
        with program.at(values):
            bodies, _ = evaluator.evaluate(program.nodes, program.scope)
    except EvalError as error:
        raise failure(file, str(error)) from error
    except RecursionError as error:
        raise ProcedureError("modules or functions call themselves without end", Place(str(file), None)) from error
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:  # of the evaluator itself
        raise Lacking(f"openscad-evaluator fails: {error}", Place(str(file), None)) from error
    warnings = [message.removeprefix("WARNING: ") for message in said if message.startswith("WARNING: ")]
    for warning in warnings:
        if is_lacking(warning):
            raise Lacking(*located(file, warning))
    bodies = [body for body in bodies if body.role not in ("background", "highlight_ghost")]
    solids = [body.body for body in bodies if body.body is not None and not body.body.is_empty()]
    sections = [body.section for body in bodies if body.section is not None and body.body is None]
    found: list[Any] = [body.raw_mesh for body in bodies if body.raw_mesh is not None]
    if solids:
        found.insert(0, meshed(manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add), evaluator))
    if not found and sections:
        return manifold3d.CrossSection.batch_boolean(sections, manifold3d.OpType.Add)
    if not found:
        message, where = located(file, warnings[0]) if warnings else ("", Place(str(file), None))
        raise ProcedureError(f"the shape is empty{message and f'; OpenSCAD says: {message}'}", where)
    return found


@lru_cache(maxsize=4)
def parsed(file: Path, stamp: str) -> Program:
    """A file's statements. stamp: see ``evaluated``.

    Raises ProcedureError for a file that cannot be parsed, or that includes one that is not there.
    """
    said = io.StringIO()
    try:
        with _uncollected(), contextlib.redirect_stdout(said):  # the parser prints what is wrong
            tree = getASTfromFile(str(file))
            nodes, _, scope = resolve_use_scopes(tree, str(file), print) if tree is not None else ([], [], None)
    except FileNotFoundError as error:
        raise Lacking(*_not_there(file, str(error))) from error
    if match := _SYNTAX.search(said.getvalue()):
        raise ProcedureError("the syntax is wrong here", Place(match[1], int(match[2]), match[3].strip() or None))
    given: dict[str, list[Any]] = {}
    for node in nodes:
        if isinstance(node, Assignment):
            given.setdefault(node.name.name, []).append(node)
    return Program(nodes, scope, given)


@contextlib.contextmanager
def _uncollected() -> Iterator[None]:
    """Without garbage collection, which would look through a large library's nodes again and again as they are made.

    A file that includes BOSL2 is read in 1.5 to 2 s of CPU then, in place of 4.2.
    """
    running = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if running:
            gc.enable()


def _not_there(file: Path, said: str) -> tuple[str, Place]:
    """What is said of a file that is included and not there, with the line that includes it where it is this file's."""
    message = said.partition("\n")[0].partition(" Searched")[0]
    name = message.partition("'")[2].rpartition("'")[0]
    lines = file.read_text("utf-8").splitlines()
    line = next((number for number, text in enumerate(lines, 1) if f"<{name}>" in text), None)
    return message, Place(str(file), None) if line is None else place(file, line)


def _literal(value: Any, position: Any) -> Any:
    if isinstance(value, bool):
        return BooleanLiteral(position=position, val=value)
    if isinstance(value, str):
        return StringLiteral(position=position, val=value.replace("\\", "\\\\").replace('"', '\\"'))
    if isinstance(value, tuple | list):
        return ListComprehension(position=position, elements=[_literal(one, position) for one in value])
    return NumberLiteral(position=position, val=float(value))
