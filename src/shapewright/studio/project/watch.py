"""Notices when the author saves: the folder is watched, because editors replace files instead of writing to them."""

from __future__ import annotations

import asyncio
import hashlib
import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from itertools import chain
from pathlib import Path

from watchfiles import Change, awatch

from shapewright.procedures import is_foreign
from shapewright.references import EXTENSIONS
from shapewright.references.sources import MANIFEST
from shapewright.runs.folder import EXPLANATION, RECORD
from shapewright.studio.project.workspace import SCRATCH, Project

_SHAPES = (*EXTENSIONS, MANIFEST)
_NAMES = (re.compile(rb"[<\"']([^<>\"'\n\0]+)[>\"']"), re.compile(rb"[^\s<>\"'(){}\[\],;=\0]+\.\w+"))
"""What may be the path of a file in a text: what stands in quotes or between < and >, or a word with a suffix."""
_LOOKED_AT = 1024  # bytes that tell a text from a binary file
_STEP, _LONGEST = 30, 300
_PAUSE = 1.0
"""Seconds between two looks at the runs: their folder may come late, and be a link or on another machine."""


async def watch(
    project: Project, source: Callable[[], object], references: Callable[[], object], runs: Callable[[], object]
) -> None:
    """Call ``source`` after a file that may be the procedure's changed, ``references`` after a reference did, ``runs``
    after runs or explanations did.

    The first are Python files beside it; of a procedure that is no Python any file of its folder: it may use that.
    """
    foreign = is_foreign(project.procedure)
    shapes = Path(project.origin.source)
    home = shapes if shapes.is_dir() else shapes.parent
    async with asyncio.TaskGroup() as group:
        group.create_task(_watch(project.procedure.parent, foreign, _is_used if foreign else _is_source, source))
        group.create_task(_look_at(lambda: _stamps(project), runs))
        if home.is_dir():
            group.create_task(_watch(home, True, _is_shape, references))


async def _watch(folder: Path, below: bool, counts: Callable[[Path], bool], changed: Callable[[], object]) -> None:
    def wanted(change: Change, name: str) -> bool:
        return counts(Path(name))

    async for _ in awatch(
        folder, watch_filter=wanted, recursive=below, step=_STEP, debounce=_LONGEST, ignore_permission_denied=True
    ):
        changed()


async def _look_at(state: Callable[[], object], changed: Callable[[], object]) -> None:
    before = state()
    while True:
        await asyncio.sleep(_PAUSE)
        if (now := state()) != before:
            before = now
            changed()


def _stamps(project: Project) -> dict[Path, list[int]]:
    """When the files of each run were written."""
    stamps: dict[Path, list[int]] = {}
    for run in project.runs:
        with suppress(OSError):
            files = (run / name for name in (RECORD, EXPLANATION))
            stamps[run] = [file.stat().st_mtime_ns for file in files if file.is_file()]
    return stamps


def _is_source(path: Path) -> bool:
    return path.suffix == ".py" and not path.name.startswith(".")


def _is_shape(path: Path) -> bool:
    return path.suffix.lower() in _SHAPES and _is_used(path)


def _is_used(path: Path) -> bool:
    return not path.name.startswith(".") and not {SCRATCH, "runs", ".git"} & set(path.parts)


def fingerprint(project: Project) -> str:
    """Changes whenever the procedure does, or a file that it uses.

    Those are the Python files beside it that it names, or that such a file names; of a procedure that is no Python
    all files of its folder whose path there it names, and so on.
    """
    procedure = project.procedure
    if is_foreign(procedure):
        return _digest(_named_files(project))
    texts = {path.stem: _read_bytes(path) for path in procedure.parent.glob("*.py")}
    used: set[str] = set()
    news = {procedure.stem}
    while news:
        used |= news
        words = {word for stem in news for word in re.findall(rb"\w+", texts.get(stem, b""))}
        news = {stem for stem in texts if stem.encode() in words} - used
    return _digest({stem: texts.get(stem, b"") for stem in used})


def _named_files(project: Project) -> dict[str, bytes]:
    """What a procedure that is no Python uses, itself included, by path."""
    found: dict[str, bytes] = {}
    news = {project.procedure}
    while news:
        found |= {str(path): _read_bytes(path) for path in news}
        named = {
            (path.parent / word.decode("utf-8", "replace")).resolve()
            for path in news
            if b"\0" not in found[str(path)][:_LOOKED_AT]
            for word in chain.from_iterable(pattern.findall(found[str(path)]) for pattern in _NAMES)
        }
        inside = {path for path in named if path.is_relative_to(project.folder) and path.is_file()}
        news = {path for path in inside if str(path) not in found}
    return found


def _digest(contents: Mapping[str, bytes]) -> str:
    return hashlib.blake2b(repr(sorted(contents.items())).encode(), digest_size=8).hexdigest()


def _read_bytes(path: Path) -> bytes:
    """Empty for a file that is just being replaced, or that may not be read."""
    try:
        return path.read_bytes()
    except OSError:
        return b""
