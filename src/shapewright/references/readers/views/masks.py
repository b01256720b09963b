"""Masks beside pictures: chair.mask.png says which part of chair.jpg is the chair."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

_ENDING = ".mask"  # of a mask's name, before its extension


def masks_of(paths: Sequence[Path]) -> dict[Path, Path]:
    """The mask of each of these files that has one among them."""
    named = {path.with_suffix(""): path for path in paths}
    return {path: named[mask] for path in paths if (mask := path.with_suffix(_ENDING)) in named and named[mask] != path}
