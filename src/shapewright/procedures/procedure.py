"""A procedure: the author's function, whose signature is its parameter space."""

from __future__ import annotations

import functools
import inspect
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, overload

from shapewright.parameters import ParameterSpace
from shapewright.procedures.errors import Infeasible, ProcedureError
from shapewright.procedures.facts import Axis, Facts, Size, Unit
from shapewright.procedures.places import Place
from shapewright.procedures.signature import name_of, place_in, signature_of
from shapewright.procedures.texts import source_digest, text_of
from shapewright.shapes import Shape
from shapewright.shapes.conversion import as_shape


class Procedure:
    """A function from parameters to a shape, with the parameter space that its signature spells.

    Attributes:
        function: the author's.
        name: the function's.
        signature: how the function is called with values of the space.
        path: the author's file, if it was loaded from one.
        helpers: files that it imported or used from its own folder.
        facts: what is true of all its shapes.
        working: the working folder that it is to be built in; None for that of the process.
        seconds: wall time that building a shape may take, where its file says so; it goes before the settings.
    """

    def __init__(
        self, function: Callable[..., Any], names: Mapping[str, Any] | None = None, facts: Facts | None = None
    ) -> None:
        """names: those of the place where the function is defined, which its annotations may use."""
        self.function: Callable[..., Any] = function.__func__ if isinstance(function, staticmethod) else function
        functools.update_wrapper(self, self.function)
        self.name = name_of(self.function)
        self.signature = signature_of(self.function, names)
        self.path: Path | None = None
        self.helpers: tuple[Path, ...] = ()
        self.working: Path | None = None
        self.facts = facts or Facts()
        self.seconds: float | None = None

    @property
    def space(self) -> ParameterSpace:
        return self.signature.space

    def __call__(self, /, *args: Any, **kwargs: Any) -> Shape:
        """Build the shape for these parameters, Y up; those left out are at their defaults.

        Values outside a Range are the caller's own risk: the function is called with what it is given.
        Raises Infeasible, ProcedureError when the function returns no shape, and whatever the function raises.
        """
        result = self.signature.call(self.function, args, kwargs)
        if isinstance(self.function, type):  # a dataclass of parameters that builds itself when it is called
            result = result()
        if inspect.isgenerator(result):
            result = list(result)  # here, so that what the author's code raises is the author's
        try:
            return self.facts.stood(as_shape(result))
        except (TypeError, ValueError) as error:
            raise ProcedureError(str(error), self.place) from error

    @property
    def own_names(self) -> Mapping[str, str]:
        """What the procedure's own program calls arguments that Python calls otherwise, by their names in Python."""
        names: Mapping[str, str] = getattr(self.function, "own_names", {})
        return names

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
        return place_in(self.function)

    @property
    def digest(self) -> str:
        """The ``source_digest`` of its source."""
        return source_digest(self.source)

    @property
    def source(self) -> str:
        """The text of the author's file, or of the function alone when there is no file; empty if neither is known.

        A binary file has a line that says what is in it, see ``text_of``.
        """
        try:
            return text_of(self.path) if self.path else inspect.getsource(self.function)
        except (OSError, TypeError, UnicodeDecodeError):
            return ""

    def __repr__(self) -> str:
        return f"Procedure({self.name}: {', '.join(self.space.names)})"


@overload
def procedure(function: Callable[..., Any], /) -> Procedure: ...
@overload
def procedure(
    *, up: Axis = "y", unit: Unit | None = None, size: Size = "relative"
) -> Callable[[Callable[..., Any]], Procedure]: ...
def procedure(
    function: Callable[..., Any] | None = None,
    /,
    *,
    up: Axis = "y",
    unit: Unit | None = None,
    size: Size = "relative",
) -> Procedure | Callable[[Callable[..., Any]], Procedure]:
    """Make a function a procedure: ``@procedure``, or with facts ``@procedure(up="z", unit="mm", size="given")``.

    A dataclass whose objects build themselves when they are called can be one, and whatever else can be called.
    Raises ProcedureError when its signature is no parameter space, or a fact is none.

    Args:
        function: the author's.
        up: the axis that points up in what it builds.
        unit: of its lengths.
        size: "given" finds replicas of the references' own size; "relative" of their proportions alone.
    """
    names = dict(sys._getframe(1).f_locals)  # annotations as text may mean names of the function around

    def made(function: Callable[..., Any]) -> Procedure:
        if isinstance(function, Procedure):
            return function
        try:
            facts = Facts(up, unit, size)
        except ValueError as error:
            raise ProcedureError(str(error), place_in(function)) from error
        return Procedure(function, names, facts)

    return made if function is None else made(function)
