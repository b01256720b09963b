"""What was tried before anything is suggested, and how far it got: so that no suggestion is no silence."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Tried:
    """A change of the procedure that was tried on misfits, whether or not it is shown."""

    title: str  # what changes
    kind: str  # as that of a ``Suggestion``
    nearer: int  # misfits that it brought nearer to their references
    best: float  # of these, how far the nearest is apart then: at most 1 is replicated; infinite where none came nearer
    seconds: float  # that it took
