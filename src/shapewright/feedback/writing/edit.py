"""Changes of an author's file by its syntax tree, which leave every other byte: another Range, a new rule."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import libcst as cst
from libcst.metadata import MetadataWrapper, PositionProvider

from shapewright.feedback.writing.source import EditError, code, function_of, imports_in, names_in, parsed, text_of

_SHAPE = "shape"  # what the whole shape is called in changed returns
_LINE = 120  # characters: what this project's style allows (pyproject.toml)


@dataclass(frozen=True)
class NewParameter:
    """A parameter to add to the signature, as text: ``shelf_level: Annotated[float, Range(0, 1)] = 0.5``."""

    name: str
    annotation: str
    default: str

    def __str__(self) -> str:
        return f"{self.name}: {self.annotation} = {self.default}"


@dataclass(frozen=True)
class NewRule:
    """A function to add to the file, and what the procedure makes of its shape with it."""

    parameters: tuple[NewParameter, ...]  # the new ones
    function: str  # its whole text; empty where the call needs none
    call: str  # an expression for the changed shape, in which ``{shape}`` stands for the shape before
    flag: str | None  # an expression that says whether the shape changes; None for always
    imports: Mapping[str, tuple[str, ...]]  # the names that all of this needs, by module


def with_range(
    source: str, procedure: str, parameter: str, low: str | None, high: str | None, steps: str | None
) -> str:
    """The source with other limits in a parameter's Range, or steps where it has some; what is None stays.

    Raises EditError when the signature does not spell the Range, in place or as a name given to the annotation.
    """
    module = parsed(source)
    call = _range(module, function_of(module, procedure), parameter)
    new, places = {"low": low, "high": high, "steps": steps}, ("low", "high", "steps", "when")
    arguments = []
    for place, argument in zip(places, call.args, strict=False):
        value = new.get(argument.keyword.value if argument.keyword else place)
        arguments.append(argument.with_changes(value=cst.parse_expression(value)) if value else argument)
    return text_of(source, module.deep_replace(call, call.with_changes(args=arguments)))


def parameter_line(source: str, procedure: str, parameter: str) -> str:
    """The lines of the signature that spell a parameter; those of its annotation, if that has a name."""
    module = parsed(source)
    call = _range(module, function_of(module, procedure), parameter)
    place: Any = MetadataWrapper(module, unsafe_skip_copy=True).resolve(PositionProvider)[call]
    return "\n".join(re.split("\r?\n", source)[place.start.line - 1 : place.end.line]).strip()


def with_rule(source: str, procedure: str, rule: NewRule) -> str:
    """The source with new parameters, a new function after the procedure, and its call at every return.

    Raises EditError when the procedure has no parameters or returns nothing.
    """
    module = parsed(source)
    function = function_of(module, procedure)
    returns = _Returns(rule, module.default_indent)
    changed = function.with_changes(params=_signature(function, rule.parameters), body=function.body.visit(returns))
    if not returns.found:
        raise EditError(f"{procedure} returns nothing")
    there = {code(statement) for statement in module.body}  # a rule of the library may be there from an earlier change
    added = [statement for statement in cst.parse_module(rule.function.strip()).body if code(statement) not in there]
    if added:
        added[0] = added[0].with_changes(leading_lines=[cst.EmptyLine(indent=False)] * 2)
    place = module.body.index(function)
    body = [*module.body[:place], changed, *added, *module.body[place + 1 :]]
    for name, names in rule.imports.items():
        body = _imported(body, name, names)
    return text_of(source, module.with_changes(body=body))


def _range(module: cst.Module, function: cst.FunctionDef, parameter: str) -> cst.Call:
    """The call of Range in the annotation of a parameter, or in what a name in the annotation stands for."""
    items = [*function.params.posonly_params, *function.params.params, *function.params.kwonly_params]
    annotation = next((item.annotation for item in items if item.name.value == parameter), None)
    if annotation is None:
        raise EditError(f"{function.name.value} has no annotated parameter {parameter}")
    named = set(names_in(annotation))
    lines = [part for line in module.body if isinstance(line, cst.SimpleStatementLine) for part in line.body]
    aliases = [part for part in lines if isinstance(part, cst.Assign)]
    places = [part.value for part in aliases if any(named & set(names_in(target)) for target in part.targets)]
    for place in (annotation, *places):
        if call := _call_of_range(place):
            return call
    raise EditError(f"the annotation of {parameter} spells no Range(low, high)")


def _call_of_range(node: cst.CSTNode) -> cst.Call | None:
    if isinstance(node, cst.Call) and code(node.func).split(".")[-1] == "Range":
        return node
    return next((call for child in node.children if (call := _call_of_range(child))), None)


def _signature(function: cst.FunctionDef, parameters: Sequence[NewParameter]) -> cst.Parameters:
    """The parameters and new ones behind the last, each on a line of its own below the first."""
    kinds = ("kwonly_params", "params", "posonly_params")
    kind = next((kind for kind in kinds if getattr(function.params, kind)), None)
    if kind is None:
        raise EditError(f"{function.name.value} has no parameters")
    before = function.whitespace_before_params
    indent = before.last_line.value if isinstance(before, cst.ParenthesizedWhitespace) else ""
    column = cst.SimpleWhitespace(indent or " " * len(f"def {function.name.value}("))
    below = head = cst.ParenthesizedWhitespace(last_line=column)
    *others, last = getattr(function.params, kind)
    comma = last.comma if isinstance(last.comma, cst.Comma) else None
    tail = comma.whitespace_after if comma else last.whitespace_after_param
    if isinstance(tail, cst.ParenthesizedWhitespace):  # a comment behind the last one stays there
        head, tail = below.with_changes(first_line=tail.first_line), tail.with_changes(first_line=below.first_line)
    between = (comma or cst.Comma()).with_changes(whitespace_after=head)
    last = last.with_changes(comma=between, whitespace_after_param=cst.SimpleWhitespace(""))
    stub: Any = cst.parse_statement(f"def f({', '.join(map(str, parameters))}): ...")
    *new, end = stub.params.params
    new = [item.with_changes(comma=cst.Comma(whitespace_after=below)) for item in new]
    closing = {"comma": cst.Comma(whitespace_after=tail)} if comma else {"whitespace_after_param": tail}
    return function.params.with_changes(**{kind: [*others, last, *new, end.with_changes(**closing)]})


class _Returns(cst.CSTTransformer):
    """Puts a rule's call at every return of a function's body, not of functions inside it."""

    def __init__(self, rule: NewRule, indent: str) -> None:
        super().__init__()
        self.rule, self.indent = rule, indent
        self.column, self.found = 0, False

    def on_visit(self, node: cst.CSTNode) -> bool:
        if isinstance(node, cst.IndentedBlock):
            self.column += len(node.indent or self.indent)
        return not isinstance(node, cst.FunctionDef | cst.ClassDef | cst.BaseExpression)

    def on_leave(self, original_node: cst.CSTNode, updated_node: Any) -> Any:
        match updated_node:
            case cst.IndentedBlock():
                self.column -= len(updated_node.indent or self.indent)
            case cst.SimpleStatementLine(body=[cst.Return(value=cst.BaseExpression() as value)]):
                self.found = True
                return cst.FlattenSentinel(self._statements(updated_node, value))
            case cst.SimpleStatementLine(body=[*before, last]) | cst.SimpleStatementSuite(body=[*before, last]):
                if isinstance(last, cst.Return) and last.value:
                    self.found = True
                    call: Any = cst.parse_statement(f"return {self._call(f'({code(last.value)})')}")
                    return updated_node.with_changes(body=[*before, *call.body])
        return updated_node

    def _statements(self, line: cst.SimpleStatementLine, value: cst.BaseExpression) -> list[Any]:
        """The statements that return what the rule makes of a value."""
        name = _SHAPE  # never another name of the author's: what it stands for stays as it is
        statements: list[Any] = list(cst.parse_module(self._text(name)).body)
        if not (isinstance(value, cst.Name) and value.value == name):
            return [line.with_changes(body=[cst.Assign([cst.AssignTarget(cst.Name(name))], value)]), *statements]
        statements[0] = statements[0].with_changes(leading_lines=line.leading_lines)
        statements[-1] = statements[-1].with_changes(trailing_whitespace=line.trailing_whitespace)
        return statements

    def _call(self, shape: str) -> str:
        call = self.rule.call.format(shape=shape)
        return f"{call} if {self.rule.flag} else {shape}" if self.rule.flag else call

    def _text(self, name: str) -> str:
        """Lines that return what the rule makes of a shape with a name, as short as there is room."""
        room, returned = _LINE - self.column, f"return {self._call(name)}"
        if len(returned) <= room or not self.rule.flag:
            return returned
        assignment = f"    {name} = {self.rule.call.format(shape=name)}"
        if len(assignment) > room:
            opened, arguments = assignment[:-1].split("(", 1)
            if len(arguments) + 8 >= room:
                arguments = arguments.replace(", ", ",\n        ") + ","
            assignment = f"{opened}(\n        {arguments}\n    )"
        return f"if {self.rule.flag}:\n{assignment}\nreturn {name}"


def _imported(body: Sequence[Any], module: str, names: Sequence[str]) -> list[Any]:
    """The statements with these names imported: in the import from the module that is there, or in a new one."""
    places = [(place, part) for place, statement in enumerate(body) for part in imports_in(statement)]
    aliases: set[str] = set()
    bound: set[str] = set()
    own = -1
    for place, part in places:
        if isinstance(part, cst.ImportFrom) and not isinstance(part.names, cst.ImportStar):
            spelled = {code(name.with_changes(comma=cst.MaybeSentinel.DEFAULT)) for name in part.names}
            bound |= {name.split()[-1] for name in spelled}
            text = code(part)
            alone = len(body[place].body) == 1 and "#" not in text  # what else the line says stays
            if own < 0 and alone and text.startswith(f"from {module} "):
                own, aliases = place, spelled
    missing = set(names) - bound
    if not missing:
        return list(body)
    ordered = sorted(missing | aliases, key=lambda name: (name[0].islower(), name.lower()))
    line = f"from {module} import {', '.join(ordered)}"
    if len(line) > _LINE:
        line = f"from {module} import (\n" + "".join(f"    {name},\n" for name in ordered) + ")"
    statement: Any = cst.parse_statement(line)
    if own >= 0:
        return [*body[:own], body[own].with_changes(body=statement.body), *body[own + 1 :]]
    place = places[-1][0] + 1 if places else int(cst.Module(body).get_docstring() is not None)
    return [*body[:place], statement, *body[place:]]
