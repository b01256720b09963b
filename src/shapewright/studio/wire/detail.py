"""One reference in full, and explanations.

Explanations are read from ``explanation.json`` of a run and passed on as they are, so their types are those of
dictionaries: fields that are not named here stay.
"""

from __future__ import annotations

from typing import Any, Literal, NotRequired, TypedDict

from msgspec import Struct

from shapewright.procedures.facts import Unit
from shapewright.studio.wire.collection import Stage
from shapewright.studio.wire.judgement import Grade, Judged, Measures, Piece, Pose
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.values import Address, Axis, Slug, Values, Vector


class Units(Struct, frozen=True, kw_only=True):
    """The way back from the normalised frame: own = axes^T @ (normalised / scale + centre). In 2D, vectors of two."""

    centre: list[float]
    scale: float
    axes: list[list[float]]  # unit vectors
    size: list[float]  # extents in own units, along the file's axes


class About(Struct, frozen=True, kw_only=True):
    """What only somebody who has read its file knows of a reference."""

    triangles: int | None  # null of a drawing
    notes: list[str]
    units: Units


class Told(Struct, frozen=True, kw_only=True):
    """What the author says of one file alone; null: what holds for all."""

    up: Axis | None = None  # that points up in it
    front: Axis | None = None  # that points to the front
    unit: Unit | None = None  # of its lengths
    split: Literal["off", "apart", "names"] | None = None  # which objects in it the next fit takes as references


class Placement(TypedDict):
    """Where the replica stood when the two were compared: (normalised - centre) * scale."""

    centre: Vector
    scale: float


class Region(TypedDict):
    """A box around what one surface has and the other has not, in the normalised frame."""

    side: Literal["unexplained", "surplus"]  # unexplained ones are of the reference, surplus ones of the replica
    centre: Vector
    size: Vector
    axes: tuple[Vector, Vector, Vector]  # unit vectors
    share: float | None
    distance: float | None
    label: str | None
    rule: str | None


class Cause(TypedDict):
    """Why a replica differs."""

    kind: str
    text: str
    evidence: Any
    picture: NotRequired[str]  # PNG in base64, where words are not enough


class ReferenceExplanation(TypedDict):
    """Why one reference is not replicated; explanations of earlier versions have no placement."""

    causes: list[Cause]
    remark: NotRequired[Cause | None]  # what still differs in a replica that is good enough
    regions: list[Region]
    placement: NotRequired[Placement]


class SharedCause(TypedDict):
    """References that share a cause."""

    kind: str
    text: str
    references: list[Slug]
    representative: NotRequired[Slug | None]


class ChangedLine(TypedDict):
    """A line of a procedure and its changed version."""

    kind: Literal["same", "added", "removed"]
    before: int | None  # its number in the older one, from 1
    after: int | None  # its number in the newer one
    text: str


class Suggestion(TypedDict):
    """A change of the procedure."""

    kind: str
    title: str
    text: str
    snippet: str | None
    source: str | None  # the procedure with the change; null where there is nothing to apply
    picture: Address | None
    references: list[Slug]  # those that it would help
    gain: float | None
    tried: Any
    diff: NotRequired[list[ChangedLine]]  # lines that it changes, and those around them


class Tried(TypedDict):
    """A change of the procedure that was tried, whether or not it is suggested."""

    title: str
    kind: str
    nearer: int  # misfits that it brought nearer
    best: float | None  # of these, how far the nearest is apart then: at most 1 is replicated
    seconds: float


class ExplainedSample(TypedDict):
    """References that stand for all."""

    explained: int
    of: int
    text: str


class Explanation(TypedDict):
    """The explanation of the run that is shown."""

    references: dict[Slug, ReferenceExplanation]
    summary: list[SharedCause]
    suggestions: list[Suggestion]
    unsuggested: NotRequired[str | None]  # why none are sought
    sample: NotRequired[ExplainedSample]  # where only some were looked at
    tried: NotRequired[list[Tried]]
    seconds: NotRequired[dict[str, float]]  # by stage


class BestChange(Struct, frozen=True, kw_only=True):
    """The change of the procedure that brought most of those that were tried."""

    title: str
    gain: int  # references that become replicated
    nearer: int  # misfits that come nearer, these included
    suggestion: int | None  # its place among the suggestions; null for one that is not suggested


class NextStep(Struct, frozen=True, kw_only=True):
    """What a run leaves to do."""

    group: Slug | None  # representative of the largest group that is not replicated
    members: int  # of that group
    lacks: float | None  # longest piece that the representative's replica lacks, as a share of the shape
    longest: Slug | None  # the reference with the longest region that its replica does not explain
    length: float | None  # of that region, as a share of the shape
    best: BestChange | None  # null before an explanation, and where none brought anything


class ParameterRow(Struct, frozen=True, kw_only=True):
    """The parameters of one replica."""

    slug: Slug
    parameters: Values
    active: list[str]  # names of those that matter


class ParameterTable(Struct, frozen=True, kw_only=True):
    """The parameters of all replicas that are shown."""

    run: str | None  # the run that is shown
    rows: list[ParameterRow]
    validation: dict[str, dict[str, float | str | None]]  # how well each parameter is predicted, on held-out samples
    samples: int | None  # from which the network of this run learned


class MappedReference(Struct, frozen=True, kw_only=True):
    """A reference on the map."""

    slug: Slug
    x: float  # -1 to 1
    y: float


class MappedSample(Struct, frozen=True, kw_only=True):
    """A random shape of the procedure on the map."""

    parameters: Values
    x: float
    y: float


class CollectionMap(Struct, frozen=True, kw_only=True):
    """References and random shapes of the procedure; alike ones are near each other."""

    references: list[MappedReference]
    samples: list[MappedSample]
    left: int  # references that are not looked at yet


class Step(Struct, frozen=True, kw_only=True):
    """One reference in one run."""

    run: str
    created: str  # date and time, ISO 8601
    procedure: str  # digest of its text
    replica: Address | None
    fidelity: float | None
    distance: float | None
    grade: Grade  # by the run's own judge and cuts
    colour: str | None
    parameters: Values | None
    active: list[str]
    error: str | None


class Reference(Judged, frozen=True, kw_only=True):
    """One reference in full."""

    slug: Slug
    name: str
    path: str | None  # of its file, relative to the project where it lies inside
    triangles: int | None  # null of a drawing, and while the bench starts
    notes: list[str]
    units: Units | None  # null while the bench starts
    parameters: Values | None  # of the replica that is shown
    active: list[str]
    at_limit: list[str]
    longer: list[str]  # as in Tile
    measures: Measures  # empty while the replica is not measured whole
    missing: list[Piece]  # of the reference; the largest first
    surplus: list[Piece]  # of the replica; the largest first
    pose: Pose | None  # as in Tile
    told: Told
    group: int | None
    stage: Stage
    problem: Problem | None
    predicted: Values | None  # what the network said, before the search
    spread: dict[str, float] | None  # of scalars, about the size of the error to expect, in the parameter's own units
    likelihood: dict[str, dict[str, float]] | None  # of the values of other parameters; those that are no text as JSON
    explanation: ReferenceExplanation | None
