"""Thumbnails by the digest of what they show, so that a browser may keep them for ever."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from pathlib import Path

from shapewright.runs.packed import Packed, find
from shapewright.studio.project.workspace import Missing


class Pictures:
    """PNGs in memory, and files that are read when they are asked for.

    homes: folders that these must lie in.
    """

    def __init__(self, *homes: Path) -> None:
        self._homes = [home.resolve() for home in homes]
        self._known: dict[str, bytes | Path | Packed] = {}
        self._old: set[str] = set()  # digests of those that were there when pictures were forgotten last

    def add(self, png: bytes) -> str:
        """The address of a picture."""
        return self._put(hashlib.blake2b(png, digest_size=12), png)

    def add_file(self, path: Path) -> str | None:
        """The address of a picture on disk; None where it is not there, or a link that leads out of the homes.

        path: also of one that its run has packed.
        """
        found = find(path.parents[1], f"{path.parent.name}/{path.name}")
        if found is None:
            return None
        file = found.tar if isinstance(found, Packed) else found
        try:
            state = file.stat()
        except OSError:
            return None
        if not self._is_inside(file):
            return None
        facts = (path, state.st_mtime_ns, found.size if isinstance(found, Packed) else state.st_size)
        return self._put(hashlib.blake2b(repr(facts).encode(), digest_size=12), found)

    def read(self, digest: str) -> bytes:
        """Raises Missing for one that is not known or not there any more."""
        picture = self._known.get(digest)
        if isinstance(picture, bytes):
            return picture
        try:
            if picture:
                return picture.read() if isinstance(picture, Packed) else picture.read_bytes()
        except FileNotFoundError:
            pass
        raise Missing("there is no such picture any more")

    def keep(self, addresses: set[str]) -> None:
        """Forget the pictures in memory but these and new ones: a page may ask for what was shown a moment ago."""
        self._known = {
            digest: picture
            for digest, picture in self._known.items()
            if isinstance(picture, Path | Packed) or _address(digest) in addresses or digest not in self._old
        }
        self._old = {*self._known}

    def _is_inside(self, file: Path) -> bool:
        real = _real(file.parent) / file.name if not file.is_symlink() else file.resolve()
        return any(real.is_relative_to(home) for home in self._homes)

    def _put(self, total: hashlib.blake2b, picture: bytes | Path | Packed) -> str:
        digest = total.hexdigest()
        self._known[digest] = picture
        self._old.discard(digest)
        return _address(digest)


@lru_cache(maxsize=256)
def _real(folder: Path) -> Path:
    return folder.resolve()


def _address(digest: str) -> str:
    return f"/api/pictures/{digest}.png"
