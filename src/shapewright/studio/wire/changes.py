"""The state of the studio, and messages that replace parts of it."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from msgspec import Meta, Struct

from shapewright.settings import Facing, Preset, Refine
from shapewright.studio.wire.collection import Collection, Duplicate, Procedure, Tile
from shapewright.studio.wire.judgement import Judge, Marking
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.revisions import Noted
from shapewright.studio.wire.values import Message, Slug
from shapewright.studio.wire.work import Job, JobKind, Line, Run, Sweep

BenchState: TypeAlias = Literal["starting", "ready", "restarting"]


Scale: TypeAlias = Literal["clear", "paper"]
"""Of grades in the page: colours that differ in lightness, for all eyes; or the paper's green to red."""


class ProjectNames(Struct, frozen=True, kw_only=True):
    """Of the author's project: its name, and where its parts are."""

    name: str
    folder: str
    procedure: str
    references: str
    takes_files: bool  # whether the page may put files among the references


class ChosenSettings(Struct, frozen=True, kw_only=True):
    """What the author chose."""

    auto_fit: bool  # a fit follows every save
    fresh: bool  # fits do not resume the run before
    scale: Scale
    preset: Preset
    samples: int
    epochs: int
    refine: Refine
    facing: Facing
    rounds: int
    seed: int
    judge: Judge
    replicated: float
    close: float
    threshold: float
    vif: float
    shape_seconds: float
    drop: str
    leave_out: str


class State(Message, frozen=True, kw_only=True, tag="state"):
    """Everything. It is the first message, and replaces all."""

    version: str
    project: ProjectNames
    dimension: Literal[2, 3]
    bench: BenchState  # the process that measures; live evaluation waits until it is ready
    procedure: Procedure
    collection: Collection
    jobs: dict[JobKind, Job]
    sweep: Sweep | None  # null while none runs
    runs: list[Run]  # the oldest first
    settings: ChosenSettings
    marking: Marking
    noted: dict[Slug, Noted]  # of the references of which something is noted
    duplicates: list[Duplicate]  # known so far
    explanation: bool  # the run that is shown has one
    console: list[Line]  # what was printed last, the oldest first
    problems: list[Problem]  # of the whole project, the worst first; empty when all is well


class ProcedureChanged(Message, frozen=True, kw_only=True, tag="procedure"):
    """Replaces ``State.procedure``."""

    procedure: Procedure


class TilesChanged(Message, frozen=True, kw_only=True, tag="tiles"):
    """Replaces the tiles with these slugs; one whose slug is not known is new."""

    tiles: list[Tile]


class CollectionChanged(Message, frozen=True, kw_only=True, tag="collection"):
    """Replaces ``State.collection``."""

    collection: Collection


class JobChanged(Message, frozen=True, kw_only=True, tag="job"):
    """Replaces the job of this kind."""

    job: Job


class SweepChanged(Message, frozen=True, kw_only=True, tag="sweep"):
    """Replaces ``State.sweep``."""

    sweep: Sweep | None


class RunsChanged(Message, frozen=True, kw_only=True, tag="runs"):
    """Replaces ``State.runs``."""

    runs: list[Run]


class MarksChanged(Message, frozen=True, kw_only=True, tag="marks"):
    """Replaces ``State.marking``."""

    marking: Marking


class NotedChanged(Message, frozen=True, kw_only=True, tag="noted"):
    """Replaces ``State.noted``."""

    noted: dict[Slug, Noted]


class DuplicatesChanged(Message, frozen=True, kw_only=True, tag="duplicates"):
    """Replaces ``State.duplicates``."""

    duplicates: list[Duplicate]


class SettingsChanged(Message, frozen=True, kw_only=True, tag="settings"):
    """Replaces ``State.settings``."""

    settings: ChosenSettings


class LinesPrinted(Message, frozen=True, kw_only=True, tag="printed"):
    """Lines that follow those of ``State.console``."""

    lines: list[Line]


class ProblemsChanged(Message, frozen=True, kw_only=True, tag="problems"):
    """Replaces ``State.problems``."""

    problems: list[Problem]


class ExplanationChanged(Message, frozen=True, kw_only=True, tag="explanation"):
    """Replaces ``State.explanation``."""

    explanation: bool


class WrongMessage(Message, frozen=True, kw_only=True, tag="wrong"):
    """Answers a message of the page that makes no sense."""

    error: str


Change: TypeAlias = Annotated[
    State
    | ProcedureChanged
    | TilesChanged
    | CollectionChanged
    | JobChanged
    | SweepChanged
    | RunsChanged
    | MarksChanged
    | NotedChanged
    | DuplicatesChanged
    | SettingsChanged
    | LinesPrinted
    | ProblemsChanged
    | ExplanationChanged
    | WrongMessage,
    Meta(title="Change"),
]
"""What the server sends besides answers of live evaluation."""
