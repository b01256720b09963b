"""The collection as the page shows it."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from msgspec import Meta, Struct, convert

from shapewright.references.orientation import AxesBy, Orientation
from shapewright.studio.wire.judgement import Counts, Judge, Judged, Pose
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.values import Address, Axis, Slug, Value

Stage: TypeAlias = Annotated[Literal["none", "carried", "early", "predicted", "trained"], Meta(title="Stage")]
"""How far the replica that is shown is from a finished fit."""


class Axes(Struct, frozen=True, kw_only=True):
    """Which axes of a file point up and to the front, where these are to be found."""

    up: Axis
    front: Axis
    by: Literal["author", "format", "floor", "default", "found"]  # who says so; found: it was turned to stand so

    @classmethod
    def of(cls, orientation: Orientation, by: AxesBy) -> Axes:
        return convert({"up": orientation.up, "front": orientation.front, "by": by}, cls)


class Tile(Judged, frozen=True, kw_only=True):
    """One reference and its replica."""

    slug: Slug
    name: str  # what people read
    reference: Address | None  # its picture, square on transparent; null until it is drawn
    replica: Address | None  # picture of the replica; null until there is one
    axes: Axes | None  # null until they are known, and where nobody looks for them
    group: int | None  # index into the collection's groups; while a fit runs, these are those of the run before
    stage: Stage
    stale: bool  # the replica is of an older version of the procedure
    previous: float | None  # fidelity in the run before; by the paper's judge its distance
    longer: list[str]  # parameters whose longer Range would bring it nearer; empty before an explanation
    pose: Pose | None  # null where the reference stands as its replica, or is not explained
    problem: Problem | None


class Group(Struct, frozen=True, kw_only=True):
    """References that are not replicated and look alike."""

    representative: Slug | None  # the nearest to the group's centre; null when none of its members is there any more
    members: list[Slug]  # the nearest to the centre first


class Skipped(Struct, frozen=True, kw_only=True):
    """A file that could not be read."""

    path: str
    reason: str


class Duplicate(Struct, frozen=True, kw_only=True):
    """A reference that is like one before it."""

    slug: Slug
    of: Slug  # the one before it, which is no duplicate itself
    equal: bool  # it is the same shape but for size, place and format; else it only looks nearly the same
    quarters: int  # quarter turns about the up axis that bring it into the pose of the other


class Collection(Struct, frozen=True, kw_only=True):
    """All references."""

    run: str | None  # the run that is shown; null before the first
    judge: Judge  # that gives the grades
    replicated: float  # the least fidelity of a replicated reference
    close: float  # the least fidelity of a close one
    threshold: float  # the largest distance of a compatible one
    measure: str  # what distances are
    criterion: str  # when a replica is compatible, in words
    count: int  # of all references but those that are left out
    counts: Counts  # of these
    left_out: list[Slug]  # the author says that they are not his
    tiles: list[Tile]  # in natural order of names
    groups: list[Group]  # the largest first
    skipped: list[Skipped]


class Parameter(Struct, frozen=True, kw_only=True):
    """One parameter of the procedure."""

    name: str
    kind: Literal["scalar", "integer", "choice", "binary"]
    low: float | None  # of a scalar or an integer
    high: float | None  # of a scalar or an integer
    steps: int | list[float] | None  # of a scalar: how many values, or which, it is sampled at; it may lie between
    options: list[Value] | None  # of a choice
    default: Value
    meaning: str = ""  # what the author says of it in words
    conditional: bool = False  # it has a ``when``; every evaluation says which parameters are active


class Procedure(Struct, frozen=True, kw_only=True):
    """The procedure on disk."""

    state: Literal["loading", "good", "broken"]  # when broken, the parameters are those of the last good version
    stale: bool  # another version than the file on disk made the run that is shown
    name: str
    digest: str  # of the text on disk
    fitted: str | None  # digest of the version that the newest fit used
    parameters: list[Parameter]
