"""What pages ask for, checked before anything is done with it; and short answers."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Annotated, Any, Literal, TypeAlias, TypeVar, get_args

import msgspec
from msgspec import Meta, Struct

from shapewright.procedures.facts import Unit
from shapewright.shapes.files import Format
from shapewright.studio.wire.detail import Told
from shapewright.studio.wire.values import Slug, Values
from shapewright.studio.wire.work import JobKind

MOST_SAMPLES = 10_000
"""More would fill a disk without anybody looking at them."""
MOST_SHAPES = 100
"""More do not fit on a screen."""
MOST_SEED = 2**53
"""More are no whole numbers in a browser."""
MOST_LETTERS = 4000
"""Of a note."""
Tag: TypeAlias = Annotated[str, Meta(min_length=1, max_length=40, pattern=r"^[^\s,](?:[^\x00-\x1f,]*[^\s,])?$")]
Turn: TypeAlias = Annotated[Literal["around", "tip", "over"], Meta(title="Turn")]
"""A quarter turn about the up axis, a quarter turn towards the front, or upside down."""
Part: TypeAlias = Annotated[Literal["replicas", "samples", "report", "parameters"], Meta(title="Part")]
Frame: TypeAlias = Annotated[Literal["procedure", "reference"], Meta(title="Frame")]
"""Axes, units and place: as the procedure builds, or of the reference's file, over which the replica lies then."""
ExportFormat: TypeAlias = Annotated[Format, Meta(title="ExportFormat")]
Request = TypeVar("Request")


class Wrong(ValueError):
    """A request makes no sense; the message says what it should be."""


class Order(Struct, frozen=True, kw_only=True):
    """A request of the page; it may leave out what has a default."""


class Evaluate(Struct, frozen=True, kw_only=True, tag_field="type", tag="evaluate"):
    """Build a replica and measure it."""

    id: int  # rises from one to the next; the answers carry it
    slug: Slug | None = None  # null for a shape alone, measured against nothing
    parameters: Values | None = None  # those left out are as found, or without a slug at their defaults
    beyond: list[str] = []  # names of numbers that may lie outside their Range; all others take the nearest value in it
    residuals: bool = False  # whether to send the two surfaces with their distances


class Explore(Struct, frozen=True, kw_only=True, tag_field="type", tag="explore"):
    """Build, draw and examine many shapes without references, at random or along parameters."""

    id: int  # rises from one to the next; the answers carry it
    seed: Annotated[int, Meta(ge=0, le=MOST_SEED)] = 0  # the same one gives the same random shapes
    count: Annotated[int, Meta(ge=1, le=MOST_SHAPES)] = 24  # of random shapes
    locked: Values = {}  # values that all shapes have
    vary: Annotated[list[str], Meta(max_length=2)] = []  # names of parameters to go along, in place of random shapes
    base: Values | None = None  # what does not vary then; what is left out is at its default


class Visible(Struct, frozen=True, kw_only=True, tag_field="type", tag="visible"):
    """Other tiles are on the screen; their pictures and measures are to come first."""

    slugs: list[Slug]


PageMessage: TypeAlias = Annotated[Evaluate | Explore | Visible, Meta(title="PageMessage")]
"""What the page sends over the WebSocket."""


class Given(Order, frozen=True):
    """Of what replica a picture is asked for."""

    parameters: Values | None = None  # null for those that are shown
    beyond: list[str] = []  # as in Evaluate


class SourceEdit(Order, frozen=True):
    """A new text of the procedure."""

    text: str
    digest: str | None = None  # of the text that the edit began from; null to write over any


class CopyOrder(Order, frozen=True):
    """A text to be put into a new file beside the procedure."""

    text: str


class FitOrder(Order, frozen=True):
    """Fit."""

    fresh: bool = False  # learn anew, and do not resume the run before


class ExportOrder(Order, frozen=True):
    """What to pack."""

    what: Annotated[list[Part], Meta(min_length=1)]
    format: ExportFormat = "glb"  # of meshes; drawings are SVG
    frame: Frame = "procedure"  # of replicas that are meshes
    count: Annotated[int, Meta(ge=1, le=MOST_SAMPLES)] = 50  # of random samples
    seed: Annotated[int, Meta(ge=0)] = 0  # of random samples


class TellOrder(Order, frozen=True):
    """Say something of references, in place of what was told of them before."""

    slugs: Annotated[list[Slug], Meta(min_length=1)]
    told: Told


class NoteOrder(Order, frozen=True):
    """Note something of references; what it does not name stays."""

    slugs: Annotated[list[Slug], Meta(min_length=1)]
    add: list[Tag] = []  # tags
    remove: list[Tag] = []  # tags
    note: Annotated[str, Meta(max_length=MOST_LETTERS)] | None = None  # empty for none
    not_mine: bool | None = None


class TurnOrder(Order, frozen=True):
    """Turn references by right angles, from how they stand now."""

    slugs: Annotated[list[Slug], Meta(min_length=1)]
    turn: Turn


