"""Runs, and what changed between two of them."""

from __future__ import annotations

from typing import Any, Literal

from msgspec import Struct

from shapewright.studio.wire.board import Collection, Parameter
from shapewright.studio.wire.jobs import Epoch
from shapewright.studio.wire.values import Address, Slug


class Run(Struct, frozen=True, kw_only=True):
    """A run in short."""

    run: str
    created: str  # date and time, ISO 8601
    references: int  # how many there are
    compatible: int  # how many of them are
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
    source: str  # text of its procedure
    parameters: list[Parameter]
    settings: dict[str, Any]
    seconds: dict[str, float]  # by stage
    curve: list[Epoch]
    validation: dict[str, dict[str, float | str | None]]  # how well each parameter is predicted


class Move(Struct, frozen=True, kw_only=True):
    """A reference whose distance changed."""

    name: str
    slug: Slug | None  # null for one that is not in the collection any more
    before: float | None
    after: float | None
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
    gained: list[Move]
    lost: list[Move]
    closer: list[Move]
    further: list[Move]
    same: int  # how many references did not move
    added: list[str]  # names of references
    removed: list[str]  # names of references
    diff: list[DiffLine]  # of the procedures, whole
