"""What the server and the bench say to each other."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

from msgspec import Struct

from shapewright.processes import Limits
from shapewright.settings import Align
from shapewright.studio.project.listing import Origin
from shapewright.studio.wire.answers import (
    DrawingMessage,
    ExploredMessage,
    ExploringMessage,
    FailedMessage,
    VerdictMessage,
)
from shapewright.studio.wire.collection import Axes, Duplicate, Parameter
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.requests import Evaluate, Explore
from shapewright.studio.wire.values import Slug, Values

FetchKind: TypeAlias = Literal["about", "shape", "render", "alike", "map"]


class BenchMessage(Struct, frozen=True, kw_only=True, tag_field="type", tag=str.lower):
    """Any of them; its type is the name of the class."""


class References(BenchMessage, frozen=True):
    """Where the references are, and how replicas are measured."""

    origin: Origin
    cache: str | None  # a folder for pictures and descriptors
    align: Align  # see Settings
    seed: int  # see Settings
    recorded: dict[Slug, dict[str, Any]]  # axes that a run found, see ``found_axes``; where others are found they stay


class Pictures(BenchMessage, frozen=True):
    """Draw these references."""

    slugs: list[Slug]


class First(BenchMessage, frozen=True):
    """The author looks at these; they come before the others."""

    slugs: list[Slug]


class Load(BenchMessage, frozen=True):
    """Take a version of the procedure up."""

    load: int  # its number
    procedure: str
    limits: Limits


class SweepOrder(BenchMessage, frozen=True):
    """Build a replica for each of these parameters, draw and measure it."""

    sweep: int
    items: dict[Slug, Values]
    least: dict[Slug, Values] | None = None  # what those have to be better than to be told; None: all are told


class Live(BenchMessage, frozen=True):
    """Answer a page's evaluation."""

    client: int  # the page
    evaluate: Evaluate


class Exploring(BenchMessage, frozen=True):
    """Answer a page that wants to see shapes without references."""

    client: int  # the page
    order: Explore


class Fetch(BenchMessage, frozen=True):
    """One thing about a reference is asked for."""

    request: int  # number that the reply carries
    slug: Slug | None  # null for a picture of a shape with parameters, which is of no reference
    what: FetchKind  # a map is of all references, and size is its seed
    parameters: Values | None = None
    beyond: list[str] = []  # as in Evaluate
    azimuth: float = 0.0
    elevation: float = 0.0
    size: int = 0


class End(BenchMessage, frozen=True):
    """The server has ended."""


Request: TypeAlias = References | Pictures | First | Load | SweepOrder | Live | Exploring | Fetch | End


class Ready(BenchMessage, frozen=True):
    """The bench listens."""


class Drawn(BenchMessage, frozen=True):
    """A reference was drawn; the payload is a PNG."""

    slug: Slug
    axes: Axes | None  # null where nobody looks for them


class Parted(BenchMessage, frozen=True):
    """The objects in a file stand in its place."""

    slug: Slug
    names: list[str]


class Alike(BenchMessage, frozen=True):
    """All references were looked at."""

    duplicates: list[Duplicate]


class Unreadable(BenchMessage, frozen=True):
    """A reference cannot be read or drawn."""

    slug: Slug
    reason: str


class Loaded(BenchMessage, frozen=True):
    """The procedure was read."""

    load: int
    up: str  # the procedure's axis that points up
    name: str
    parameters: list[Parameter]
    defaults: Values


class Unusable(BenchMessage, frozen=True):
    """The procedure cannot be used."""

    load: int | None  # null where it was usable at first
    problem: Problem


class Swept(BenchMessage, frozen=True):
    """A replica of a sweep was built, or why not; the payload is a PNG of it."""

    sweep: int
    slug: Slug
    parameters: Values
    active: list[str]
    at_limit: list[str]
    problem: Problem | None


class Measured(BenchMessage, frozen=True):
    """A replica of a sweep was measured."""

    sweep: int
    slug: Slug
    fidelity: float | None
    distance: float | None


class Printed(BenchMessage, frozen=True):
    """The procedure has printed something."""

    slug: Slug | None  # of the reference whose replica was built, where it is known
    text: str


class SweepEnded(BenchMessage, frozen=True):
    """A sweep is at its end."""

    sweep: int
    given_up: bool  # too many shapes exceeded the time limit


LiveMessage: TypeAlias = VerdictMessage | DrawingMessage | FailedMessage | ExploringMessage | ExploredMessage


class Answered(BenchMessage, frozen=True):
    """To a page: a message, or None with a binary message as payload; the payload of what was explored is a PNG."""

    client: int
    message: LiveMessage | None


class Reply(BenchMessage, frozen=True):
    """To a Fetch: a message as plain values, or None with a payload."""

    request: int
    message: Any = None
    error: str | None = None  # there is no such thing


News: TypeAlias = Drawn | Parted | Alike | Unreadable | Loaded | Unusable | Swept | Measured | Printed | SweepEnded
"""What is for the session."""
Answer: TypeAlias = Ready | Answered | Reply | News
