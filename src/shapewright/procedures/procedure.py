"""A procedure: the author's function, whose signature is its parameter space; and loading one from a file."""

from __future__ import annotations

import functools
import hashlib
import inspect
import linecache
import sys
import sysconfig
import typing
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Annotated, Any, Literal, get_args, get_origin

from shapewright.parameters import Binary, Choice, Integer, Parameter, ParameterSpace, Range, Scalar, When
from shapewright.procedures.places import Place, describe, place_of
from shapewright.shapes import Shape
from shapewright.shapes.conversion import as_shape

_KINDS = (
    "Annotated[float, Range(low, high)] for a scalar, Annotated[int, Range(low, high)] for an integer, "
    'bool for a binary, Literal["a", "b"] for a choice'
)


class ProcedureError(Exception):
    """The author's file or function cannot be used; as text it says where and what to do.

    message: what is wrong and what to do, without the place unless ``summary``.
    place: the author's line, where it is known.
    kind: ``"time"`` when the author's code took too long, else ``"broken"``.
    summary: the message is about several shapes and names the place itself.
    """

    def __init__(
        self,
        message: str,
        place: Place | None = None,
        kind: Literal["broken", "time"] = "broken",
        summary: bool = False,
    ) -> None:
        super().__init__(message, place, kind, summary)
        self.message, self.place, self.kind, self.summary = message, place, kind, summary

    def __str__(self) -> str:
        return self.place.says(self.message) if self.place and not self.summary else self.message


class Infeasible(Exception):
    """Raised by a procedure for parameters that have no shape: ``raise Infeasible("the shelves do not fit")``."""


class Procedure:
    """A function from parameters to a shape, with the parameter space that its signature spells.

    space: its ParameterSpace. name: the function's name. path: the author's file, if it was loaded from one.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        functools.update_wrapper(self, function)
        self.function = function
        self.name = function.__name__
        self.space = space_of(function)
        self.path: Path | None = None

    def __call__(self, /, *args: Any, **kwargs: Any) -> Shape:
        """Build the shape for these parameters; those left out are at their defaults.

        Values outside a Range are the caller's own risk: the function is called with what it is given.
        Raises Infeasible, ProcedureError when the function returns no shape, and whatever the function raises.
        """
        result = self.function(*args, **kwargs)
        if inspect.isgenerator(result):
            result = list(result)  # here, so that what the author's code raises is the author's
        try:
            return as_shape(result)
        except (TypeError, ValueError) as error:
            raise ProcedureError(str(error), self.place) from error

    def random(self, seed: int = 0) -> Shape:
        """A shape at random parameters; the next ones in turn while these are infeasible."""
        for parameters in self.space.sample(100, seed=seed):
            try:
                return self(**parameters)
            except Infeasible:
                continue
        raise ProcedureError("100 random parameter vectors were all infeasible", self.place)

    @property
    def place(self) -> Place:
        """Where the function begins."""
        return _place(self.function)

    @property
    def digest(self) -> str:
        """The ``source_digest`` of its source."""
        return source_digest(self.source)

    @property
    def source(self) -> str:
        """The text of the author's file, or of the function alone when there is no file; empty if neither is known."""
        try:
            return self.path.read_text("utf-8") if self.path else inspect.getsource(self.function)
        except (OSError, TypeError):
            return ""

    def __repr__(self) -> str:
        return f"Procedure({self.name}: {', '.join(self.space.names)})"


def procedure(function: Callable[..., Any]) -> Procedure:
    """Make a function a procedure. Raises ProcedureError when its signature is no parameter space."""
    return Procedure(function)


def source_digest(source: str) -> str:
    """A key for the text of a procedure, the same in every run and in the studio: 16 hexadecimal digits of SHA-256."""
    return hashlib.sha256(source.encode()).hexdigest()[:16]


def load_procedure(path: str | Path) -> Procedure:
    """The one procedure of a Python file, in any folder, with its own imports; ``file.py:name`` picks one of several.

    Raises ProcedureError, pointing at the author's line, when the file is missing, fails, or has not one procedure.
    """
    path, name = _split(path)
    found = {
        value.name: value
        for value in vars(executed(path)).values()
        if isinstance(value, Procedure) and Path(value.function.__code__.co_filename) == path
    }
    if not found:
        raise ProcedureError(f"{path}: no procedure in this file; write @procedure above the function that builds")
    if name is None and len(found) > 1:
        raise ProcedureError(f"{path}: several procedures ({', '.join(found)}); say which: {path}:{next(iter(found))}")
    if name is not None and name not in found:
        raise ProcedureError(f"{path}: no procedure {name!r} in this file; there is {', '.join(found)}")
    chosen = found[name or next(iter(found))]
    chosen.path = path
    return chosen


def _split(path: str | Path) -> tuple[Path, str | None]:
    file, _, name = str(path).rpartition(":")
    named = file.endswith(".py")
    resolved = Path(file if named else path).expanduser().resolve()
    if resolved.is_dir():
        raise ProcedureError(f"{resolved}: this is a folder; name the Python file of the procedure")
    if not resolved.is_file():
        raise ProcedureError(f"{resolved}: no such file")
    return resolved, name if named else None


