"""The text of a procedure's file, whatever kind of file it is."""

from __future__ import annotations

import hashlib
from pathlib import Path

FOREIGN = frozenset({".blend", ".scad", ".toml"})
"""Suffixes of files that are procedures and no Python; ``loading`` knows what reads each."""
BINARY = frozenset({".blend"})
"""Those of them that have no text."""


def is_foreign(path: Path | None) -> bool:
    """Whether a procedure's file is no Python."""
    return path is not None and path.suffix.lower() in FOREIGN


def text_of(path: Path) -> str:
    """The text of a procedure's file; of a binary file a line that says how long it is, and its SHA-256.

    Raises OSError, UnicodeDecodeError.
    """
    if path.suffix.lower() not in BINARY:
        return path.read_text("utf-8")
    content = path.read_bytes()
    return f"{len(content)} bytes, SHA-256 {hashlib.sha256(content).hexdigest()}\n"


def source_digest(source: str) -> str:
    """A key for the text of a procedure, the same in every run and in the studio: 16 hexadecimal digits of SHA-256."""
    return hashlib.sha256(source.encode()).hexdigest()[:16]
