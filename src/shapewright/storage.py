"""Files and folders that are written whole or not at all, their safe names, and the user's folder for caches.

Everything is written under a hidden name that ends in PARTIAL, and renamed when it is whole. An error removes it. A
kill leaves it behind, hidden; a later writer of the same path removes it. All that write raise OSError when the disk
cannot be written.
"""

from __future__ import annotations

import os
import re
import shutil
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from itertools import chain, count
from pathlib import Path

PARTIAL = ".partial"
_STALE_SECONDS = 3600.0
"""No writer takes this long for one file or folder, so its process is dead. Our estimate: a large run takes seconds."""


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A path to write a file to, which takes the place of ``path`` at the end of the block; or vanishes if that fails.

    The new file keeps the permissions of the old one. A link is replaced, not followed. Any number of processes may
    write the same path.
    """
    partial = path.with_name(f".{path.name}.{os.urandom(4).hex()}{PARTIAL}")
    try:
        yield partial
        if path.is_file():
            shutil.copymode(path, partial)
        partial.replace(path)
    except BaseException:
        with suppress(OSError):
            partial.unlink()
        raise


def write_file(path: Path, content: str | bytes) -> None:
    """Write a file whole or not at all, text as UTF-8, and remove what killed writers of it left.

    A part of a path that is not UTF-8 becomes a question mark.
    """
    remove_leftovers(path.parent, path.name)
    with whole_file(path) as partial:
        partial.write_bytes(content.encode(errors="replace") if isinstance(content, str) else content)


def write_durably(path: Path, parts: Iterable[bytes]) -> None:
    """Write a file whole or not at all, also where the machine stops at this moment."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(path) as partial, partial.open("wb") as file:
        file.writelines(parts)
        file.flush()
        os.fsync(file.fileno())
    if os.name == "posix":
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)


@contextmanager
def whole_folder(folder: Path) -> Iterator[Path]:
    """A folder of the same name to fill, which becomes ``folder`` at the end of the block; or vanishes if that fails.

    Raises FileExistsError when ``folder`` holds something already.
    """
    if not is_free(folder):
        raise FileExistsError(f"{folder}: there is something here already; name another folder")
    with scratch_folder(folder) as around:
        partial = around / folder.name
        partial.mkdir()
        yield partial
        partial.replace(folder)


@contextmanager
def scratch_folder(path: Path) -> Iterator[Path]:
    """A hidden folder beside ``path``, which is deleted at the end of the block."""
    path.parent.mkdir(parents=True, exist_ok=True)
    remove_leftovers(path.parent, path.name)
    with tempfile.TemporaryDirectory(PARTIAL, f".{path.name}.", path.parent, ignore_cleanup_errors=True) as scratch:
        yield Path(scratch)


def is_free(folder: Path) -> bool:
    """Whether nothing is at this path, or an empty folder."""
    return not folder.exists() or (folder.is_dir() and not any(folder.iterdir()))


def remove_leftovers(folder: Path, name: str = "", age: float = _STALE_SECONDS) -> None:
    """Remove what killed writers left in a folder: of the path of this name, or of all. age: in seconds, at least."""
    start = f".{name}." if name else "."
    with suppress(OSError):
        for path in folder.iterdir():
            if path.name.startswith(start) and path.name.endswith(PARTIAL):
                with suppress(OSError):
                    if time.time() - path.stat().st_mtime >= age:
                        shutil.rmtree(path) if path.is_dir() else path.unlink()


def file_names(names: tuple[str, ...]) -> dict[str, str]:
    """A short file name of safe characters for each name, all different."""
    slugs: dict[str, str] = {}
    taken: set[str] = set()
    for name in names:
        stem = re.sub(r"[^A-Za-z0-9_-]+", "-", name).strip("-")[:80] or "reference"
        numbered = chain([stem], (f"{stem}-{number}" for number in count(2)))
        slugs[name] = next(slug for slug in numbered if slug.lower() not in taken)
        taken.add(slugs[name].lower())
    return slugs


def cell(text: str) -> str:
    """A text as a cell of a table that spreadsheets open: none that begins like a formula is run as one."""
    return f"'{text}" if text[:1] in ("=", "+", "-", "@", "\t", "\r") and text else text


def printable(path: str | Path) -> str:
    """A path or a name as it can be shown and written: bytes that are no UTF-8 are read as Latin-1, as older systems
    wrote them; where that gives no letter either, a sign stands in their place."""
    return re.sub("[\udc80-\udcff]", lambda odd: _latin(ord(odd[0]) - 0xDC00), str(path))


def _latin(byte: int) -> str:
    return chr(byte) if byte >= 0xA0 else "\N{REPLACEMENT CHARACTER}"


def cache_folder() -> Path | None:
    """Where descriptors and pictures of references are kept between runs, or None when it cannot be written.

    SHAPEWRIGHT_CACHE says where; else it is the user's folder for caches, on Linux ~/.cache/shapewright.
    """
    from platformdirs import user_cache_dir

    usual = user_cache_dir("shapewright", appauthor=False, opinion=False)
    folder = Path(os.environ.get("SHAPEWRIGHT_CACHE") or usual)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    remove_leftovers(folder)
    return folder if os.access(folder, os.W_OK) else None
