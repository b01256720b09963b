"""Writes of the procedure's text, which can be undone."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from msgspec import Meta, Struct

from shapewright.studio.wire.work import DiffLine

Writer: TypeAlias = Annotated[Literal["editor", "suggestion", "run", "undo", "another program"], Meta(title="Writer")]
"""What wrote: the page's editor, a suggestion, going back to a run, an undo; or what is no part of the studio."""


class Revision(Struct, frozen=True, kw_only=True):
    """One write of the procedure."""

    number: int  # from 1, the oldest
    written: str  # date and time, ISO 8601, UTC
    writer: Writer
    of: str  # title of the suggestion, name of the run, number of the write that was undone; else empty
    added: int  # lines
    removed: int  # lines
    before: str  # digest of the text that was there
    after: str  # digest of the text that came


class RevisionDetail(Struct, frozen=True, kw_only=True):
    """One write of the procedure, and what it changed."""

    revision: Revision
    diff: list[DiffLine]  # whole
