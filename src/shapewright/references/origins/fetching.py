"""Sources by their address, ``s3://bucket/chairs``: what can be read there is fetched into the user's cache, once.

An address is what a stranger answers at: only files of shapes and archives are fetched, no path may lead out of the
folder, and a file that grows beyond all measure is refused. Archives are unpacked by their own rules.
"""

from __future__ import annotations

import hashlib
import re
from pathlib import Path, PurePosixPath
from typing import Any

from shapewright.references.archives import BESIDE, MOST, cache_of, is_archive, unpacked
from shapewright.references.errors import CollectionError, UnreadableError
from shapewright.references.readers.formats import EXTENSIONS
from shapewright.storage import whole_file
from shapewright.threads import in_threads

_SCHEMES = ("s3", "gs", "gcs", "https", "http", "memory")
"""Of addresses that are asked: others run programs, or read this machine in another way than its paths do."""
_PACKED = ("zip", "tar")
_FILES = 1_000_000
"""At one address, at most."""
_AT_ONCE = 8
"""Files that are fetched at the same time: most of it is waiting."""
_BLOCK = 2**20
_FOLDER = "fetched"  # in the cache


def is_address(origin: str) -> bool:
    """Whether a source is an address, and no path."""
    return re.match(r"[a-z0-9+]{2,}(://|::)", origin) is not None


def fetched(address: str) -> Path:
    """What is at an address, as a file, a folder or a pattern of this machine.

    ``https://host/chair.glb``, ``s3://bucket/chairs`` with all files below, ``gs://bucket/*.obj``, and
    ``zip://chairs/*.obj::https://host/all.zip`` for some files of an archive, as fsspec writes these. A file that has
    not changed there is not fetched again. Raises CollectionError, which says what to do.
    """
    outer, chained, rest = address.partition("::")
    scheme, _, inside = outer.partition("://")
    if chained:
        return _in_archive(address, scheme, inside, rest)
    if scheme not in _SCHEMES:
        known = ", ".join(f"{each}://" for each in (*_SCHEMES[:-1], *_PACKED))
        raise CollectionError(f"{address}: references are read from paths and from {known}")
    try:
        import fsspec

        system, path = fsspec.core.url_to_fs(address)
        files = _files(system, path, address)
        folder = cache_of(_FOLDER) / _digest(address)
        places = in_threads(lambda one: _file(system, *one, folder), files, _AT_ONCE)
    except ImportError as error:
        raise CollectionError(f"{address}: {error}: pip install 'shapewright[remote]'") from error
    except (CollectionError, KeyboardInterrupt):
        raise
    except FileNotFoundError as error:
        raise CollectionError(f"{address}: there is nothing at this address") from error
    except Exception as error:  # a service may refuse in any way of its own
        raise CollectionError(f"{address}: it cannot be fetched: {type(error).__name__}: {error}") from error
    return places[0] if len(files) == 1 and files[0][0] == path else _shown(folder, places)


def _files(system: Any, path: str, address: str) -> list[tuple[str, PurePosixPath, dict[str, Any]]]:
    """The files at an address that are worth fetching: where each is, its path in our folder, and its state."""
    magic = "*[" if path.startswith("http") else "*?["  # a question mark of the web begins a query
    if not any(mark in path for mark in magic):
        state = system.info(path)
        if state["type"] == "file" and (_is_wanted(path) or _is_one(path)):
            return [(path, PurePosixPath(PurePosixPath(path.split("?")[0]).name), state)]
        there = system.find(path, detail=True)
        base = path.rstrip("/") + "/"
    else:
        there = system.glob(path, detail=True)
        base = re.split(r"[*?\[]", path)[0].rpartition("/")[0] + "/"
    found = []
    for number, (name, state) in enumerate(sorted(there.items())):
        if number == _FILES:
            raise CollectionError(f"{address}: more than {_FILES:,} files; give a pattern for those that you need")
        inside = PurePosixPath(name.removeprefix(base).lstrip("/"))
        if not name.startswith(base) or ".." in inside.parts or "\\" in str(inside):
            raise CollectionError(f"{address}: it names a file that is not below it: {name!r}")
        if state["type"] == "file" and _is_wanted(name) and not any(part.startswith(".") for part in inside.parts):
            found.append((name, inside, state))
    if not found:
        raise CollectionError(f"{address}: there are no shapes at this address")
    return found


def _file(system: Any, name: str, inside: PurePosixPath, state: dict[str, Any], folder: Path) -> Path:
    """A file in the cache, fetched where it is not there as it is now."""
    told = [state.get(key) for key in ("size", "ETag", "etag", "LastModified", "mtime", "created", "md5Hash")]
    target = folder / _digest(repr(told)) / inside
    if target.is_file():
        return target
    target.parent.mkdir(parents=True, exist_ok=True)
    written = 0
    with whole_file(target) as partial, system.open(name, "rb") as source, partial.open("wb") as sink:
        while block := source.read(_BLOCK):
            written += len(block)
            if written > MOST:
                raise CollectionError(f"{name}: a file of more than {MOST // 2**20:,} MiB; fetch it by hand")
            sink.write(block)
    return target


def _shown(folder: Path, places: list[Path]) -> Path:
    """A folder with links to these files alone, each at its path there."""
    inside = [place.relative_to(folder).parts[1:] for place in places]
    view = folder / f"view-{_digest(repr(places))}"
    for place, parts in zip(places, inside, strict=True):
        link = view.joinpath(*parts)
        if not link.exists():
            link.parent.mkdir(parents=True, exist_ok=True)
            link.symlink_to(place)
    return view


def _in_archive(address: str, scheme: str, inside: str, rest: str) -> Path:
    """Files of an archive at an address, or at a path of this machine."""
    if scheme not in _PACKED or "::" in rest:
        raise CollectionError(f"{address}: before :: there may be zip:// or tar:// with a path or a pattern, once")
    archive = fetched(rest) if is_address(rest) else Path(rest).expanduser()
    if not is_archive(archive) or not archive.is_file():
        raise CollectionError(f"{address}: {archive.name} is no archive of a kind that is read")
    if ".." in PurePosixPath(inside).parts:
        raise CollectionError(f"{address}: the path leads out of the archive")
    try:
        folder = unpacked(archive)
    except UnreadableError as error:
        raise CollectionError(f"{address}: {error}") from error
    return folder / inside.lstrip("/") if inside.strip("/") else folder


def _is_wanted(name: str) -> bool:
    return PurePosixPath(name.split("?")[0]).suffix.lower() in (*EXTENSIONS, *BESIDE) or is_archive(Path(name))


def _is_one(path: str) -> bool:
    """Whether a file that was named alone is fetched whatever its name: its reader says then what is wrong with it."""
    last = re.sub(r"^https?://[^/]*", "", path.split("?")[0])  # a server without a path has a page that lists files
    return PurePosixPath(last).suffix != "" and not last.endswith("/")


def _digest(text: str) -> str:
    return hashlib.blake2b(text.encode(errors="surrogateescape"), digest_size=8).hexdigest()
