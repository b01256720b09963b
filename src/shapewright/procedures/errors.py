"""What can be wrong with an author's file or function."""

from __future__ import annotations

from typing import Literal

from shapewright.procedures.places import Place


class ProcedureError(Exception):
    """The author's file or function cannot be used; as text it says where and what to do.

    message: what is wrong and what to do, without the place unless ``summary``.
    place: the author's line, where it is known.
    kind: ``"time"`` when the author's code took too long, ``"crash"`` when a program that builds ended instead, else
        ``"broken"``.
    summary: the message is about several shapes and names the place itself.
    """

    def __init__(
        self,
        message: str,
        place: Place | None = None,
        kind: Literal["broken", "time", "crash"] = "broken",
        summary: bool = False,
    ) -> None:
        super().__init__(message, place, kind, summary)
        self.message, self.place, self.kind, self.summary = message, place, kind, summary

    def __str__(self) -> str:
        return self.place.says(self.message) if self.place and not self.summary else self.message


class Infeasible(Exception):
    """Raised by a procedure for parameters that have no shape: ``raise Infeasible("the shelves do not fit")``."""
