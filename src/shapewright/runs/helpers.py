"""Files of the procedure that a run keeps: a copy of its own, and beside it those that it uses from its own folder."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

from shapewright.procedures import BINARY, FOREIGN, Procedure, is_foreign

_LIST = "helpers.json"
_COPY = "procedure"
_TEXT = "procedure.txt"
"""What stands for the text of a binary file; the copy is then among the helpers."""


def copy_in(run: Path, path: str | None = None) -> Path:
    """The run's copy of the procedure. path: the author's file; by default what is there is looked for.

    It is the same kind of file as the author's, so that it can be loaded.
    """
    if path is not None:
        return run / f"{_COPY}{Path(path).suffix.lower() if is_foreign(Path(path)) else '.py'}"
    there = (run / f"{_COPY}{suffix}" for suffix in sorted(FOREIGN))
    return next((file for file in there if file.is_file()), run / f"{_COPY}.py")


def text_in(run: Path) -> Path:
    """The file of a run that has the text of its procedure."""
    return text if (text := run / _TEXT).is_file() else copy_in(run)


def write_source(run: Path, path: str | None, source: str, helpers: Mapping[str, bytes]) -> None:
    """Put the copy of the procedure into a run, and what it uses where the copy finds it."""
    copy = copy_in(run, path or "")
    write_helpers(run, helpers)
    (run / _TEXT if copy.name in helpers else copy).write_text(source, encoding="utf-8")


def helpers_of(procedure: Procedure) -> dict[str, bytes]:
    """Their contents, by their path in the folder; a file that is binary itself is among them as the run's copy."""
    found: dict[str, bytes] = {}
    if procedure.path is None:
        return found
    foreign = is_foreign(procedure.path)
    copy = copy_in(Path(), str(procedure.path)).name
    for file in procedure.helpers:
        inside = file.is_relative_to(procedure.path.parent)
        name = file.relative_to(procedure.path.parent).as_posix() if inside else copy
        if name != copy and (foreign or file.suffix == ".py"):
            found |= _read(file, name)
    if procedure.path.suffix.lower() in BINARY:
        found |= _read(procedure.path, copy)
    return found


def _read(file: Path, name: str) -> dict[str, bytes]:
    try:
        return {name: file.read_bytes()}
    except OSError:
        return {}


def write_helpers(run: Path, contents: Mapping[str, bytes]) -> None:
    """Put them where the run's copy of the procedure finds them."""
    for name, content in contents.items():
        file = run / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content)
    if contents:
        (run / _LIST).write_text(json.dumps(sorted(contents), indent=1), encoding="utf-8")


def read_helpers(run: Path) -> dict[str, bytes]:
    """Those of a run; none of a run that keeps none, or where files are gone."""
    try:
        names = json.loads((run / _LIST).read_text("utf-8"))
        return {str(name): (run / name).read_bytes() for name in names if ".." not in Path(name).parts}
    except (OSError, ValueError, TypeError):
        return {}
