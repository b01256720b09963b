"""Thumbnails by the digest of what they show, so that a browser may keep them for ever."""

from __future__ import annotations

import hashlib
from pathlib import Path

from shapewright.studio.project.workspace import Missing


class Pictures:
    """PNGs in memory, and files that are read when they are asked for.

    homes: folders that these must lie in.
    """

    def __init__(self, *homes: Path) -> None:
        self._homes = [home.resolve() for home in homes]
        self._known: dict[str, bytes | Path] = {}
        self._old: set[str] = set()  # digests of those that were there when pictures were forgotten last

    def add(self, png: bytes) -> str:
        """The address of a picture."""
        return self._put(hashlib.blake2b(png, digest_size=12), png)

    def add_file(self, path: Path) -> str | None:
        """The address of a picture on disk; None where it is not there, or a link that leads out of the homes."""
        try:
            state = path.stat()
        except OSError:
            return None
        if not any(path.resolve().is_relative_to(home) for home in self._homes):
            return None
        return self._put(hashlib.blake2b(repr((path, state.st_mtime_ns, state.st_size)).encode(), digest_size=12), path)

    def read(self, digest: str) -> bytes:
        """Raises Missing for one that is not known or not there any more."""
        picture = self._known.get(digest)
        if isinstance(picture, bytes):
            return picture
        try:
            if picture:
                return picture.read_bytes()
        except FileNotFoundError:
            pass
        raise Missing("there is no such picture any more")

    def keep(self, addresses: set[str]) -> None:
        """Forget the pictures in memory but these and new ones: a page may ask for what was shown a moment ago."""
        self._known = {
            digest: picture
            for digest, picture in self._known.items()
            if isinstance(picture, Path) or _address(digest) in addresses or digest not in self._old
        }
        self._old = {*self._known}

    def _put(self, total: hashlib.blake2b, picture: bytes | Path) -> str:
        digest = total.hexdigest()
        self._known[digest] = picture
        self._old.discard(digest)
        return _address(digest)


def _address(digest: str) -> str:
    return f"/api/pictures/{digest}.png"
