"""What the judge says of a replica, and what the author's marks say of the judge."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from msgspec import Meta, Struct

from shapewright.settings import JudgeName
from shapewright.studio.wire.values import Slug, Vector

Grade: TypeAlias = Annotated[Literal["replicated", "close", "different"], Meta(title="Grade")]
Judge: TypeAlias = Annotated[JudgeName, Meta(title="Judge")]
Measures: TypeAlias = Annotated[dict[str, float | None], Meta(title="Measures")]
"""By name; null for what cannot be measured."""


class Piece(Struct, frozen=True, kw_only=True):
    """A connected piece of one shape that the other does not explain, in a box."""

    size: float  # longest side of the box, as a share of the shape's largest extent
    low: Vector  # corner of the box, in the frame of the normalised reference
    high: Vector  # the opposite corner
    share: float  # of the visible surface or of the area


class Judged(Struct, frozen=True, kw_only=True):
    """How a replica stands to its reference."""

    fidelity: float | None  # 0 to 1; null until it is measured, and in runs of before this judge
    distance: float | None  # the paper's; null until it is measured, which may be a moment after the replica is shown
    grade: Grade  # by the collection's judge; different without a replica
    compatible: bool  # by the paper's measure
    colour: str | None  # of the grade; by the paper's judge of the distance: green at 0, yellow at the threshold, red


class Counts(Struct, frozen=True, kw_only=True):
    """How many references have each grade, and how many are compatible."""

    replicated: int
    close: int
    different: int
    compatible: int  # by the paper's measure


class Pose(Struct, frozen=True, kw_only=True):
    """How a reference stands, where an explanation finds that it stands another way than the replicas."""

    turned: int  # degrees about the up axis
    on_its_head: bool
    mirrored: bool
    text: str  # what it is, and what to do


class Mark(Struct, frozen=True, kw_only=True):
    """Whether a person finds two references the same; where ``a`` is ``b``, the reference and its own replica."""

    a: Slug
    b: Slug
    same: bool


class Learned(Struct, frozen=True, kw_only=True):
    """Which cut the marks ask for: of the fidelity, or by the paper's judge of the distance."""

    judge: Judge
    count: int  # marks whose measure is known
    cut: float
    agrees: int  # marks that it judges as the author
    usual: float  # the cut without marks
    usual_agrees: int  # marks that this one judges as the author


class Marking(Struct, frozen=True, kw_only=True):
    """The marked pairs, what they say, and what to mark next."""

    marks: list[Mark]
    learned: Learned | None  # null while no mark counts
    asked: list[Slug]  # references of the shown run whose marks would decide most, the most first
