"""Answers of live evaluation: shapes, and what the judge says of them; and shapes without references.

Meshes travel in binary messages.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from typing import Annotated, Any, Literal, TypeAlias

import numpy as np
from msgspec import UNSET, Meta, Struct, UnsetType, field
from msgspec.structs import replace
from numpy.typing import NDArray

from shapewright.studio.wire.judgement import Grade, Measures, Piece
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.values import Address, Message, Slug, Value, Values, encode

Side: TypeAlias = Annotated[Literal["replica", "reference"], Meta(title="Side")]
BufferKind: TypeAlias = Annotated[Literal["f32", "u32", "i32"], Meta(title="BufferKind")]
Buffer: TypeAlias = Annotated[tuple[str, BufferKind, int], Meta(title="Buffer")]
"""Name, kind and number of values of a buffer."""
Buffers = Mapping[str, NDArray[Any]]
_KINDS: Mapping[str, BufferKind] = {"f4": "f32", "u4": "u32", "i4": "i32"}


class Extent(Struct, frozen=True, kw_only=True):
    """How large a replica is."""

    size: list[float]  # extents in the procedure's own units


class ShapeMessage(Message, frozen=True, kw_only=True):
    """A shape in the normalised frame. What follows ``shape`` is of a replica alone."""

    id: int  # of the evaluation that it answers; 0 where it answers a request of HTTP
    slug: Slug | None
    shape: Side
    parameters: Values | UnsetType = UNSET  # what the values that were asked for became
    active: list[str] | UnsetType = UNSET  # parameters that matter there
    at_limit: list[str] | UnsetType = UNSET  # parameters at an end of their Range
    units: Extent | UnsetType = UNSET
    milliseconds: float | UnsetType = UNSET  # what the procedure took


class MeshHead(ShapeMessage, frozen=True, kw_only=True, tag="mesh"):
    """Of a binary message: positions (f32, 3 a vertex), indices (u32, 3 a triangle), labels (i32, 1 a triangle)."""

    vertices: int
    triangles: int
    discs: bool = False  # triangles stand for points: their edges are none of the shape
    label_names: list[str]  # ``labels`` are indices into it, -1 without a label; no buffer when nothing is labelled
    buffers: list[Buffer] = field(default_factory=list)


class ResidualsHead(Message, frozen=True, kw_only=True, tag="residuals"):
    """Of a binary message: positions, indices, colours (f32, 3 a vertex, linear light), distances (f32, 1 a vertex)."""

    id: int
    slug: Slug | None
    shape: Side
    vertices: int
    triangles: int
    signed: bool  # distances are negative inside the other shape
    limit: float  # distance at the end of the colour scale
    buffers: list[Buffer] = field(default_factory=list)


class DrawingMessage(ShapeMessage, frozen=True, kw_only=True, tag="drawing"):
    """A drawing as SVG path data, y up, to be filled by the even-odd rule."""

    path: str
    missing: str | None  # what the reference covers and the replica does not
    excess: str | None  # what the replica covers and the reference does not


class VerdictMessage(Message, frozen=True, kw_only=True, tag="verdict"):
    """What the judge says of a replica, as ``Judged`` has it."""

    id: int
    slug: Slug | None
    fidelity: float | None  # null where it cannot be measured
    distance: float | None  # null where it cannot be measured
    measures: Measures
    missing: list[Piece]  # of the reference; the largest first
    surplus: list[Piece]  # of the replica; the largest first
    grade: Grade = "different"
    compatible: bool = False
    colour: str | None = None


class FailedMessage(Message, frozen=True, kw_only=True, tag="failed"):
    """There is no replica at these parameters."""

    id: int
    slug: Slug | None
    problem: Problem
    active: list[str] | None  # null where that is not known


class Soundness(Struct, frozen=True, kw_only=True):
    """Whether a mesh is clean."""

    sound: bool
    closed: bool  # every edge has a face on either side
    manifold: bool
    oriented: bool  # wound outwards
    self_intersections: int  # pairs of faces that cross or overlap
    slivers: int  # faces without height
    components: int
    triangles: int


class Along(Struct, frozen=True, kw_only=True):
    """A parameter that shapes go along."""

    name: str
    values: list[Value]


class ExploringMessage(Message, frozen=True, kw_only=True, tag="exploring"):
    """Shapes without references are on their way."""

    id: int  # of the request that it answers
    shapes: list[Values]  # parameters of each
    along: list[Along]  # the shapes go along these, the last one fastest; empty where they are random
    problem: Problem | None  # why there are none


class ExploredMessage(Message, frozen=True, kw_only=True, tag="explored"):
    """One of these shapes was built, or why not."""

    id: int
    index: int
    parameters: Values
    active: list[str]  # names of parameters that matter there
    picture: Address | None = None
    soundness: Soundness | None  # null of a drawing, of what is too large to be examined, and without a shape
    problem: Problem | None
    given_up: bool = False  # none of the others comes: too many exceeded the time limit


def binary(head: MeshHead | ResidualsHead, buffers: Buffers) -> bytes:
    """A binary message: u32 length of the header, the header as JSON, the buffers; all little-endian, 4-byte aligned.

    buffers: float32, uint32 or int32; the head's field ``buffers`` comes to describe them.
    """
    described = [(name, _KINDS[array.dtype.str[1:]], array.size) for name, array in buffers.items()]
    text = encode(replace(head, buffers=described))
    text += b" " * (-len(text) % 4)
    arrays = (np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("<")) for array in buffers.values())
    return b"".join([struct.pack("<I", len(text)), text, *(array.tobytes() for array in arrays)])


def parse(message: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """The inverse of ``binary``. Raises ValueError for a message that is cut short."""
    (length,) = struct.unpack_from("<I", message)
    header = json.loads(message[4 : 4 + length])
    kinds = {kind: f"<{code}" for code, kind in _KINDS.items()}
    buffers, start = {}, 4 + length
    for name, kind, count in header["buffers"]:
        buffers[name] = np.frombuffer(message, dtype=kinds[kind], count=count, offset=start)
        start += 4 * count
    return header, buffers
