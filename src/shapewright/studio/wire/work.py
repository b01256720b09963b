"""Jobs, the runs that they make, and what changed between two runs."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from msgspec import UNSET, Meta, Struct, UnsetType

from shapewright.progress import AnswerKind
from shapewright.studio.wire.collection import Collection, Parameter
from shapewright.studio.wire.judgement import Counts, Grade, Judge
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.values import Address, Slug, Values

JobKind: TypeAlias = Annotated[Literal["fit", "explain", "export"], Meta(title="JobKind")]
JobState: TypeAlias = Annotated[
    Literal["idle", "running", "cancelling", "done", "cancelled", "failed"], Meta(title="JobState")
]
Answer: TypeAlias = Annotated[AnswerKind, Meta(title="Answer")]
"""Where the parameters come from that are shown before the end of a fit."""


Speaker: TypeAlias = Annotated[Literal["procedure", "fit", "explain", "export"], Meta(title="Speaker")]
"""Who prints: the procedure while the studio builds with it, or a job with all its workers."""


class Line(Struct, frozen=True, kw_only=True):
    """A line that was printed."""

    number: int  # one more than that of the line before
    speaker: Speaker
    slug: Slug | None  # of the reference whose replica was built, where it is known
    text: str


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


class Job(Struct, kw_only=True):
    """One kind of work, of which at most one runs."""

    kind: JobKind
    state: JobState = "idle"
    stages: list[JobStage] = []  # in order, "open" first; the last one is running. A stage may come again.
    curve: list[Epoch] = []  # of a fit
    answer: Answer | None = None  # of a fit: the newest early answer
    seconds: float = 0.0
    left: float | None = None  # seconds that it is likely to take still; null where nobody knows
    problem: Problem | None = None
    result: JobResult | None = None


class Sweep(Struct, frozen=True, kw_only=True):
    """New replicas of the collection, of which each is built and then measured."""

    done: int  # steps
    total: int  # steps: two for each replica
    seconds: float
    left: float | None  # seconds that it is likely to take still; null where nobody knows


class Run(Struct, frozen=True, kw_only=True):
    """A run in short."""

    run: str
    created: str  # date and time, ISO 8601
    references: int  # how many there are
    judge: Judge  # that gave the grades
    counts: Counts
    groups: int  # how many there are
    digest: str  # of the procedure's text
    procedure: str  # its name
    seconds: float
    explained: bool  # it has an explanation
    current: bool  # it is the one that is shown


class RunDetail(Struct, frozen=True, kw_only=True):
    """A whole run."""

    run: Run
    collection: Collection
    values: dict[Slug, Values]  # parameters of its replicas
    source: str  # text of its procedure
    parameters: list[Parameter]
    settings: dict[str, Any]
    seconds: dict[str, float]  # by stage
    curve: list[Epoch]
    validation: dict[str, dict[str, float | str | None]]  # how well each parameter is predicted


class Move(Struct, frozen=True, kw_only=True):
    """A reference whose fidelity, or by the paper's judge whose distance, changed."""

    name: str
    slug: Slug | None  # null for one that is not in the collection any more
    before: float | None
    after: float | None
    grade_before: Grade
    grade_after: Grade
    colour_before: str | None
    colour_after: str | None
    reference: Address | None
    replica_before: Address | None
    replica_after: Address | None


class DiffLine(Struct, frozen=True, kw_only=True):
    """A line of two texts."""

    kind: Literal["same", "added", "removed"]
    before: int | None  # its number in the older one, from 1
    after: int | None  # its number in the newer one
    text: str


class Comparison(Struct, frozen=True, kw_only=True):
    """Two runs side by side."""

    before: Run
    after: Run
    judge: Judge  # the paper's where the two runs have different ones
    gained: list[Move]
    lost: list[Move]
    closer: list[Move]
    further: list[Move]
    same: int  # how many references did not move
    added: list[str]  # names of references
    removed: list[str]  # names of references
    diff: list[DiffLine]  # of the procedures, whole
