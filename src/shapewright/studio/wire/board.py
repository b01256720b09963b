"""The collection as the page shows it."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from msgspec import Meta, Struct

from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.values import Address, Slug, Value

Stage: TypeAlias = Annotated[Literal["none", "carried", "early", "predicted", "trained"], Meta(title="Stage")]
"""How far the replica that is shown is from a finished fit."""


class Tile(Struct, frozen=True, kw_only=True):
    """One reference and its replica.

    name: what people read.
    reference: its picture, square on transparent; null until it is drawn.
    replica: picture of the replica; null until there is one.
    distance: null until it is measured, which may be a moment after the replica is shown.
    colour: of the distance: green at 0, yellow at the threshold, red far beyond it.
    group: index into the collection's groups; while a fit runs, these are those of the run before.
    stale: the replica is of an older version of the procedure.
    previous: distance in the run before.
    at_limit: parameters at an end of their Range.
    """

    slug: Slug
    name: str
    reference: Address | None
    replica: Address | None
    distance: float | None
    colour: str | None
    compatible: bool
    group: int | None
    stage: Stage
    stale: bool
    previous: float | None
    at_limit: list[str]
    problem: Problem | None


class Group(Struct, frozen=True, kw_only=True):
    """Incompatible references that look alike.

    representative: the nearest to the group's centre; null when none of its members is there any more.
    members: the nearest to the centre first.
    """

    representative: Slug | None
    members: list[Slug]


class Skipped(Struct, frozen=True, kw_only=True):
    """A file that could not be read."""

    path: str
    reason: str


class Collection(Struct, frozen=True, kw_only=True):
    """All references.

    run: the run that is shown; null before the first.
    measure: what distances are.
    criterion: when a replica is compatible, in words.
    tiles: in natural order of names.
    groups: the largest first.
    """

    run: str | None
    threshold: float
    measure: str
    criterion: str
    count: int
    compatible: int
    tiles: list[Tile]
    groups: list[Group]
    skipped: list[Skipped]


class Parameter(Struct, frozen=True, kw_only=True):
    """One parameter of the procedure.

    low: of a scalar or an integer.
    high: of a scalar or an integer.
    steps: of a scalar: how many values, or which, it is sampled at; any value between is allowed.
    options: of a choice.
    conditional: it has a ``when``; every evaluation says which parameters are active.
    """

    name: str
    kind: Literal["scalar", "integer", "choice", "binary"]
    low: float | None
    high: float | None
    steps: int | list[float] | None
    options: list[Value] | None
    default: Value
    conditional: bool = False


class Procedure(Struct, frozen=True, kw_only=True):
    """The procedure on disk.

    state: when broken, the parameters are those of the last good version.
    stale: the collection shows an older version than the file on disk.
    digest: of the text on disk.
    fitted: digest of the version that the newest fit used.
    """

    state: Literal["loading", "good", "broken"]
    stale: bool
    name: str
    digest: str
    fitted: str | None
    parameters: list[Parameter]


class Mark(Struct, frozen=True, kw_only=True):
    """Whether a person finds two references the same; where ``a`` is ``b``, the reference and its own replica."""

    a: Slug
    b: Slug
    same: bool
