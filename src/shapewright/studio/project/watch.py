"""Notices when the author saves: the folder is watched, because editors replace files instead of writing to them."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from pathlib import Path

from watchfiles import Change, awatch

from shapewright.procedures import is_foreign
from shapewright.references import EXTENSIONS
from shapewright.references.sources import MANIFEST
from shapewright.studio.project.workspace import SCRATCH, Project

_SHAPES = (*EXTENSIONS, MANIFEST)
_STEP, _LONGEST = 30, 300


async def watch(project: Project, source: Callable[[], object], references: Callable[[], object]) -> None:
    """Call ``source`` after a file that may be the procedure's changed, ``references`` after a reference did.

    Those are Python files beside it; of a procedure that is no Python any file of its folder, since it may use that.
    """
    foreign = is_foreign(project.procedure)
    shapes = Path(project.origin.source)
    home = shapes if shapes.is_dir() else shapes.parent
    async with asyncio.TaskGroup() as group:
        group.create_task(_watch(project.procedure.parent, foreign, _is_used if foreign else _is_source, source))
        if home.is_dir():
            group.create_task(_watch(home, True, _is_shape, references))


async def _watch(folder: Path, below: bool, counts: Callable[[Path], bool], changed: Callable[[], object]) -> None:
    def wanted(change: Change, name: str) -> bool:
        return counts(Path(name))

    async for _ in awatch(
        folder, watch_filter=wanted, recursive=below, step=_STEP, debounce=_LONGEST, ignore_permission_denied=True
    ):
        changed()


def _is_source(path: Path) -> bool:
    return path.suffix == ".py" and not path.name.startswith(".")


def _is_shape(path: Path) -> bool:
    return path.suffix.lower() in _SHAPES and _is_used(path)


def _is_used(path: Path) -> bool:
    return not path.name.startswith(".") and not {SCRATCH, "runs", ".git"} & set(path.parts)
