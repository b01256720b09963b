"""An OpenSCAD file as a procedure."""

from __future__ import annotations

import inspect
import keyword
import re
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, Any

from shapewright.procedures.annotations import SignatureError
from shapewright.procedures.annotations import read as read_argument
from shapewright.procedures.errors import ProcedureError
from shapewright.procedures.facts import Facts
from shapewright.procedures.openscad.binary import built
from shapewright.procedures.openscad.customizer import AnnotationError, Setting, settings
from shapewright.procedures.openscad.messages import place
from shapewright.procedures.openscad.text import Text
from shapewright.procedures.places import Place
from shapewright.procedures.procedure import Procedure
from shapewright.procedures.texts import source_digest

FACTS: Mapping[str, Any] = {"up": "z", "unit": "mm"}
"""OpenSCAD has no unit of its own; what reads its files takes millimetres. A line of the file may say others."""
_FACTS = re.compile(r"\s*shapewright:(.*)")
_PACKAGE, _PROGRAM = "openscad_evaluator", "openscad"
_SHOWN = 3


@dataclass(frozen=True)
class Model:
    """An OpenSCAD file that is called with values of its parameters.

    Attributes:
        file: the file.
        name: of the procedure.
        arguments: its parameters; those without annotation are held.
        own_names: what the file calls the parameters whose name is none in Python.
        stamp: changes when the file does, or one that it uses.
    """

    file: Path
    name: str
    arguments: inspect.Signature
    own_names: Mapping[str, str]
    stamp: str

    @property
    def __name__(self) -> str:
        return self.name

    @property
    def __signature__(self) -> inspect.Signature:
        return self.arguments

    @property
    def place(self) -> Place:
        return Place(str(self.file), None)

    def __call__(self, **values: Any) -> Any:
        """The shape at these values, by the program ``openscad`` where the package is missing, or lacks something.

        Raises Infeasible where an assertion fails, ProcedureError with the line of the file that is at fault.
        """
        named = {self.own_names.get(name, name): value for name, value in values.items()}
        if find_spec(_PACKAGE) is None and (program := shutil.which(_PROGRAM)):
            return built(program, self.file, named)
        from shapewright.procedures.openscad.evaluation import Lacking, evaluated

        try:
            return evaluated(self.file, named, self.stamp)
        except Lacking:
            if program := shutil.which(_PROGRAM):
                return built(program, self.file, named)
            raise


def read(path: Path, name: str | None) -> Procedure:
    """The procedure of a file. name: what it is called; by default as the file is.

    Raises ProcedureError where an annotation is no space, nothing has one, or no evaluator is installed.
    """
    try:
        text = path.read_text("utf-8")
        found = settings(text)
    except UnicodeDecodeError as error:
        raise ProcedureError(f"{path}: cannot be read as UTF-8 text: {error}") from error
    except AnnotationError as error:
        raise ProcedureError(str(error), place(path, error.line)) from error
    if not any(setting.hint for setting in found):
        raise ProcedureError(_no_space(found), place(path, found[0].line) if found else Place(str(path), None))
    items = [_parameter(path, setting) for setting in found]
    pairs = ((item.name, setting.name) for item, setting in zip(items, found, strict=True))
    strange = {python: own for python, own in pairs if python != own}
    used = tuple(sorted(_used(path)))
    stamp = source_digest(repr([(file, file.read_bytes()) for file in (path, *used)]))
    _check(path, stamp)
    model = Model(path, name or path.stem, inspect.Signature(items), strange, stamp)
    made = Procedure(model, facts=_facts(path, Text.of(text)))
    made.helpers = used
    return made


def _parameter(path: Path, setting: Setting) -> inspect.Parameter:
    """An argument for a setting. Raises ProcedureError where it cannot be one."""
    name = setting.name if setting.name.isidentifier() and not keyword.iskeyword(setting.name) else f"_{setting.name}"
    spelled = inspect.Parameter.empty if setting.hint is None else setting.hint
    if setting.hint is not None:
        try:
            read_argument(name, setting.hint, setting.value, missing=False)
        except (ValueError, SignatureError) as error:
            message = str(error).replace("the default", "the value").replace("Range(", "its annotation (")
            raise ProcedureError(f"{message}; change one of the two", place(path, setting.line)) from error
        if setting.description:
            spelled = Annotated[spelled, setting.description]
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=setting.value, annotation=spelled)


def _facts(path: Path, text: Text) -> Facts:
    """Those of ``// shapewright: size=given``. Raises ProcedureError for others than there are."""
    found = Facts(**FACTS)
    for comment in text.comments:
        if match := _FACTS.fullmatch(comment.text):
            try:
                found = Facts.written(match[1], vars(found))
            except ValueError as error:
                advice = "write for example: // shapewright: up=z, unit=mm, size=given"
                raise ProcedureError(f"{error}; {advice}", place(path, text.line(comment.start))) from error
    return found


def _no_space(found: Sequence[Setting]) -> str:
    like = next((one for one in found if isinstance(one.value, int | float)), None)
    shown = f"{like.name} = {like.value}; // [low:high]" if like else "width = 80; // [40:160]"
    held = f" (held are {', '.join(one.name for one in found[:_SHOWN])})" if found else ""
    return f"nothing in this file has an annotation that says which values it may have{held}; write one: {shown}"


def _check(path: Path, stamp: str) -> None:
    """Raises ProcedureError where nothing is installed that evaluates the file, or its syntax is wrong."""
    if find_spec(_PACKAGE) is not None:
        from shapewright.procedures.openscad.evaluation import parsed

        parsed(path, stamp)
    elif shutil.which(_PROGRAM) is None:
        raise ProcedureError(f"{path}: OpenSCAD files need an evaluator: pip install 'shapewright[openscad]'")


def _used(path: Path) -> set[Path]:
    """What a file includes, uses and imports from its folder, and what these do."""
    found, news = {path}, [path]
    while news:
        file = news.pop()
        try:
            names = Text.of(file.read_text("utf-8")).files if file.suffix.lower() == ".scad" else ()
        except (OSError, UnicodeDecodeError):
            continue
        beside = {other for name in names if (other := (file.parent / name).resolve()).is_file()} - found
        found |= beside
        news += beside
    return found - {path}
