"""Errors that the author can mend, with the author's line, as the page shows them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Literal, TypeAlias

from msgspec import Meta, Struct
from msgspec.structs import replace

from shapewright.building.outcomes import Failure, FailureKind
from shapewright.parameters import Parameters
from shapewright.procedures import Place, ProcedureError, is_foreign
from shapewright.studio.wire.values import Slug, Values

ProblemKind: TypeAlias = Annotated[
    Literal[FailureKind, "syntax", "load", "references", "fit", "explain", "export", "project"],
    Meta(title="ProblemKind"),
]
_VALUES = re.compile(
    r"""'[^']*'|"[^"]*"|[-+]?(?:\d[\d_]*\.?\d*|\.\d+)(?:e[-+]?\d+)?|\b(?:nan|inf|True|False|None)\b""", re.I
)
"""What in a message may be a value of one shape: text in quotes, numbers, and the like."""


class Problem(Struct, frozen=True):
    """An error that the author can mend."""

    kind: ProblemKind
    message: str
    file: str | None = None  # the author's, relative to the project
    line: int | None = None  # in this file, from 1
    text: str | None = None  # that line
    slugs: tuple[Slug, ...] = ()  # the shapes that it befell
    parameters: Values | None = None  # of one of these shapes
    count: int | None = None  # how many shapes it befell

    def of(self, *slugs: Slug) -> Problem:
        """The same, of these shapes."""
        return replace(self, slugs=slugs, count=len(slugs) or None)


def of_error(error: Exception, kind: ProblemKind, root: Path) -> Problem:
    """Of an error that was raised; the author's file is named relative to ``root``."""
    if not isinstance(error, ProcedureError):
        return Problem(kind, str(error))
    problem = _placed(kind, error.message, error.place, root)
    return replace(problem, text=None) if error.summary else problem


def of_failure(failure: Failure, root: Path, parameters: Parameters | None = None) -> Problem:
    """Of a shape that could not be built; the author's file is named relative to ``root``."""
    return replace(_placed(failure.kind, failure.message, failure.place, root), parameters=parameters)


def _placed(kind: ProblemKind, message: str, place: Place | None, root: Path) -> Problem:
    if place is None:
        return Problem(kind, message)
    file = Path(place.file)
    name = file.relative_to(root).as_posix() if file.is_relative_to(root) else place.file
    return Problem(kind, message, name, place.line, place.text)


def syntax_problem(path: Path, root: Path) -> Problem | None:
    """Of a file that Python cannot parse; None for one that it can, and for one that is no Python. Nothing is run."""
    if is_foreign(path):
        return None
    try:
        compile(path.read_bytes(), str(path), "exec")
    except SyntaxError as error:
        file = path.relative_to(root).as_posix()
        return Problem("syntax", error.msg, file, error.lineno, (error.text or "").strip() or None)
    except (ValueError, RecursionError, MemoryError, OSError) as error:
        return Problem("syntax", str(error) or type(error).__name__, path.relative_to(root).as_posix())
    return None


def together(problems: Iterable[Problem]) -> list[Problem]:
    """One problem for all shapes that failed alike, the commonest first; infeasible ones come last.

    Those of one line are alike where their messages differ in values alone; the first message stands for all.
    """
    alike: dict[tuple[str, str, str | None, int | None], Problem] = {}
    for problem in problems:
        said = problem.message if problem.line is None else _VALUES.sub("#", problem.message)
        key = (problem.kind, said, problem.file, problem.line)
        first = alike.get(key, problem)
        alike[key] = first.of(*(() if first is problem else first.slugs), *problem.slugs)
    return sorted(alike.values(), key=lambda problem: (problem.kind == "infeasible", -len(problem.slugs)))
