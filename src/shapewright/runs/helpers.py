"""Files of the procedure that a run keeps: its text, and in folders of their own what it needs to be built again.

``procedure/`` holds the procedure under its own name and what it uses from its folder, ``working/`` what it read from
the working folder.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from shapewright.building import Opened, is_own
from shapewright.procedures import BINARY, FOREIGN, Procedure, is_foreign

MOST_BYTES = 16 * 2**20
"""Of one file that Python code reads, to be kept."""
_MOST_OF_ALL = 4 * MOST_BYTES
_BESIDE, _WORKING = "procedure", "working"
_TEXT = "procedure.txt"
"""What stands for the text of a binary file."""
_LONGEST = 200
"""Letters of a text in the code that may name a file."""


@dataclass(frozen=True)
class Kept:
    """What a run keeps beside the text.

    contents: of the files, by their path in the run.
    too_large: files that it needs, and that a run does not keep.
    """

    contents: Mapping[str, bytes]
    too_large: tuple[Path, ...] = ()


def copy_in(run: Path, path: str | None = None) -> Path:
    """The run's copy of the procedure. path: the author's file; by default what is there is looked for.

    It is the same kind of file as the author's, so that it can be loaded.
    """
    if path is not None:
        whole = run / _BESIDE / Path(path).name
        suffix = Path(path).suffix.lower() if is_foreign(Path(path)) else ".py"
        return whole if whole.is_file() else run / f"procedure{suffix}"
    there = (run / f"procedure{suffix}" for suffix in sorted(FOREIGN))
    return next((file for file in there if file.is_file()), run / "procedure.py")


def working_in(run: Path) -> Path | None:
    """The folder from which the run's copy reads what the procedure read from the working folder."""
    return folder if (folder := run / _WORKING).is_dir() else None


def text_in(run: Path) -> Path:
    """The file of a run that has the text of its procedure."""
    return text if (text := run / _TEXT).is_file() else copy_in(run)


def write_source(run: Path, path: str | None, source: str, helpers: Mapping[str, bytes]) -> None:
    """Put the text of the procedure into a run, and its helpers."""
    file = Path(path or "")
    text = run / _TEXT if file.suffix.lower() in BINARY else copy_in(run, path or "")
    text.write_text(source, encoding="utf-8")
    for name, content in helpers.items():
        file = run / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content)


def read_helpers(run: Path) -> dict[str, bytes]:
    """Those of a run; none of a run that keeps none."""
    files = (file for folder in (_BESIDE, _WORKING) for file in sorted((run / folder).rglob("*")))
    return {
        file.relative_to(run).as_posix(): file.read_bytes()
        for file in files
        if file.is_file() and "__pycache__" not in file.parts
    }


def helpers_of(procedure: Procedure, opened: Iterable[Opened] = ()) -> Kept:
    """What a run keeps of a procedure that uses files of its folder, or is no text.

    opened: what its code read while it built shapes. Files that the code names in full beside itself count as well:
    libraries in C open them unseen.
    """
    if procedure.path is None:
        return Kept({})
    folder, found, large = procedure.path.parent, dict[str, bytes](), list[Path]()
    python = [file for file in (procedure.path, *procedure.helpers) if file.suffix == ".py"]
    for file in procedure.helpers:
        if file.is_relative_to(folder) and file != procedure.path:
            found |= _read(_BESIDE, file.relative_to(folder), file)
    for each in sorted({*opened, *(named for text in python for named in _named(text, procedure.path))}):
        file = Path(each.path)
        places = [(_BESIDE, file.relative_to(folder))] if file.is_relative_to(folder) else []
        places += [(_WORKING, Path(each.named))] if each.named else []
        for where, name in places:
            if f"{where}/{name.as_posix()}" in found or not file.is_file():
                continue
            if (size := file.stat().st_size) > MOST_BYTES or size + sum(map(len, found.values())) > _MOST_OF_ALL:
                large.append(file)
            else:
                found |= _read(where, name, file)
    binary = procedure.path.suffix.lower() in BINARY
    if binary or found:
        own = procedure.path.read_bytes() if binary else procedure.source.encode()
        found[f"{_BESIDE}/{procedure.path.name}"] = own
    return Kept(found, tuple(dict.fromkeys(large)))


def not_kept(files: Sequence[Path | str]) -> str:
    """What a person is told of files that are too large."""
    names = ", ".join(str(file) for file in files)
    return (
        f"a run keeps no copy of {names}: files that the procedure reads are kept up to {MOST_BYTES >> 20} MB each, "
        f"{_MOST_OF_ALL >> 20} MB together; the run cannot be explained or exported after the procedure has changed"
    )


def unchanged(helpers: Mapping[str, bytes], path: Path) -> bool:
    """Whether the files that a run keeps are still what the author's file would find. path: the author's file."""
    for name, content in helpers.items():
        where, _, inside = name.partition("/")
        file = (path.parent if where == _BESIDE else Path.cwd()) / inside
        if file != path and _read(where, Path(inside), file) != {name: content}:
            return False
    return True


def unchanged_beside(run: Path, path: Path) -> bool:
    """The same of what a run keeps from the procedure's folder alone."""
    kept = read_helpers(run)
    return unchanged({name: content for name, content in kept.items() if name.startswith(f"{_BESIDE}/")}, path)


def _named(text: Path, procedure: Path) -> Iterator[Opened]:
    """Files that the code names, from its folder or from the working folder."""
    with suppress(OSError, SyntaxError, ValueError):
        words = {node.value for node in ast.walk(ast.parse(text.read_bytes())) if isinstance(node, ast.Constant)}
        for word in words:
            if not isinstance(word, str) or not 0 < len(word) <= _LONGEST or not word.isprintable():
                continue
            for found in (Opened(str(procedure.parent / word)), Opened(str(Path.cwd() / word), word)):
                if not Path(word).is_absolute() and is_own(found, procedure):
                    yield found


def _read(where: str, name: Path, file: Path) -> dict[str, bytes]:
    with suppress(OSError):
        return {f"{where}/{name.as_posix()}": file.read_bytes()}
    return {}
