"""Changes to the text of an author's file, which leave the rest of it as it was written: a wider Range, a new rule."""

from __future__ import annotations

import ast
import builtins
import keyword
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

_LINE = 120


class EditError(ValueError):
    """The file is written in a way that the change does not know; the message says what it looked for."""


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
    """A function to add to the file, and what the procedure makes of its shape with it.

    parameters: those that are new. function: its whole text, perhaps none. call: an expression for the changed shape,
    in which ``{shape}`` stands for the shape so far. flag: an expression that says whether it is changed, None for
    always. imports: names that all of this needs, by module.
    """

    parameters: tuple[NewParameter, ...]
    function: str
    call: str
    flag: str | None
    imports: Mapping[str, tuple[str, ...]]


@dataclass(frozen=True)
class _Change:
    start: int
    end: int
    text: str


class _Text:
    """A source text with its syntax tree; places are offsets in its bytes."""

    def __init__(self, source: str) -> None:
        self.bytes = source.encode()
        self.tree = ast.parse(source)
        self.starts = [0]
        for line in self.bytes.splitlines(keepends=True):
            self.starts.append(self.starts[-1] + len(line))

    def start(self, node: ast.AST) -> int:
        return self.starts[node.lineno - 1] + node.col_offset  # type: ignore[attr-defined, no-any-return]

    def end(self, node: ast.AST) -> int:
        return self.starts[node.end_lineno - 1] + node.end_col_offset  # type: ignore[attr-defined, no-any-return]

    def of(self, node: ast.AST) -> str:
        return self.bytes[self.start(node) : self.end(node)].decode()

    def line_start(self, place: int) -> int:
        return self.bytes.rfind(b"\n", 0, place) + 1

    def line_end(self, place: int) -> int:
        found = self.bytes.find(b"\n", place)
        return len(self.bytes) if found < 0 else found

    def indent(self, place: int) -> str | None:
        """What stands before a place on its line, when that is white space only."""
        before = self.bytes[self.line_start(place) : place].decode()
        return before if not before.strip() else None

    def function(self, name: str) -> ast.FunctionDef:
        found = [node for node in self.tree.body if isinstance(node, ast.FunctionDef) and node.name == name]
        if not found:
            raise EditError(f"there is no function {name} at the top level of the file")
        return found[-1]

    def changed(self, changes: Sequence[_Change]) -> str:
        text = self.bytes
        for change in sorted(changes, key=lambda change: -change.start):
            text = text[: change.start] + change.text.encode() + text[change.end :]
        return text.decode()


def can_edit(source: str, procedure: str) -> bool:
    """Whether the source is that of a file with the procedure at its top level."""
    try:
        _Text(source).function(procedure)
    except (EditError, SyntaxError):
        return False
    return True


def with_range(
    source: str, procedure: str, parameter: str, low: str | None, high: str | None, steps: str | None
) -> str:
    """The source with other limits in a parameter's Range, or steps where it has some; what is None stays.

    Raises EditError when the signature does not spell the Range, in place or as a name given to the annotation.
    """
    text = _Text(source)
    call = _range(text, text.function(procedure), parameter)
    places = dict(zip(("low", "high", "steps"), call.args, strict=False))
    places |= {word.arg: word.value for word in call.keywords if word.arg}
    new = {"low": low, "high": high, "steps": steps}
    return text.changed(
        [
            _Change(text.start(places[key]), text.end(places[key]), value)
            for key, value in new.items()
            if value and key in places
        ]
    )


def parameter_line(source: str, procedure: str, parameter: str) -> str:
    """The lines of the signature that spell a parameter, as they stand; those of its annotation, if that has a name."""
    text = _Text(source)
    call = _range(text, text.function(procedure), parameter)
    start, end = text.line_start(text.start(call)), text.line_end(text.end(call))
    return text.bytes[start:end].decode().strip()


def with_rule(source: str, procedure: str, rule: NewRule) -> str:
    """The source with new parameters, a new function after the procedure, and its call at every return.

    Raises EditError when the procedure has no parameters or returns nothing.
    """
    text = _Text(source)
    function = text.function(procedure)
    changes = [_signature(text, function, rule.parameters), *_returns(text, function, rule)]
    if rule.function:
        place = text.line_end(text.end(function))
        changes.append(_Change(place, place, f"\n\n\n{rule.function.strip()}"))
    return _imported(text.changed(changes), rule.imports)


