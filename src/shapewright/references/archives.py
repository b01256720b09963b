"""Archives of shapes: what can be read of one is unpacked into the user's folder for caches, once.

An archive is what a stranger has sent: no path may lead out of the folder, links and devices are passed over, and an
archive that grows beyond all measure is refused.
"""

from __future__ import annotations

import atexit
import hashlib
import re
import shutil
import tarfile
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from functools import cache, partial
from pathlib import Path, PurePosixPath
from typing import IO, NamedTuple, TypeAlias

from shapewright.processes import Limits, Loss
from shapewright.processes.calls import Calls
from shapewright.references.errors import UnreadableError
from shapewright.references.other_kinds import refusal
from shapewright.references.readers.formats import EXTENSIONS
from shapewright.storage import cache_folder, whole_folder

_NAMES = (".zip", ".tar", ".tar.gz", ".tgz", ".tar.bz2", ".tbz2", ".tar.xz", ".txz")
BESIDE = (".bin",)  # buffers of glTF
_FOLDER = "archives"  # in the cache
_GROWTH, _SMALL, MOST = 100, 64 * 2**20, 4 * 2**30
"""An archive may unpack to this many times its size; one that stays small, to 64 MiB; none to more than 4 GiB. Meshes
in text shrink to a tenth at most; a bomb grows a thousand times (measured on zeros)."""
_MEMBERS = 100_000
_BLOCK = 2**20
_HERE = 4 * 2**20  # bytes of a ZIP that is unpacked in this process
_LIMITS = Limits(seconds=600.0, memory_mb=1024)
"""4 GiB of bzip2, the slowest, take 300 s."""


class _Job(NamedTuple):
    """An archive, the folder to fill, and how many bytes may come of it."""

    path: Path
    folder: Path
    most: int


def is_archive(path: Path) -> bool:
    """Whether a file is an archive that is read, by its name."""
    return path.name.lower().endswith(_NAMES)


def stem(path: Path) -> str:
    """The name of an archive without its extension."""
    return re.sub(r"(\.tar)?\.\w+$", "", path.name)


def unpacked(path: Path) -> Path:
    """The folder that holds what can be read of an archive, as it is now; files of other kinds are there, empty.

    Raises UnreadableError for an archive that is broken, encrypted, hostile or too large, and where there is no room.
    """
    try:
        state, kept = path.stat(), cache_of(_FOLDER)
        where, now = (_digest(path.resolve()), _digest((state.st_mtime_ns, state.st_size)))
        folder = kept / f"{where}-{now}"
        if not folder.is_dir():
            for older in kept.glob(f"{where}-*"):
                shutil.rmtree(older, ignore_errors=True)
            with whole_folder(folder) as growing:
                _fill(_Job(path, growing, min(MOST, max(_SMALL, _GROWTH * state.st_size))), state.st_size)
    except OSError as error:
        if not folder.is_dir():  # else another process was faster
            raise UnreadableError(f"an archive that cannot be unpacked: {error.strerror or error}") from error
    return folder


def _fill(job: _Job, size: int) -> None:
    """Unpack an archive of ``size`` bytes, in a process of its own unless it is a small ZIP. Raises UnreadableError.

    A tar file may hold headers of any length, and what packs it may ask for any memory.
    """
    if size <= _HERE and job.path.suffix.lower() == ".zip":
        why: str | Loss | None = _unpacked(job)
    else:
        with Calls(_unpacked, 1) as calls:
            (why,) = calls.results([(job, _LIMITS)])
    if why:
        raise UnreadableError(f"unpacking {why.message}" if isinstance(why, Loss) else why)


def _unpacked(job: _Job) -> str:
    """Why an archive cannot be unpacked; empty where it was."""
    try:
        _unpack(job.path, job.folder, job.most)
    except UnreadableError as error:
        return str(error)
    except MemoryError:
        raise
    except OSError as error:
        return f"an archive that cannot be unpacked: {error.strerror or error}"
    except Exception as error:  # noqa: BLE001 - a broken archive can make a decoder fail in any way
        return f"a broken archive: {error or type(error).__name__}"
    return ""


def _digest(value: object) -> str:
    return hashlib.blake2b(repr(value).encode(errors="surrogateescape"), digest_size=8).hexdigest()


@cache
def cache_of(name: str) -> Path:
    """A folder of this name in the user's cache; where that cannot be written, one that ends with the process."""
    kept = cache_folder()
    if kept:
        (kept / name).mkdir(exist_ok=True)
        return kept / name
    folder = tempfile.mkdtemp(prefix="shapewright-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return Path(folder)


def _unpack(path: Path, folder: Path, most: int) -> None:
    """Write the members of an archive that are read, and empty files for those of other kinds that are shapes."""
    written = 0
    with path.open("rb") as file:
        zipped = zipfile.is_zipfile(file)
    for number, (name, size, opened) in enumerate(_in_zip(path) if zipped else _in_tar(path)):
        inside = PurePosixPath(name.replace("\\", "/"))
        if inside.is_absolute() or ".." in inside.parts or re.match(r"[A-Za-z]:", name):
            raise UnreadableError(f"an archive with a path that leads out of it: {name!r}")
        if number >= _MEMBERS:
            raise UnreadableError(f"an archive of more than {_MEMBERS} files; unpack it and give what you need")
        is_read = inside.suffix.lower() in (*EXTENSIONS, *BESIDE)
        if not zipped or is_read:
            written += size  # a packed tar is unpacked as a whole
        if written > most:
            raise UnreadableError(f"an archive that unpacks to more than {most // 2**20} MiB; unpack it by hand")
        if any(part.startswith(".") or part == "__MACOSX" for part in inside.parts):
            continue
        target = folder / inside
        if is_read:
            target.parent.mkdir(parents=True, exist_ok=True)
            with opened() as source, target.open("wb") as sink:
                for _ in range(-(-size // _BLOCK)):
                    sink.write(source.read(_BLOCK))
        elif refusal(target):
            target.parent.mkdir(parents=True, exist_ok=True)
            target.touch()


_Member: TypeAlias = tuple[str, int, Callable[[], IO[bytes]]]


def _in_zip(path: Path) -> Iterator[_Member]:
    """The files of an archive: their names, their sizes in bytes, and how to open them."""
    with zipfile.ZipFile(path) as archive:
        for member in archive.infolist():
            if member.flag_bits & 1:
                raise UnreadableError("an archive with a password; unpack it")
            if not member.is_dir():
                yield member.filename, member.file_size, partial(archive.open, member)


def _in_tar(path: Path) -> Iterator[_Member]:
    with tarfile.open(path) as archive:
        for member in archive:
            if member.isreg():
                yield member.name, member.size, partial(_of_tar, archive, member)


def _of_tar(archive: tarfile.TarFile, member: tarfile.TarInfo) -> IO[bytes]:
    opened = archive.extractfile(member)
    assert opened is not None, "a regular file"
    return opened
