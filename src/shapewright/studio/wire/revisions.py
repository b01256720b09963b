"""What the author writes and says, which can be undone: the text, and notes of references; and suggestions."""

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


class Hunk(Struct, frozen=True, kw_only=True):
    """A part of a suggestion, to be accepted alone."""

    number: int  # from 0
    lines: list[DiffLine]  # that it changes in the file as it is now, and those around them
    there: bool  # the file has it already
    refused: str | None  # why it does not fit what was written since; null where it does


class Merging(Struct, frozen=True, kw_only=True):
    """A suggestion in the file as it is now."""

    digest: str  # of the file's text, which its parts are of
    hunks: list[Hunk]  # in the order of the file; empty where the file has all of it
    refused: str | None  # why it does not fit as a whole; null where it does


class Noted(Struct, frozen=True, kw_only=True):
    """What the author notes of one reference."""

    tags: list[str] = []
    note: str = ""
    not_mine: bool = False  # no part of the collection: it leaves the count, and the next fit does without it


ToldKind: TypeAlias = Annotated[Literal["tags", "note", "not mine", "file"], Meta(title="ToldKind")]
"""What was told; file: how it stands, its unit, and what it holds."""


class ToldChange(Struct, frozen=True, kw_only=True):
    """One change of what is told of references."""

    number: int  # from 1, the oldest
    written: str  # date and time, ISO 8601, UTC
    kind: ToldKind
    references: list[str]  # names
    added: list[str]  # tags
    removed: list[str]  # tags
    undoes: int | None  # number of the change that this one took back
    undone: bool  # a later one took it back


class ToldAnswer(Struct, frozen=True, kw_only=True):
    """Something was told of references."""

    number: int | None  # of the change, which can be undone; null where nothing changed