def snippet(before: str, after: str) -> str:
    """The statements at the top level of ``after`` that ``before`` has not: they run at the end of the old file."""
    old = {_whole(_Text(before), node) for node in ast.parse(before).body}
    text = _Text(after)
    new = [(node, statement) for node in text.tree.body if (statement := _whole(text, node)) not in old]
    head = [statement for node, statement in new if isinstance(node, ast.Import | ast.ImportFrom)]
    rest = [statement for node, statement in new if not isinstance(node, ast.Import | ast.ImportFrom)]
    return "\n\n\n".join(["\n".join(head), *rest] if head else rest) + "\n"


def free_name(source: str, procedure: str, wanted: str) -> str:
    """A name like the one wanted, free in the procedure and at the file's top level: ``shelf``, ``shelf_2``, ..."""
    text = _Text(source)
    taken = {node.id for node in ast.walk(text.function(procedure)) if isinstance(node, ast.Name)}
    taken |= {node.arg for node in ast.walk(text.function(procedure)) if isinstance(node, ast.arg)}
    for statement in text.tree.body:
        if isinstance(statement, ast.FunctionDef | ast.ClassDef):
            taken.add(statement.name)
        elif isinstance(statement, ast.Import | ast.ImportFrom):
            taken |= {alias.asname or alias.name for alias in statement.names}
        else:
            taken |= {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)}
    stem = re.sub(r"\W+", "_", wanted).strip("_").lower() or "part"
    stem = stem if stem[0].isalpha() else f"part_{stem}"
    name, number = stem, 1
    while name in taken or keyword.iskeyword(name) or hasattr(builtins, name):
        number += 1
        name = f"{stem}_{number}"
    return name


def _range(text: _Text, function: ast.FunctionDef, parameter: str) -> ast.Call:
    found = [item for item in _arguments(function) if item.arg == parameter]
    if not found or found[0].annotation is None:
        raise EditError(f"{function.name} has no annotated parameter {parameter}")
    places: list[ast.AST] = [found[0].annotation]
    named = {node.id for node in ast.walk(found[0].annotation) if isinstance(node, ast.Name)}
    places += [
        statement.value
        for statement in text.tree.body
        if isinstance(statement, ast.Assign)
        and any(isinstance(target, ast.Name) and target.id in named for target in statement.targets)
    ]
    for place in places:
        for node in ast.walk(place):
            if isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1] == "Range":
                return node
    raise EditError(f"the annotation of {parameter} spells no Range(low, high)")


def _arguments(function: ast.FunctionDef) -> list[ast.arg]:
    return [*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs]


def _signature(text: _Text, function: ast.FunctionDef, parameters: Sequence[NewParameter]) -> _Change:
    """The new parameters behind the last one: on lines of their own where that has one."""
    items = _arguments(function)
    if not items:
        raise EditError(f"{function.name} has no parameters")
    defaults = [*function.args.defaults, *(default for default in function.args.kw_defaults if default)]
    end = max(text.end(node) for node in [*items, *defaults])
    start = text.start(items[-1])
    indent = text.indent(start)
    if indent is None:
        column = " " * (text.start(items[0]) - text.line_start(text.start(items[0])))
        return _Change(end, end, "".join(f",\n{column}{parameter}" for parameter in parameters))
    comma, after = _comma(text.bytes, end)
    lines = "".join(f"\n{indent}{parameter}," for parameter in parameters)
    if not comma:
        return _Change(end, end, "," + lines[:-1])
    place = text.line_end(after)
    return _Change(place, place, lines)


def _comma(source: bytes, place: int) -> tuple[bool, int]:
    """Whether a comma follows, after white space and comments; and the place behind it."""
    found = re.compile(rb"(?:\s|#[^\n]*)*,").match(source, place)
    return (True, found.end()) if found else (False, place)


