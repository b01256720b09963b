"""Files that the author drops on the page: they go into the project's folder of references, and over no other file."""

from __future__ import annotations

import filecmp
import os
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from itertools import count
from pathlib import Path
from typing import IO

from shapewright.references.archives import is_archive
from shapewright.references.readers.formats import EXTENSIONS
from shapewright.storage import PARTIAL, remove_leftovers
from shapewright.studio.project.workspace import Project, ProjectError
from shapewright.studio.wire.requests import Arrived, Wrong

MOST_BYTES = 2**28
"""Of one file. A million triangles take 50 MB as STL and 120 MB as the text of an OBJ."""
_LONGEST = 200
"""Bytes of a name: file systems take 255, and a partial file has a longer one."""
_PARTS = (".bin",)
"""Kinds that are read with others: the buffers of glTF."""
_RESERVED = {"con", "prn", "aux", "nul", *(f"{port}{i}" for port in ("com", "lpt") for i in range(1, 10))}
"""Names of devices on Windows, whatever their suffix."""


class Taken(ProjectError):
    """There is another file of this name. taken: true, for the page."""

    taken = True


@contextmanager
def arriving(project: Project, name: str, beside: bool) -> Iterator[tuple[IO[bytes], list[Arrived]]]:
    """A file to write what arrives to, and a list that holds what became of it after the block.

    beside: where another file has the name, put it beside that one under a free name. Raises Wrong for a name that
    cannot be or that is of no kind that is read, Taken, ProjectError where nothing can be written. It leaves no rest.
    """
    name, home = _checked(name), _home(project)
    remove_leftovers(home)
    partial = home / f".{name}.{os.urandom(4).hex()}{PARTIAL}"
    done: list[Arrived] = []
    try:
        with partial.open("xb") as file:
            yield file, done
        size = partial.stat().st_size
        if not size:
            raise Wrong(f"{name} is empty")
        if _same(partial, home / name):
            done.append(Arrived(path=name, bytes=size, there=True))
            return
        placed = _placed(partial, home, name, beside)
        done.append(Arrived(path=placed.name, bytes=size, there=False))
    except TimeoutError:  # of what arrives, not of the disk
        raise
    except OSError as error:
        raise ProjectError(f"{name} cannot be written: {error.strerror or error}") from error
    finally:
        with suppress(OSError):
            partial.unlink()


def _checked(name: str) -> str:
    """A name that is safe as that of a file. Raises Wrong."""
    name = unicodedata.normalize("NFC", name)
    try:
        size = len(name.encode())
    except UnicodeEncodeError as error:
        raise Wrong("the name of the file is no text") from error
    odd = any(unicodedata.category(letter) in ("Cc", "Cf", "Zl", "Zp") or letter in '/\\:*?"<>|' for letter in name)
    if not name or odd or name.startswith(".") or name.strip(" .") != name or size > _LONGEST:
        raise Wrong(f"{_shortened(name)}: no name of a file that can be taken over; rename it")
    if name.split(".")[0].strip().lower() in _RESERVED:
        raise Wrong(f"{name}: a name that some systems keep for devices; rename it")
    if Path(name).suffix.lower() not in (*EXTENSIONS, *_PARTS) and not is_archive(Path(name)):
        raise Wrong(f"{name}: no kind of file that is read ({' '.join(EXTENSIONS)})")
    return name


def _shortened(name: str) -> str:
    return repr(name if len(name) <= 60 else f"{name[:60]}…")


def _home(project: Project) -> Path:
    """The folder of references. Raises ProjectError where it is elsewhere, or leads out of the project."""
    if project.origin.confine is None:
        raise ProjectError(
            f"the references are in {project.origin.source}, where the studio writes nothing: put the file there"
        )
    home = Path(project.origin.source)
    home.mkdir(exist_ok=True)
    if not home.is_dir() or not home.resolve().is_relative_to(project.folder):
        raise ProjectError(f"{home.name} leads out of the project, where the studio writes nothing")
    return home


def _same(one: Path, other: Path) -> bool:
    return other.is_file() and not other.is_symlink() and filecmp.cmp(one, other, shallow=False)


def _placed(partial: Path, home: Path, name: str, beside: bool) -> Path:
    """Give a file its name, unless another has it, links that lead nowhere included. Raises Taken."""
    stem, suffix = (name[: -len(end)], end) if (end := "".join(Path(name).suffixes[-1:])) else (name, "")
    for number in count(2):
        path = home / name
        try:
            os.link(partial, path)  # fails where there is something, and follows no link
        except FileExistsError:
            if not beside:
                raise Taken(f"there is another {name} already") from None
            name = f"{stem}-{number}{suffix}"
        except OSError:  # a disk without hard links
            if not os.path.lexists(path):
                partial.rename(path)
                return path
            if not beside:
                raise Taken(f"there is another {name} already") from None
            name = f"{stem}-{number}{suffix}"
        else:
            return path
    raise AssertionError
