"""Loading a procedure from the author's file, or from a module.

A file that is no Python has an entry in ``_READERS``. Its reader makes a ``Procedure`` of an object that is called as
the author's function would be, with these attributes:

- ``__name__``: of the procedure;
- ``__signature__``: an ``inspect.Signature`` with the annotations that Python authors write;
- ``place``: a ``Place`` in the file, which errors about the whole name;
- ``own_names``, where they differ: what its program calls arguments, by their names in the signature.

It is called by keywords with values of the space; arguments that are held are left out. What it raises for one shape is
Infeasible, or ProcedureError with the line of the file. The reader sets ``helpers``, the files that the file uses. The
object is picklable, and every process reads the file anew. The suffixes are in ``texts``.
"""

from __future__ import annotations

import contextlib
import functools
import importlib
import inspect
import linecache
import re
import sys
import sysconfig
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

from shapewright.procedures.errors import ProcedureError
from shapewright.procedures.places import Place, describe, place_of
from shapewright.procedures.procedure import Procedure
from shapewright.procedures.texts import FOREIGN


def _openscad(path: Path, name: str | None) -> Procedure:
    from shapewright.procedures.openscad.reading import read

    return read(path, name)


def _blender(path: Path, name: str | None) -> Procedure:
    from shapewright.procedures.blender.node_group import read

    return read(path, name)


def _command(path: Path, name: str | None) -> Procedure:
    # By its name: what programs write is read by the readers of references, which lie on a floor above this one.
    made: Procedure = importlib.import_module("shapewright.commands").read(path, name)
    return made


_READERS: Mapping[str, Callable[[Path, str | None], Procedure]] = {
    ".blend": _blender,
    ".scad": _openscad,
    ".toml": _command,
}
"""What makes a procedure of a file that is no Python, by its suffix. It is given the file, and the name that is asked
for: for a file with one procedure it becomes the procedure's name. It imports what it needs when it is called."""
_NAMED = re.compile(rf"(.*({'|'.join(map(re.escape, ['.py', *sorted(FOREIGN)]))})):(.+)", re.IGNORECASE | re.DOTALL)
EXTRAS: Mapping[str, str] = {
    "cadquery": "cadquery",
    "build123d": "build123d",
    "bpy": "blender",
    "openscad_evaluator": "openscad",
    "scene_synthesizer": "scene-synthesizer",
}
"""The extra that installs a module which procedures need."""
_HELPERS = "__shapewright_helpers__"
"""The name under which an executed file has the files that it imported from its own folder."""


def load_procedure(source: str | Path, working: Path | None = None) -> Procedure:
    """The one procedure of a Python file, of a module that can be imported, or of a file of another program.

    source: a Python file in any folder, with its own imports; a file and the name of one of several (``file.py:name``);
        a module and a name (``package.module:name``); an OpenSCAD file (``model.scad``); a geometry node group
        (``model.blend:Group``); a spec of a command (``spec.toml``). A name may also be that of a function without
        ``@procedure``.
    working: the working folder while its file is read, and while worker processes build its shapes; by default that of
        the process.

    Of a file those that are defined in it count; if there are none, those that it imports or gets made elsewhere.
    Raises ProcedureError, pointing at the author's line, when the file is missing, fails, or has not one procedure.
    """
    with contextlib.chdir(working) if working else contextlib.nullcontext():
        loaded = _foreign(source) or _loaded(source)
    loaded.working = working
    return loaded


def _loaded(source: str | Path) -> Procedure:
    """The procedure of a file or a module in Python."""
    path, name, module = _from_module(str(source)) or _from_file(source)
    place = path or module.__name__
    named = {key: value for key, value in vars(module).items() if isinstance(value, Procedure)}
    own = {key: value for key, value in named.items() if _defined_in(value, path)}
    found = {value.name: value for value in (own or named).values()}
    if name is not None:
        chosen = named.get(name) or found.get(name) or _made(vars(module).get(name))
        if chosen is None:
            there = f"there is {', '.join(found)}" if found else "there is none"
            raise ProcedureError(f"{place}: no procedure {name!r} in this file; {there}")
    elif not found:
        raise ProcedureError(f"{place}: no procedure in this file; write @procedure above the function that builds")
    elif len(found) > 1:
        raise ProcedureError(
            f"{place}: several procedures ({', '.join(found)}); say which: {place}:{next(iter(found))}"
        )
    else:
        (chosen,) = found.values()
    chosen.path = path
    chosen.helpers = tuple(vars(module).get(_HELPERS, ()))
    return chosen


def _foreign(source: str | Path) -> Procedure | None:
    """The procedure of a file that is no Python; None where it is Python."""
    suffix = (match[2] if (match := _NAMED.fullmatch(str(source))) else Path(source).suffix).lower()
    if suffix not in _READERS:
        return None
    path, name = _split(source)
    made = _READERS[suffix](path, name)
    made.path = path
    return made


def _made(function: Any) -> Procedure | None:
    """A function without the decorator as a procedure."""
    return Procedure(function) if inspect.isfunction(function) or isinstance(function, functools.partial) else None