class UnitOrder(Order, frozen=True):
    """Say the unit of the lengths in the files of references."""

    slugs: Annotated[list[Slug], Meta(min_length=1)]
    unit: Unit | None  # null: what the file says


class MarkOrder(Order, frozen=True):
    """Mark a pair of references, or where ``a`` is ``b`` a reference and its own replica."""

    a: Slug
    b: Slug
    same: bool | None  # null takes the mark away


class CancelOrder(Order, frozen=True):
    """End a job."""

    kind: JobKind


class RestoreOrder(Order, frozen=True):
    """Put a run's procedure back, or the text before a write."""

    digest: str | None = None  # as in SourceEdit


class ApplyOrder(Order, frozen=True):
    """Write a suggestion's procedure: beside the procedure, or in its place."""

    to: Literal["copy", "procedure"]
    digest: str | None = None  # as in SourceEdit
    hunks: list[int] | None = None  # numbers of the parts that are accepted, of the text with this digest; null for all


class Source(Struct, frozen=True, kw_only=True):
    """A text of the procedure."""

    path: str
    text: str
    digest: str  # of the text
    unreadable: str | None = None  # why there is no text, as of a file that was deleted; text and digest are empty then


class Replaced(Struct, frozen=True, kw_only=True):
    """The procedure was written."""

    digest: str  # of the new text
    revision: int | None  # number of the write, which can be undone; null where the text was this one already


class Copied(Struct, frozen=True, kw_only=True):
    """A new file was written."""

    path: str
    text: str


class Arrived(Struct, frozen=True, kw_only=True):
    """A file of a reference was put into the project."""

    path: str  # its name in the folder of references
    bytes: int
    there: bool  # the same file was there already, and stays


def _words(kind: Any) -> str:
    return ", ".join(get_args(get_args(kind)[0]))


_SHOULD: Mapping[Any, str] = {
    Evaluate | Explore | Visible: "type is evaluate, explore or visible; id is a whole number, slugs is a list of "
    "strings, parameters, locked and base are mappings of names to values, beyond and vary are lists of names; "
    f"count lies between 1 and {MOST_SHAPES}, seed is a whole number from 0 on, two parameters vary at most",
    Given: "parameters are a mapping of names to values, or null, beyond is a list of names",
    SourceEdit: "text is a string, digest is a string or null",
    CopyOrder: "text is a string",
    FitOrder: "fresh is true or false",
    ExportOrder: f"what is a list of {_words(Part)}; format is one of {_words(ExportFormat)}; "
    f"frame is one of {_words(Frame)}; "
    f"count lies between 1 and {MOST_SAMPLES}; seed is a whole number",
    TellOrder: "slugs is a list of references; told has up and front (x, -x, y, -y, z, -z or null) and split (off, "
    "apart, names or null), and unit (mm, cm, m, in, ft or null)",
    NoteOrder: "slugs is a list of references; add and remove are lists of tags of up to 40 letters without commas, "
    f"note is a text of up to {MOST_LETTERS} letters or null, not_mine is true, false or null",
    UnitOrder: "slugs is a list of references; unit is mm, cm, m, in, ft or null",
    TurnOrder: f"slugs is a list of references; turn is one of {_words(Turn)}",
    CancelOrder: f"kind is one of {_words(JobKind)}",
    RestoreOrder: "digest is a string or null",
    ApplyOrder: "to is copy or procedure, digest is a string or null, hunks is a list of whole numbers or null",
    MarkOrder: "a mark has a, b (slugs of references) and same (true, false or null)",
    dict[str, Any]: "send a JSON object",
}


def decode(body: bytes | str, kind: type[Request]) -> Request:
    """A request of this kind. Raises Wrong."""
    try:
        return msgspec.json.decode(body or b"{}", type=kind)
    except msgspec.ValidationError as error:
        raise Wrong(f"{_SHOULD[kind]} ({error})") from error
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise Wrong(f"the body is no JSON: {error}") from error


def decode_page_message(text: str) -> Evaluate | Explore | Visible:
    """What a page sent over the WebSocket. Raises Wrong."""
    kind: Any = Evaluate | Explore | Visible
    message: Evaluate | Explore | Visible = decode(text, kind)
    return message


def check_known(slugs: Collection[Slug | None], references: Collection[Slug]) -> None:
    """Check that references are there. Raises Wrong."""
    for slug in slugs:
        if slug is not None and slug not in references:
            raise Wrong(f"there is no reference {slug!r}")


def one_of(word: str, name: str, words: Collection[str]) -> str:
    """An entry of a query string that is one of several words. Raises Wrong."""
    if word not in words:
        raise Wrong(f"{name} is one of {', '.join(words)}")
    return word


def number(text: str | None, default: float, low: float, high: float) -> float:
    """A number of a query string, inside its limits. Raises Wrong."""
    try:
        value = default if text is None else float(text)
    except ValueError as error:
        raise Wrong(f"{text!r} is no number") from error
    if not low <= value <= high:
        raise Wrong(f"{value:g} does not lie between {low:g} and {high:g}")
    return value
