"""An OpenSCAD file as a procedure."""

from __future__ import annotations

import inspect
import keyword
import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, Any

from shapewright.procedures.annotations import SignatureError
from shapewright.procedures.annotations import read as read_argument
from shapewright.procedures.errors import ProcedureError
from shapewright.procedures.facts import Facts
from shapewright.procedures.openscad.customizer import AnnotationError, Setting, settings
from shapewright.procedures.openscad.text import Text
from shapewright.procedures.places import Place
from shapewright.procedures.procedure import Procedure

FACTS = Facts(up="z", unit="mm")
"""OpenSCAD has no unit of its own; what reads its files takes millimetres."""
_SHOWN = 3


@dataclass(frozen=True)
class Model:
    """An OpenSCAD file that is called with values of its parameters.

    Attributes:
        file: the file.
        name: of the procedure.
        arguments: its parameters; those without annotation are held.
        variables: the variable of each parameter whose name is none in Python.
    """

    file: Path
    name: str
    arguments: inspect.Signature
    variables: Mapping[str, str]

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
        """The shape at these values. Raises ProcedureError with the line of the file that is at fault."""
        from shapewright.procedures.openscad.evaluation import evaluated

        return evaluated(self.file, {self.variables.get(name, name): value for name, value in values.items()})


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
        raise ProcedureError(str(error), _place(path, error.line)) from error
    if not any(setting.hint for setting in found):
        raise ProcedureError(_no_space(found), _place(path, found[0].line) if found else Place(str(path), None))
    _check_installed(path)
    items = [_parameter(path, setting) for setting in found]
    variables = {item.name: setting.name for item, setting in zip(items, found, strict=True)}
    strange = {python: own for python, own in variables.items() if python != own}
    made = Procedure(Model(path, name or path.stem, inspect.Signature(items), strange), facts=FACTS)
    made.helpers = tuple(sorted(set(_used(path)) - {path}))
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
            raise ProcedureError(message, _place(path, setting.line)) from error
        if setting.description:
            spelled = Annotated[spelled, setting.description]
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=setting.value, annotation=spelled)


def _no_space(found: Sequence[Setting]) -> str:
    like = found[0] if found else None
    shown = f"{like.name} = {like.value}; // [low:high]" if like else "width = 80; // [40:160]"
    held = f" (held are {', '.join(one.name for one in found[:_SHOWN])})" if found else ""
    return f"nothing in this file has an annotation that says which values it may have{held}; write one: {shown}"


def _check_installed(path: Path) -> None:
    if find_spec("openscad_evaluator") is None and shutil.which("openscad") is None:
        raise ProcedureError(f"{path}: OpenSCAD files need an evaluator: pip install 'shapewright[openscad]'")


def _place(path: Path, line: int) -> Place:
    return Place(str(path), line, path.read_text("utf-8").splitlines()[line - 1].strip())


def _used(path: Path, known: frozenset[Path] = frozenset()) -> Iterator[Path]:
    """The file, and what it includes, uses and imports from its folder, and what these do."""
    yield path
    try:
        names = Text.of(path.read_text("utf-8")).files if path.suffix.lower() == ".scad" else ()
    except (OSError, UnicodeDecodeError):
        return
    known |= {path}
    for name in names:
        file = (path.parent / name).resolve()
        if file.is_file() and file not in known:
            yield from _used(file, known)
