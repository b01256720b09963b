"""How pieces of a fit are written: plain values in a head, then the shapes to the bit."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import msgspec
import numpy as np

from shapewright.building import Build, Failure
from shapewright.fitting.keeping.unfinished import Form, Unfinished
from shapewright.fitting.replicas import Replicas
from shapewright.judging.target import Measures
from shapewright.judging.verdict import Evidence, Grade
from shapewright.shapes import Drawing, Mesh
from shapewright.shapes.packed import pack, unpack

_SAMPLES = "samples-"


class _Row(msgspec.Struct):
    """A build without its arrays."""

    parameters: dict[str, float | int | bool | str]
    failure: Failure | None
    seconds: float
    shape: dict[str, Any] | None


class _Replicas(msgspec.Struct):
    builds: list[_Row | None]
    distances: list[float]
    evidence: list[Evidence]
    fields: list[int]


class Measured(msgspec.Struct, frozen=True):
    """What is measured of the replicas of a chunk, one of each for each reference."""

    measures: list[Measures]
    grades: list[Grade]
    compatible: list[bool]
    places: list[tuple[tuple[float, ...], ...]]


def _rows(builds: Sequence[Build | None]) -> tuple[list[_Row | None], list[bytes]]:
    rows: list[_Row | None] = []
    parts: list[bytes] = []
    for build in builds:
        if build is None:
            rows.append(None)
            continue
        head = None
        if build.shape is not None:
            packed, content = pack(build.shape)
            head = dict(packed)
            parts.append(content)
        rows.append(_Row(dict(build.parameters), build.failure, build.seconds, head))
    return rows, parts


def _builds(rows: Sequence[_Row | None], content: memoryview) -> Iterator[Build | None]:
    start = 0
    for row in rows:
        if row is None:
            yield None
            continue
        shape = None
        if row.shape is not None:
            shape = unpack(row.shape, content[start:])
            start += row.shape["bytes"]
        assert shape is None or isinstance(shape, Mesh | Drawing)
        yield Build(row.parameters, shape, row.failure, row.seconds)


def _plain(value: Any) -> Any:
    """Numbers of numpy as those of Python."""
    if isinstance(value, np.generic):
        return value.item()
    raise NotImplementedError(type(value).__name__)


_ENCODER = msgspec.msgpack.Encoder(enc_hook=_plain)


def _write_builds(builds: Sequence[Build]) -> tuple[bytes, Iterable[bytes]]:
    rows, parts = _rows(builds)
    return _ENCODER.encode(rows), parts


def _read_builds(head: bytes, content: memoryview) -> Sequence[Build]:
    rows = msgspec.msgpack.decode(head, type=list[_Row])
    return [build for build in _builds(rows, content) if build is not None]


def _write_replicas(replicas: Replicas) -> tuple[bytes, Iterable[bytes]]:
    rows, parts = _rows(replicas.builds)
    distances, fields = replicas.distances.tolist(), replicas.fields.tolist()
    return _ENCODER.encode(_Replicas(rows, distances, list(replicas.evidence), fields)), parts


def _read_replicas(head: bytes, content: memoryview) -> Replicas:
    known = msgspec.msgpack.decode(head, type=_Replicas)
    builds = tuple(_builds(known.builds, content))
    return Replicas(builds, np.array(known.distances), tuple(known.evidence), np.array(known.fields, dtype=np.int64))


def _write_measured(measured: Measured) -> tuple[bytes, Iterable[bytes]]:
    return _ENCODER.encode(measured), ()


def _read_measured(head: bytes, _: memoryview) -> Measured:
    return msgspec.msgpack.decode(head, type=Measured)


BUILDS: Form[Sequence[Build]] = Form(_write_builds, _read_builds)
REPLICAS: Form[Replicas] = Form(_write_replicas, _read_replicas)
MEASURED: Form[Measured] = Form(_write_measured, _read_measured)


@dataclass(frozen=True)
class KeptSamples:
    """Samples of an unfinished fit, see ``stock.Pieces``."""

    unfinished: Unfinished

    def builds(self) -> Iterator[Build]:
        for name in self.unfinished.names(_SAMPLES):
            yield from self.unfinished.known(name, BUILDS) or ()

    def put(self, builds: Sequence[Build], seconds: float) -> None:
        number = len(self.unfinished.names(_SAMPLES))
        self.unfinished.offer(f"{_SAMPLES}{number:05d}", BUILDS, builds, seconds)