def _defined_in(procedure: Procedure, path: Path | None) -> bool:
    return path is not None and Path(procedure.place.file) == path


_Found: TypeAlias = tuple[Path | None, str | None, ModuleType]
"""A file, the name that is asked for, and what the file defines."""


def _from_file(source: str | Path) -> _Found:
    path, name = _split(source)
    return path, name, executed(path)


def _from_module(source: str) -> _Found | None:
    """What ``package.module:name`` means; None where it is a path."""
    dotted, colon, name = source.rpartition(":")
    dotted_name = all(part.isidentifier() for part in [*dotted.split("."), name])
    if not colon or not dotted_name or dotted.endswith(".py") or Path(source).exists():
        return None
    if (here := str(Path.cwd())) not in sys.path:
        sys.path.insert(_behind_standard_library(), here)
    try:
        module = importlib.import_module(dotted)
    except ModuleNotFoundError as error:
        if dotted == error.name or dotted.startswith(f"{error.name}."):
            raise ProcedureError(f"{source}: there is no module {error.name}, and no such file") from error
        raise ProcedureError(describe(error), place_of(error, None)) from error
    except Exception as error:
        raise ProcedureError(describe(error), place_of(error, None)) from error
    return Path(module.__file__).resolve() if module.__file__ else None, name, module


def _split(path: str | Path) -> tuple[Path, str | None]:
    named = None if Path(path).is_file() else _NAMED.fullmatch(str(path))
    resolved = Path(named[1] if named else path).expanduser().resolve()
    if resolved.is_dir():
        raise ProcedureError(f"{resolved}: this is a folder; name the file of the procedure")
    if not resolved.is_file():
        raise ProcedureError(f"{resolved}: no such file")
    return resolved, named[3] if named else None


def executed(path: Path) -> ModuleType:
    """The module of an author's file, with its own imports. Raises ProcedureError, pointing at the line that fails."""
    module = ModuleType(f"shapewright_author_{path.stem}")
    module.__file__ = str(path)
    folder = str(path.parent)
    before = set(sys.modules)
    sys.modules[module.__name__] = module
    linecache.checkcache(str(path))
    try:
        with _looked_in_first(folder):
            exec(compile(path.read_bytes(), str(path), "exec"), module.__dict__)
    except ProcedureError:
        raise
    except SyntaxError as error:
        place = Place(error.filename or str(path), error.lineno, (error.text or "").strip() or None)
        raise ProcedureError(error.msg, place) from error
    except Exception as error:
        raise ProcedureError(describe(error) + _advice(error, path.parent), place_of(error, path)) from error
    except SystemExit as error:
        raise ProcedureError(f"{path}: the file ended the program (sys.exit) while it was read") from error
    finally:
        files = _forget_siblings(path.parent, before)
        module.__dict__[_HELPERS] = [file for file in files if file != path]
    return module


@contextlib.contextmanager
def _looked_in_first(folder: str) -> Iterator[None]:
    """Modules are looked for in the author's folder before all others, such as the working folder, but Python's own.

    Later they are looked for there last, for what the author imports in a function.
    """
    start = _behind_standard_library()
    own = _standard_library()
    others = [place for place in sys.path[:start] if place not in own]
    sys.path[:start] = [*(place for place in sys.path[:start] if place in own), folder, *others]
    try:
        yield
    finally:
        for place in (folder, *others):
            with contextlib.suppress(ValueError):  # the author may have removed it
                sys.path.remove(place)
        sys.path[:0] = others
        if folder not in sys.path:
            sys.path.append(folder)


def _standard_library() -> set[str]:
    own = {sysconfig.get_path("stdlib"), sysconfig.get_path("platstdlib")}
    return own | {str(Path(folder) / "lib-dynload") for folder in own}


def _behind_standard_library() -> int:
    """Where in ``sys.path`` the author's folder goes: before other packages, behind Python's own modules.

    Libraries import those late too, and would get the author's file of the same name.
    """
    own = _standard_library()
    return max((i + 1 for i, folder in enumerate(sys.path) if folder in own), default=0)


def _advice(error: Exception, folder: Path) -> str:
    """What to do about an import: of an extra's library, or of a file that has the name of one of Python's modules."""
    name = error.name.partition(".")[0] if isinstance(error, ImportError) and error.name else ""
    if isinstance(error, ModuleNotFoundError) and name in EXTRAS:
        return f"; pip install 'shapewright[{EXTRAS[name]}]'"
    hidden = name in sys.stdlib_module_names and (folder / f"{name}.py").is_file()
    return f"; {folder / name}.py has the name of one of Python's modules: rename it" if hidden else ""


def _forget_siblings(folder: Path, before: set[str]) -> list[Path]:
    """Drop the author's own helper modules, so that another folder's of the same name, or an edit, is read anew.

    Returns their files.
    """
    files = []
    for name in set(sys.modules) - before:
        file = getattr(sys.modules[name], "__file__", None)
        if file and Path(file).is_relative_to(folder) and "site-packages" not in file:
            del sys.modules[name]
            files.append(Path(file))
    return sorted(files)
