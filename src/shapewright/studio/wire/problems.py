"""Errors that the author can mend, with the author's line, as the page shows them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from shapewright.building.outcomes import Failure
from shapewright.parameters import Parameters
from shapewright.procedures import Place, ProcedureError


@dataclass(frozen=True)
class Problem:
    """What went wrong. kind: see PROTOCOL.md. file, line, text: the author's. slugs: the shapes that it befell."""

    kind: str
    message: str
    file: str | None = None
    line: int | None = None
    text: str | None = None
    slugs: tuple[str, ...] = ()
    parameters: Parameters | None = None

    def record(self) -> dict[str, Any]:
        """As the page gets it."""
        return {**asdict(self), "slugs": list(self.slugs), "count": len(self.slugs) or None}

    @classmethod
    def from_record(cls, record: dict[str, Any]) -> Problem:
        """The inverse of ``record``."""
        known = {name: record[name] for name in cls.__dataclass_fields__ if name in record}
        return cls(**{**known, "slugs": tuple(record.get("slugs", ()))})


def of_error(error: Exception, kind: str, root: Path) -> Problem:
    """Of an error that was raised; the author's file is named relative to ``root``."""
    if not isinstance(error, ProcedureError):
        return Problem(kind, str(error))
    found = _placed(kind, error.message, error.place, root)
    return replace(found, text=None) if error.summary else found


def of_failure(failure: Failure, root: Path, parameters: Parameters | None = None) -> Problem:
    """Of a shape that could not be built; the author's file is named relative to ``root``."""
    return replace(_placed(failure.kind, failure.message, failure.place, root), parameters=parameters)


def _placed(kind: str, message: str, place: Place | None, root: Path) -> Problem:
    if place is None:
        return Problem(kind, message)
    file = Path(place.file)
    name = file.relative_to(root).as_posix() if file.is_relative_to(root) else place.file
    return Problem(kind, message, name, place.line, place.text)


def syntax_problem(path: Path, root: Path) -> Problem | None:
    """Of a file that Python cannot parse; None for one that it can. Nothing of it is run."""
    try:
        compile(path.read_bytes(), str(path), "exec")
    except SyntaxError as error:
        file = path.relative_to(root).as_posix()
        return Problem("syntax", error.msg, file, error.lineno, (error.text or "").strip() or None)
    except (ValueError, RecursionError, MemoryError, OSError) as error:
        return Problem("syntax", str(error) or type(error).__name__, path.relative_to(root).as_posix())
    return None


def together(problems: Iterable[Problem]) -> list[Problem]:
    """One problem for all shapes that failed alike, the commonest first; infeasible ones come last."""
    alike: dict[tuple[str, str, int | None], Problem] = {}
    for each in problems:
        key = (each.kind, each.message, each.line)
        known = alike.get(key)
        alike[key] = replace(known, slugs=known.slugs + each.slugs) if known else each
    return sorted(alike.values(), key=lambda each: (each.kind == "infeasible", -len(each.slugs)))
