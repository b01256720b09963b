"""A suggestion, merged into the author's file as it is now: whole, or part by part."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from shapewright.procedures import source_digest
from shapewright.studio.project.workspace import Conflict, Missing
from shapewright.studio.session import queries
from shapewright.studio.session.history import source_of
from shapewright.studio.session.job_list import Refused
from shapewright.studio.session.session import Session
from shapewright.studio.wire.revisions import Hunk, Merging
from shapewright.studio.wire.work import DiffLine

if TYPE_CHECKING:
    from shapewright.feedback.writing.hunks import Hunk as Part
    from shapewright.feedback.writing.hunks import Merging as Parts

_AROUND = 2
"""Lines that are shown before and after each part."""


@dataclass(frozen=True)
class _Suggested:
    """A suggestion beside the file as it is now."""

    given: Mapping[str, Any]
    now: str
    digest: str
    parts: Parts


def merging(session: Session, index: int) -> Merging:
    """The parts of a suggestion in the file as it is now. Raises Missing for one that is not there."""
    found = _suggested(session, index)
    lines = found.now.splitlines()
    hunks = [_hunk(number, part, lines) for number, part in enumerate(found.parts.hunks)]
    return Merging(digest=found.digest, hunks=hunks, refused=found.parts.refused)


def applied(session: Session, index: int, chosen: Sequence[int] | None, digest: str | None) -> tuple[str, str]:
    """The procedure's text as it is now with a suggestion for the run that is shown; and what was applied, in words.

    chosen: numbers of the parts that are accepted; None for all of it. digest: of the text that the parts are of.
    Raises Missing for a suggestion that is not there, Refused where it does not fit what the author has written since,
    Conflict where parts are of another text.
    """
    from shapewright.feedback.writing.hunks import accepted
    from shapewright.feedback.writing.source import EditError

    found = _suggested(session, index)
    title, parts = str(found.given["title"]), found.parts
    if chosen is not None and digest != found.digest:
        raise Conflict(found.now, found.digest)
    if chosen is None and parts.refused:
        raise Refused(f"{parts.refused}. Accept the parts that fit one by one, or explain the file as it is now.")
    try:
        text = accepted(found.now, parts.hunks, range(len(parts.hunks)) if chosen is None else chosen)
    except EditError as error:
        raise Refused(str(error)) from error
    some = chosen is not None and len(set(chosen)) < len(parts.hunks)
    return text, f"{title} ({len(set(chosen or ()))} of {len(parts.hunks)} parts)" if some else title


def _suggested(session: Session, index: int) -> _Suggested:
    from shapewright.feedback.writing.change import FileChange  # libcst loads slowly
    from shapewright.feedback.writing.hunks import merging as merged
    from shapewright.feedback.writing.source import EditError

    suggestions, run = queries.explanation(session)["suggestions"], session.display.run
    given: Mapping[str, Any] = suggestions[index] if index < len(suggestions) else {}
    if run is None or not isinstance(given.get("source"), str):
        raise Missing("this suggestion has no procedure to apply")
    before, (now, digest) = source_of(run), session.project.read_source()
    if source_digest(before) == digest:
        before = now
    try:
        change = FileChange.from_record(given["change"]) if given.get("change") else None
    except EditError:
        change = None
    return _Suggested(given, now, digest, merged(change, before, given["source"], now))


def _hunk(number: int, part: Part, lines: Sequence[str]) -> Hunk:
    """As the page gets it. lines: of the file as it is now."""
    at, gone = part.at, len(part.removed)
    grown = 0 if part.there else len(part.added) - gone
    end = at if part.there else at + gone
    around = [DiffLine(kind="same", before=i + 1, after=i + 1, text=lines[i]) for i in range(max(0, at - _AROUND), at)]
    removed = [
        DiffLine(kind="removed", before=at + i + 1, after=None, text=_bare(t)) for i, t in enumerate(part.removed)
    ]
    added = [DiffLine(kind="added", before=None, after=at + i + 1, text=_bare(t)) for i, t in enumerate(part.added)]
    behind = [
        DiffLine(kind="same", before=i + 1, after=i + 1 + grown, text=lines[i])
        for i in range(end, min(len(lines), end + _AROUND))
    ]
    shown = added if part.there else [*around, *removed, *added, *behind]
    return Hunk(number=number, lines=shown, there=part.there, refused=part.refused)


def _bare(line: str) -> str:
    return line.rstrip("\r\n")
