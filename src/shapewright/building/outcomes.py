"""The outcome of one attempt at a shape: the shape, or why it failed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal, get_args

from shapewright.building.opened import Opened
from shapewright.parameters import Parameters
from shapewright.procedures import Place, ProcedureError
from shapewright.processes import Loss
from shapewright.shapes import Shape

FailureKind = Literal["infeasible", "raised", "no shape", "time", "memory", "crash"]


@dataclass(frozen=True)
class Failure:
    """Why a shape could not be built.

    kind: what happened.
    message: what was wrong.
    place: the author's line, where it is known.
    printed: the last lines that the author's code printed before.
    """

    kind: FailureKind
    message: str
    place: Place | None = None
    printed: str = field(default="", compare=False)

    def __str__(self) -> str:
        return f"{self.kind}: {self.place.says(self.message) if self.place else self.message}{self._printed}"

    @property
    def _printed(self) -> str:
        return f"; it had printed: {' | '.join(self.printed.splitlines())}" if self.printed else ""

    @property
    def where(self) -> object:
        """Equal for failures of one kind at one line of the author's, whatever their messages say."""
        return (self.kind, self.place) if self.place else self

    def error(self) -> ProcedureError:
        """The same, of a procedure that could not be loaded."""
        return ProcedureError(self.message + self._printed, self.place, "time" if self.kind == "time" else "broken")

    @classmethod
    def of(cls, loss: Loss, printed: str = "") -> Failure:
        """The same, of a shape that was lost with its process."""
        return cls(loss.kind, loss.message, None, printed)

    @classmethod
    def parse(cls, text: str) -> Failure:
        """A failure from its text, as a run's record keeps it; what names no kind gave a shape of no use."""
        kind, _, message = text.partition(": ")
        known: dict[str, FailureKind] = {name: name for name in get_args(FailureKind)}
        return cls(known[kind], message) if kind in known else cls("no shape", text)


@dataclass(frozen=True)
class Build:
    """One attempt at a shape.

    Attributes:
        parameters: what the procedure was called with.
        shape: what it built, None when it failed.
        failure: why it failed, None when it did not.
        seconds: wall time.
        process: number of the process that it was built in; 0 where that is not known.
        opened: files that the author's code read, where the process did not tell them before.
    """

    parameters: Parameters
    shape: Shape | None
    failure: Failure | None = None
    seconds: float = 0.0
    process: int = 0
    opened: tuple[Opened, ...] = field(default=(), compare=False, repr=False)


def describe_failures(builds: Sequence[Build]) -> str:
    """The failures, one entry a line of the author's, commonest first, each with parameters that caused it."""
    example = {build.failure.where: build for build in reversed(builds) if build.failure}
    counts = Counter(build.failure.where for build in builds if build.failure).most_common(3)
    some = [(count, example[where]) for where, count in counts]
    kinds = [f"{count} x {build.failure}, for example with {_call(build.parameters)}" for count, build in some]
    return "; ".join(kinds) or "no failures"


def commonest_place(builds: Sequence[Build]) -> Place | None:
    """The author's line at which most of the failures arose that have one."""
    places = Counter(build.failure.place for build in builds if build.failure and build.failure.place)
    return next((place for place, _ in places.most_common(1)), None)


def _call(parameters: Parameters) -> str:
    return ", ".join(f"{k}={round(v, 6) if isinstance(v, float) else repr(v)}" for k, v in parameters.items())
