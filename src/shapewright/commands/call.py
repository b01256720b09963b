"""A function or a class of a library, called as it is: its ranges stand beside it, in a spec."""

from __future__ import annotations

import contextlib
import functools
import importlib
import inspect
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from shapewright.commands.function import arguments
from shapewright.commands.spec import Spec
from shapewright.procedures import ProcedureError, describe


def call(spec: Spec, values: dict[str, Any]) -> Any:
    """Whatever the function returns. Raises what it raises, Infeasible, ProcedureError where it is not found."""
    return called(spec)(**arguments(spec, values))


def called(spec: Spec) -> Callable[..., Any]:
    """What a spec calls; modules beside the spec are found, too.

    Raises ProcedureError with the line of the spec where it is not there, or does not take the parameters.
    """
    try:
        function = _found(spec.target, spec.file.path.parent)
    except Exception as error:
        raise ProcedureError(_advice(error), spec.place) from error
    with contextlib.suppress(ValueError):  # of a function in C that has no signature
        _check(spec, inspect.signature(function))
    return function


def _check(spec: Spec, taken: inspect.Signature) -> None:
    """Raises ProcedureError where the function does not take a parameter, or wants another one."""
    names = [*spec.entries.names.values(), *spec.entries.fixed]
    for name in names:
        try:
            taken.bind_partial(**{name: None})
        except TypeError as error:
            message = f"{spec.target} takes no such argument; it takes {', '.join(taken.parameters)}"
            raise spec.file.error(("parameters", name), message) from error
    try:
        taken.bind(**dict.fromkeys(names))
    except TypeError as error:
        raise ProcedureError(f"{spec.target}: {error}; say its range, or its value", spec.place) from error


@functools.cache
def _found(target: str, home: Path) -> Callable[..., Any]:
    module, _, name = target.partition(":")
    if str(home) not in sys.path:
        sys.path.append(str(home))
    inner: Any = importlib.import_module(module)
    for part in name.split("."):
        inner = getattr(inner, part)
    return inner  # type: ignore[no-any-return]


def _advice(error: Exception) -> str:
    if isinstance(error, ModuleNotFoundError) and error.name:
        package = error.name.partition(".")[0].replace("_", "-")
        return (
            f"there is no module {error.name} here; install it with: pip install {package}, or name the Python that "
            'has it: python = "path"'
        )
    return describe(error)
