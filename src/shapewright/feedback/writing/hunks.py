"""The pieces of a suggestion's change, to be accepted one by one in the author's file as it is now."""

from __future__ import annotations

import ast
import difflib
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

from shapewright.feedback.writing.change import FileChange
from shapewright.feedback.writing.source import EditError

_Edit = tuple[int, int, int, int]
"""Lines of one text, from and to, and those of another text that stand in their place."""


@dataclass(frozen=True)
class Hunk:
    """Lines that change together.

    Attributes:
        at: how many lines of the file as it is now stand before it.
        removed: the lines that go, with their ends.
        added: the lines that come in their place.
        there: whether the file has it already.
        refused: why it does not fit the file as it is now; None where it does.
    """

    at: int
    removed: tuple[str, ...]
    added: tuple[str, ...]
    there: bool = False
    refused: str | None = None


@dataclass(frozen=True)
class Merging:
    """A change of a file that was edited since.

    Attributes:
        hunks: its pieces, in the order of the file.
        refused: why it does not fit as a whole; None where it does.
    """

    hunks: tuple[Hunk, ...]
    refused: str | None = None


def merging(change: FileChange | None, before: str, after: str, now: str) -> Merging:
    """How a change fits the file as it is now.

    change: as facts, where these are known. before, after: the texts between which it was made.
    """
    if before == now:
        return Merging(_hunks(now, after))
    try:
        if change is None:
            raise EditError("the run does not say what this changes; explain it again")
        return Merging(_hunks(now, change.merged(before, now)))
    except EditError as error:
        return Merging(tuple(_three_ways(before, after, now)), str(error))


def accepted(now: str, hunks: Sequence[Hunk], chosen: Collection[int]) -> str:
    """The file with some of the hunks, by their places in the list.

    Raises EditError for one that is not there or does not fit, and where the text would be no Python any more.
    """
    if unknown := sorted(set(chosen) - set(range(len(hunks)))):
        raise EditError(f"this change has no part {unknown[0] + 1}")
    lines = now.splitlines(keepends=True)
    for number in sorted(chosen, key=lambda number: (-hunks[number].at, -number)):
        hunk = hunks[number]
        if hunk.refused:
            raise EditError(f"part {number + 1} does not fit: {hunk.refused}")
        if not hunk.there:
            lines[hunk.at : hunk.at + len(hunk.removed)] = hunk.added
    text = "".join(_with_ends(lines))
    if _line_of_error(now) is None and (line := _line_of_error(text)):
        raise EditError(f"these parts alone are no Python (line {line}); take those with them that they need")
    return text


def _hunks(before: str, after: str) -> tuple[Hunk, ...]:
    """Between two texts; changes with nothing but empty lines between them are one."""
    old, new = before.splitlines(keepends=True), after.splitlines(keepends=True)
    joined: list[_Edit] = []
    for edit in _edits(old, new):
        if joined and not "".join(old[joined[-1][1] : edit[0]]).strip():
            edit = (joined[-1][0], edit[1], joined.pop()[2], edit[3])
        joined.append(edit)
    return tuple(Hunk(i, tuple(old[i:i_end]), tuple(new[j:j_end])) for i, i_end, j, j_end in joined)


def _three_ways(before: str, after: str, now: str) -> Iterator[Hunk]:
    """The hunks between two texts, where they stand in a third one that was made of the first."""
    old, there = before.splitlines(keepends=True), now.splitlines(keepends=True)
    theirs = list(_edits(old, there))
    for hunk in _hunks(before, after):
        start, end = hunk.at, hunk.at + len(hunk.removed)
        moved = sum((j_end - j) - (i_end - i) for i, i_end, j, j_end in theirs if i_end <= start)
        placed = replace(hunk, at=start + moved)
        touched = next((edit for edit in theirs if _meet(start, end, edit)), None)
        if _has(hunk, there):
            yield replace(placed, there=True)
        elif touched:
            line = touched[2] + 1
            yield replace(placed, at=touched[2], refused=f"you have edited the same lines since (line {line})")
        else:
            yield placed


def _meet(start: int, end: int, theirs: _Edit) -> bool:
    """Whether two edits of one text change the same lines, or add lines at the same place."""
    from_, to = theirs[:2]
    if start == end and from_ == to:
        return start == from_
    if start == end or from_ == to:
        inner, outer = (start, (from_, to)) if start == end else (from_, (start, end))
        return outer[0] < inner < outer[1]
    return max(start, from_) < min(end, to)


def _has(hunk: Hunk, lines: Sequence[str]) -> bool:
    """Whether lines hold what a hunk adds, or where it only removes lines have lost these."""
    wanted = hunk.added or hunk.removed
    found = any(tuple(lines[i : i + len(wanted)]) == wanted for i in range(len(lines) - len(wanted) + 1))
    return found if hunk.added else not found


def _edits(old: Sequence[str], new: Sequence[str]) -> Iterator[_Edit]:
    for kind, i, i_end, j, j_end in difflib.SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if kind != "equal":
            yield i, i_end, j, j_end


def _with_ends(lines: Sequence[str]) -> Iterator[str]:
    """Lines that each have an end, but for the last: one that was the last may have none."""
    for number, line in enumerate(lines, start=1):
        yield line if number == len(lines) or line.endswith(("\n", "\r")) else f"{line}\n"


def _line_of_error(text: str) -> int | None:
    """The line at which a text stops being Python; None where it is Python."""
    try:
        ast.parse(text)
    except SyntaxError as error:
        return error.lineno or 1
    except (ValueError, RecursionError, MemoryError):
        return 1
    return None
