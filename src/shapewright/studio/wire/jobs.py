"""Long work, as the page shows it."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from msgspec import UNSET, Meta, Struct, UnsetType

from shapewright.progress import AnswerKind
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.values import Address

JobKind: TypeAlias = Annotated[Literal["fit", "explain", "export"], Meta(title="JobKind")]
JobState: TypeAlias = Annotated[
    Literal["idle", "running", "cancelling", "done", "cancelled", "failed"], Meta(title="JobState")
]
Answer: TypeAlias = Annotated[AnswerKind, Meta(title="Answer")]
"""Where the parameters come from that are shown before the end of a fit."""


class JobStage(Struct, kw_only=True):
    """A stage of a job, and how far it is."""

    name: str
    done: int
    total: int
    remark: str
    seconds: float


class Epoch(Struct, frozen=True, kw_only=True):
    """Losses of one epoch of training; ``validation`` is null where nothing was held back."""

    epoch: int
    train: float
    validation: float | None


class JobResult(Struct, frozen=True, kw_only=True):
    """What a job made."""

    run: str | UnsetType = UNSET  # name of the run that a fit made or an explanation is of
    url: Address | UnsetType = UNSET  # of the file that an export made
    bytes: int | UnsetType = UNSET  # size of that file


class Job(Struct, frozen=True, kw_only=True):
    """One kind of work, of which at most one runs."""

    kind: JobKind
    state: JobState
    stages: list[JobStage]  # in order; the last one is running. A stage may come again.
    curve: list[Epoch]  # of a fit
    answer: Answer | None  # of a fit: the newest early answer
    seconds: float
    problem: Problem | None
    result: JobResult | None