def executed(path: Path) -> ModuleType:
    """The module of an author's file, with its own imports. Raises ProcedureError, pointing at the line that fails."""
    module = ModuleType(f"shapewright_author_{path.stem}")
    module.__file__ = str(path)
    folder = str(path.parent)
    before = set(sys.modules)
    sys.modules[module.__name__] = module
    sys.path.insert(_behind_standard_library(), folder)
    linecache.checkcache(str(path))
    try:
        exec(compile(path.read_bytes(), str(path), "exec"), module.__dict__)
    except ProcedureError:
        raise
    except SyntaxError as error:
        place = Place(error.filename or str(path), error.lineno, (error.text or "").strip() or None)
        raise ProcedureError(error.msg, place) from error
    except Exception as error:
        raise ProcedureError(describe(error) + _hidden_helper(error, path.parent), place_of(error, path)) from error
    except SystemExit as error:
        raise ProcedureError(f"{path}: the file ended the program (sys.exit) while it was read") from error
    finally:
        sys.path.remove(folder)
        if folder not in sys.path:
            sys.path.append(folder)
        _forget_siblings(path.parent, before)
    return module


def _behind_standard_library() -> int:
    """Where in ``sys.path`` the author's folder goes: before other packages, behind Python's own modules.

    Libraries import those late too, and would get the author's file of the same name.
    """
    own = {sysconfig.get_path("stdlib"), sysconfig.get_path("platstdlib")}
    own |= {str(Path(folder) / "lib-dynload") for folder in own}
    return max((i + 1 for i, folder in enumerate(sys.path) if folder in own), default=0)


def _hidden_helper(error: Exception, folder: Path) -> str:
    """What an import of the author's own file means that has the name of one of Python's modules."""
    name = error.name.partition(".")[0] if isinstance(error, ImportError) and error.name else ""
    hidden = name in sys.stdlib_module_names and (folder / f"{name}.py").is_file()
    return f"; {folder / name}.py has the name of one of Python's modules: rename it" if hidden else ""


def _forget_siblings(folder: Path, before: set[str]) -> None:
    """Drop the author's own helper modules, so that another folder's of the same name, or an edit, is read anew."""
    for name in set(sys.modules) - before:
        file = getattr(sys.modules[name], "__file__", None)
        if file and Path(file).is_relative_to(folder) and "site-packages" not in file:
            del sys.modules[name]


def space_of(function: Callable[..., Any], skip: int = 0) -> ParameterSpace:
    """The parameter space that a function's signature spells, without its first ``skip`` parameters.

    Raises ProcedureError, pointing at the function, where an annotation is no parameter's.
    """
    place = _place(function)
    try:
        hints = typing.get_type_hints(function, include_extras=True)
    except (NameError, TypeError) as error:
        raise ProcedureError(f"an annotation cannot be read: {error}", place) from error
    signature = list(inspect.signature(function).parameters.values())
    if not signature:
        raise ProcedureError(f"it has no parameters; give it some: {_KINDS}", place)
    try:
        return ParameterSpace(tuple(_parameter(item, hints.get(item.name)) for item in signature[skip:]))
    except ValueError as error:
        raise ProcedureError(str(error), place) from error


def _place(function: Callable[..., Any]) -> Place:
    """Where a function begins."""
    code = function.__code__
    return Place(code.co_filename, code.co_firstlineno, function=function.__name__)


def _parameter(item: inspect.Parameter, hint: Any) -> Parameter:
    name, default = item.name, item.default
    if item.kind in (item.VAR_POSITIONAL, item.VAR_KEYWORD):
        raise ValueError(f"parameter {name!r}: * and ** parameters have no space; name each one")
    if item.kind is item.POSITIONAL_ONLY:
        raise ValueError(f"parameter {name!r} stands before a /, and parameters are given by name; leave the / out")
    if hint is None:
        raise ValueError(f"parameter {name!r} has no annotation; use {_KINDS}")
    kind, extras = (get_args(hint)[0], get_args(hint)[1:]) if get_origin(hint) is Annotated else (hint, ())
    limits = next((extra for extra in extras if isinstance(extra, Range)), None)
    when = next((extra.condition for extra in extras if isinstance(extra, When)), limits.when if limits else None)
    given = default is not item.empty
    if kind is bool:
        return Binary(name, default if given else False, when)
    if get_origin(kind) is Literal:
        options = get_args(kind)
        return Choice(name, options, default if given else options[0], when)
    if kind in (int, float) and limits is None:
        raise ValueError(f"parameter {name!r} needs a Range: Annotated[{kind.__name__}, Range(low, high)]")
    if kind is int and limits is not None:
        if limits.steps is not None:
            raise ValueError(f"parameter {name!r}: an integer takes every value of its Range; leave steps out")
        low, high = int(limits.low), int(limits.high)
        if (low, high) != (limits.low, limits.high):
            raise ValueError(f"parameter {name!r}: Range({limits.low}, {limits.high}) of an integer needs whole ends")
        return Integer(name, low, high, default if given else low, when)
    if kind is float and limits is not None:
        steps = limits.steps if isinstance(limits.steps, int | None) else tuple(float(step) for step in limits.steps)
        middle = (limits.low + limits.high) / 2
        return Scalar(name, float(limits.low), float(limits.high), float(default) if given else middle, steps, when)
    spelled = kind.__name__ if isinstance(kind, type) else str(kind)
    raise ValueError(f"parameter {name!r}: the annotation {spelled} is not supported; use {_KINDS}")
