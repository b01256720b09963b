"""The steps in which scans are cleaned, by what an author may keep from them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal, TypeAlias, get_args

from shapewright.references.errors import CollectionError

Kept: TypeAlias = Literal["floor", "strays", "density"]
KEPT: tuple[Kept, ...] = get_args(Kept)


def kept(words: Iterable[str]) -> tuple[Kept, ...]:
    """The words as such steps, each once, in their order. Raises CollectionError for another word."""
    given = [words] if isinstance(words, str) else list(words)
    if wrong := sorted(set(given) - set(KEPT)):
        raise CollectionError(f"keep={wrong[0]!r} is nothing that is taken from a scan; use {', '.join(KEPT)}")
    return tuple(word for word in KEPT if word in given)
