"""Text files that list sources, ``@list.txt``: a path, a pattern or an address a line."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from shapewright.references.errors import CollectionError
from shapewright.references.origins.fetching import fetched, is_address

_MARK = "@"


def is_list(origin: str) -> bool:
    """Whether a source is a list. A file whose name begins with the mark is none."""
    return origin.startswith(_MARK) and not Path(origin).exists()


def listed(origins: Iterable[str | os.PathLike[str]]) -> list[str]:
    """The sources, with those of lists in the place of these. Raises CollectionError for a list that cannot be read."""
    return [each for origin in origins for each in _each(os.fspath(origin))]


def places_of(origins: Iterable[str | os.PathLike[str]]) -> Iterator[Path]:
    """The path of each source on this machine, where what is at an address has been fetched to."""
    return (fetched(each) if is_address(each) else Path(each).expanduser() for each in listed(origins))


def lasting(origin: str | os.PathLike[str]) -> str:
    """The same source from any working folder."""
    text = os.fspath(origin)
    if is_address(text):
        return text
    mark = _MARK if is_list(text) else ""
    return mark + str(Path(text.removeprefix(mark)).expanduser().absolute())


def _each(origin: str) -> Iterator[str]:
    return _lines(origin) if is_list(origin) else iter([origin])


def _lines(origin: str) -> Iterator[str]:
    """Paths are relative to the folder of the list; empty lines are passed over."""
    path = Path(origin.removeprefix(_MARK)).expanduser()
    try:
        lines = path.read_text(encoding="utf-8-sig", errors="surrogateescape").splitlines()
    except OSError as error:
        raise CollectionError(f"{path}: the list of sources cannot be read: {error.strerror or error}") from error
    found = [line.strip() for line in lines if line.strip()]
    if not found:
        raise CollectionError(f"{path} lists nothing; give it a path a line")
    return (line if is_address(line) else str(path.parent / Path(line).expanduser()) for line in found)
