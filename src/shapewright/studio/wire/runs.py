"""Runs, and what changed between two of them."""

from __future__ import annotations

from typing import Any, Literal

from msgspec import Struct

from shapewright.studio.wire.board import Collection, Parameter
from shapewright.studio.wire.jobs import Epoch
from shapewright.studio.wire.values import Address, Slug


class Run(Struct, frozen=True, kw_only=True):
    """A run in short.

    created: date and time, ISO 8601.
    references: how many there are.
    compatible: how many of them are.
    groups: how many there are.
    digest: of the procedure's text.
    procedure: its name.
    explained: it has an explanation.
    current: it is the one that is shown.
    """

    run: str
    created: str
    references: int
    compatible: int
    groups: int
    digest: str
    procedure: str
    seconds: float
    explained: bool
    current: bool


class RunDetail(Struct, frozen=True, kw_only=True):
    """A whole run.

    source: text of its procedure.
    seconds: by stage.
    validation: how well each parameter is predicted.
    """

    run: Run
    collection: Collection
    source: str
    parameters: list[Parameter]
    settings: dict[str, Any]
    seconds: dict[str, float]
    curve: list[Epoch]
    validation: dict[str, dict[str, float | str | None]]


class Move(Struct, frozen=True, kw_only=True):
    """A reference whose distance changed.

    slug: null for one that is not in the collection any more.
    """

    name: str
    slug: Slug | None
    before: float | None
    after: float | None
    colour_before: str | None
    colour_after: str | None
    reference: Address | None
    replica_before: Address | None
    replica_after: Address | None


class DiffLine(Struct, frozen=True, kw_only=True):
    """A line of two texts.

    before: its number in the older one, from 1.
    after: its number in the newer one.
    """

    kind: Literal["same", "added", "removed"]
    before: int | None
    after: int | None
    text: str


class Comparison(Struct, frozen=True, kw_only=True):
    """Two runs side by side.

    same: how many references did not move.
    added: names of references.
    removed: names of references.
    diff: of the procedures, whole.
    """

    before: Run
    after: Run
    gained: list[Move]
    lost: list[Move]
    closer: list[Move]
    further: list[Move]
    same: int
    added: list[str]
    removed: list[str]
    diff: list[DiffLine]
