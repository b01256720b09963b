"""Messages of large meshes, kept in the cache, because a million triangles take seconds to read and to make ready."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from shapewright.storage import write_file

LARGE = 4 * 2**20
"""Bytes from which on a message is kept: some two hundred thousand triangles, which take half a second to read."""
_MOST = 2**30
"""Bytes of all that are kept. The oldest are deleted; they are made again when somebody asks for them."""


def keep_message(path: Path | None, message: bytes) -> None:
    """Keep a message where it is large. A cache that cannot be written is done without."""
    if path is None or len(message) < LARGE:
        return
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        write_file(path, message)
        _make_room(path.parent)


def kept_message(path: Path | None) -> bytes | None:
    """None where none is kept."""
    try:
        return path.read_bytes() if path else None
    except OSError:
        return None


def _make_room(folder: Path) -> None:
    kept = [(path.stat(), path) for path in folder.glob("*.mesh")]
    held = 0
    for state, path in sorted(kept, key=lambda one: one[0].st_mtime_ns, reverse=True):
        held += state.st_size
        if held > _MOST:
            path.unlink(missing_ok=True)