def _returns(text: _Text, function: ast.FunctionDef, rule: NewRule) -> Iterator[_Change]:
    statements = [node for node in _own(function) if isinstance(node, ast.Return) and node.value is not None]
    if not statements:
        raise EditError(f"{function.name} returns nothing")
    for statement in statements:
        assert statement.value is not None
        start, end = text.start(statement), text.end(statement)
        expression = text.bytes[start + len("return") : end].decode().strip()
        indent = text.indent(start)
        if indent is None:
            yield _Change(start, end, f"return {_one_line(rule, f'({expression})')}")
            continue
        named = isinstance(statement.value, ast.Name)
        name = expression if named else _kept(statement.value) or "shape"
        lines = [] if named else [f"{name} = {expression}"]
        returned = f"return {_one_line(rule, name)}"
        if len(indent) + len(returned) <= _LINE or not rule.flag:
            lines.append(returned)
        else:
            lines.append(f"if {rule.flag}:")
            assignment = f"    {name} = {rule.call.format(shape=name)}"
            if len(indent) + len(assignment) > _LINE:
                opened, arguments = assignment[:-1].split("(", 1)
                inner = f"\n{indent}        "
                if len(inner) + len(arguments) > _LINE:
                    arguments = f",{inner}".join(arguments.split(", ")) + ","
                assignment = f"{opened}({inner}{arguments}\n{indent}    )"
            lines += [assignment, f"return {name}"]
        yield _Change(start, end, f"\n{indent}".join(lines))


def _one_line(rule: NewRule, shape: str) -> str:
    call = rule.call.format(shape=shape)
    return f"{call} if {rule.flag} else {shape}" if rule.flag else call


def _kept(value: ast.expr) -> str | None:
    """The name in ``changed(name, ...) if flag else name``, as earlier changes leave it."""
    if isinstance(value, ast.IfExp) and isinstance(value.orelse, ast.Name):
        return value.orelse.id
    if isinstance(value, ast.Call) and value.args and isinstance(value.args[0], ast.Name):
        return value.args[0].id
    return None


def _own(function: ast.FunctionDef) -> Iterator[ast.AST]:
    """The nodes of a function that are not in functions or classes inside it."""
    stack: list[ast.AST] = list(function.body)
    while stack:
        node = stack.pop()
        yield node
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda | ast.ClassDef):
            stack.extend(ast.iter_child_nodes(node))


def _imported(source: str, imports: Mapping[str, tuple[str, ...]]) -> str:
    """The source with these names imported, in the statements that import from the module already where there are."""
    for module, names in imports.items():
        text = _Text(source)
        bound = {
            alias.asname or alias.name
            for node in text.tree.body
            if isinstance(node, ast.ImportFrom)
            for alias in node.names
        }
        missing = [name for name in names if name not in bound]
        if not missing:
            continue
        same = [
            node
            for node in text.tree.body
            if isinstance(node, ast.ImportFrom) and node.module == module and not node.level
        ]
        if same:
            have = [f"{a.name} as {a.asname}" if a.asname else a.name for a in same[0].names]
            source = text.changed(
                [_Change(text.start(same[0]), text.end(same[0]), _statement(module, [*have, *missing]))]
            )
        else:
            source = text.changed([_new_import(text, _statement(module, missing))])
    return source


def _statement(module: str, names: Sequence[str]) -> str:
    ordered = sorted(names, key=lambda name: (name[0].islower(), name.lower()))
    line = f"from {module} import {', '.join(ordered)}"
    if len(line) <= _LINE:
        return line
    return f"from {module} import (\n" + "".join(f"    {name},\n" for name in ordered) + ")"


def _new_import(text: _Text, statement: str) -> _Change:
    """Behind the last import at the top of the file, else behind its docstring, else first of all."""
    imports = [node for node in text.tree.body if isinstance(node, ast.Import | ast.ImportFrom)]
    if imports:
        place = text.line_end(text.end(imports[-1]))
        return _Change(place, place, f"\n{statement}")
    first = text.tree.body[0]
    if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and isinstance(first.value.value, str):
        place = text.line_end(text.end(first))
        return _Change(place, place, f"\n\n{statement}")
    return _Change(0, 0, f"{statement}\n\n")


def _whole(text: _Text, node: ast.stmt) -> str:
    """The text of a statement with its decorators."""
    decorators = node.decorator_list if isinstance(node, ast.FunctionDef | ast.ClassDef) else []
    start = text.line_start(min(text.start(each) for each in [node, *decorators]))
    return text.bytes[start : text.end(node)].decode()
