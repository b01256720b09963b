"""The tables behind the header of a PLY file: rows of numbers and of lists of numbers, as text or as bytes."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.text import PADDING, rows
from shapewright.shapes import Ints

_OLD_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4"}
_NEW_TYPES = {f"{sign}int{8 * size}": f"{sign or 'i'}{size}" for sign in ("", "u") for size in (1, 2, 4, 8)}
_FLOAT_TYPES = {"float": "f4", "float32": "f4", "double": "f8", "float64": "f8"}
TYPES = _OLD_TYPES | _NEW_TYPES | _FLOAT_TYPES
"""numpy's name of each type that a header may use."""
_STRUCT = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "i8": "q", "u8": "Q", "f4": "f", "f8": "d"}
_Values: TypeAlias = np.ndarray[Any, np.dtype[Any]]


@dataclass(frozen=True)
class Property:
    """One property of an element; ``length`` is the type of the count before a list, None for a single value."""

    name: str
    type: str
    length: str | None = None


@dataclass(frozen=True)
class Element:
    """A table that the header declares: its name, how many rows it has, and what each row holds."""

    name: str
    count: int
    properties: tuple[Property, ...]

    def having(self, added: Property) -> Element:
        """With one property more."""
        return replace(self, properties=(*self.properties, added))


@dataclass(frozen=True, eq=False)
class Column:
    """A property in all rows.

    Attributes:
        values: (N,) the values, one row after the other.
        counts: (R,) how many of them each row has.
        is_list: whether it is a list.
    """

    values: _Values
    counts: Ints
    is_list: bool


Tables: TypeAlias = dict[str, Mapping[str, Column]]
_Take: TypeAlias = Callable[[Ints, str], _Values]


def ascii_tables(elements: Sequence[Element], body: bytes) -> tuple[Tables, tuple[str, ...]]:
    """The tables of a text, and notes on what was left out. Raises UnreadableError where it does not fit the header.

    A row is a line. Where there are more or fewer lines than rows, the numbers count as one row of tokens, which have
    to be used up exactly.
    """
    table = rows(body)
    values = table.values
    declared = sum(element.count for element in elements if element.properties)
    if len(table) != declared:
        doubles = [replace(e, properties=tuple(_as_double(p) for p in e.properties)) for e in elements]
        try:
            return binary_tables(doubles, values.tobytes(), "=")
        except UnreadableError as error:
            less = "cut short" if len(table) < declared else "broken"
            raise UnreadableError(f"{less}: it has {len(table)} rows, and its header declares {declared}") from error
    tables: Tables = {}
    notes: list[str] = []
    first = 0
    for element in elements:
        last = first + element.count if element.properties else first
        starts, ends = table.starts[first:last], table.starts[first + 1 : last + 1]
        tables[element.name], at = _columns(element, starts, ends, lambda at, _: values[at], lambda _: 1)
        surplus = int((at < ends).sum())
        if surplus:
            notes.append(f"{surplus} rows {element.name!r} hold more values than the header declares: left out")
        first = last
    return tables, tuple(notes)


def _as_double(p: Property) -> Property:
    return replace(p, type="f8", length="f8" if p.length else None)


def _columns(
    element: Element, starts: Ints, ends: Ints, take: _Take, size: Callable[[str], int]
) -> tuple[Mapping[str, Column], Ints]:
    """The columns of rows that begin at ``starts``, and where each row's last value ends.

    Args:
        ends: where each row has to end at the latest.
        take: values at places, of a type.
        size: of a value of a type, as places count.
    """
    columns: dict[str, Column] = {}
    at = starts
    for p in element.properties:
        counts = np.ones(len(at), dtype=np.int64)
        if p.length:
            if (at + size(p.length) > ends).any():
                raise _short(element, at + size(p.length) > ends)
            lengths = take(at, p.length)
            if len(lengths) and not np.all((lengths >= 0) & (lengths % 1 == 0) & (lengths <= ends - at)):
                raise _short(element, ~((lengths >= 0) & (lengths % 1 == 0) & (lengths <= ends - at)))
            counts = lengths.astype(np.int64)
            at = at + size(p.length)
        if (at + counts * size(p.type) > ends).any():
            raise _short(element, at + counts * size(p.type) > ends)
        columns[p.name] = Column(take(_places(at, counts, size(p.type)), p.type), counts, p.length is not None)
        at = at + counts * size(p.type)
    return columns, at


def _short(element: Element, which: np.ndarray[Any, np.dtype[np.bool_]]) -> UnreadableError:
    row = int(np.flatnonzero(which)[0])
    return UnreadableError(f"broken: row {row} of {element.name!r} holds fewer values than the header declares")


def _places(at: Ints, counts: Ints, size: int) -> Ints:
    """Where each value is, of runs of ``counts`` values that begin at ``at``."""
    if len(counts) and (counts == counts[0]).all():
        return np.asarray((at[:, None] + size * np.arange(int(counts[0]))).reshape(-1))
    firsts = np.cumsum(counts) - counts
    return np.asarray(np.repeat(at - size * firsts, counts) + size * np.arange(int(counts.sum())))


def binary_tables(elements: Sequence[Element], body: bytes, order: str) -> tuple[Tables, tuple[str, ...]]:
    """The tables of bytes, of which nothing may be left over; no notes. order: of the bytes, ``<``, ``>`` or ``=``."""
    tables: Tables = {}
    start = 0
    for element in elements:
        tables[element.name], start = _binary_table(element, body, start, order)
    left = len(body) - start
    if left and body[start:].strip(PADDING):
        raise UnreadableError(f"broken: {left} bytes follow what its header declares")
    return tables, ()


def _binary_table(element: Element, body: bytes, start: int, order: str) -> tuple[Mapping[str, Column], int]:
    """The columns of an element that begins at ``start`` of the body, and where the next one begins."""
    lists = [p for p in element.properties if p.length]
    if not element.count or not element.properties:
        nothing = {p.name: Column(np.empty(0), np.empty(0, np.int64), p.length is not None) for p in element.properties}
        return nothing, start
    lengths = iter(_row_places(replace(element, count=1), body, start, order)[1])
    pairs = [(p, int(next(lengths)) if p.length else 1) for p in element.properties]
    fields = list[tuple[str, str] | tuple[str, str, tuple[int]]]()
    for i, (p, length) in enumerate(pairs):
        fields += [(f"{i} count", order + p.length)] if p.length else []
        fields += [(f"{i}", order + p.type, (length,))]
    row = np.dtype(fields)
    end = start + row.itemsize * element.count
    if end <= len(body):
        table = np.frombuffer(body, row, element.count, start)
        if all((table[f"{i} count"] == length).all() for i, (p, length) in enumerate(pairs) if p.length):
            counts = [np.full(len(table), length, dtype=np.int64) for _, length in pairs]
            return {
                p.name: Column(table[f"{i}"].reshape(-1), counts[i], p.length is not None)
                for i, (p, _) in enumerate(pairs)
            }, end
    if not lists:
        raise _cut_short(element)
    starts = _row_places(element, body, start, order)[0]

    def take(at: Ints, kind: str) -> _Values:
        # One value begins at every byte; numpy reads those that are not aligned.
        size = np.dtype(kind).itemsize
        return np.ndarray((len(body) - size + 1,), order + kind, body, strides=(1,))[at]

    columns, _ = _columns(element, starts[:-1], starts[1:], take, lambda kind: np.dtype(kind).itemsize)
    return columns, int(starts[-1])


def _row_places(element: Element, body: bytes, start: int, order: str) -> tuple[Ints, list[float]]:
    """Where each row begins and the last one ends, (R + 1,), and the lengths of the last row's lists."""
    steps: list[tuple[int, Callable[[bytes, int], tuple[Any, ...]], int, int]] = []
    skipped = 0
    for p in element.properties:
        size = struct.calcsize("=" + _STRUCT[p.type])
        if p.length is None:
            skipped += size
            continue
        prefix = struct.Struct(order + _STRUCT[p.length])
        steps.append((skipped, prefix.unpack_from, prefix.size, size))
        skipped = 0
    starts = [start]
    lengths: list[float] = []
    try:
        for _ in range(element.count):
            lengths = []
            for skip, unpack, prefix_size, size in steps:
                start += skip
                (length,) = unpack(body, start)
                if length < 0 or length % 1:
                    raise UnreadableError(f"broken: a list of {length:g} values among its elements {element.name!r}")
                start += prefix_size + int(length) * size
                lengths.append(length)
            start += skipped
            starts.append(start)
    except struct.error as error:
        raise _cut_short(element) from error
    if start > len(body):
        raise _cut_short(element)
    return np.array(starts, dtype=np.int64), lengths


def _cut_short(element: Element) -> UnreadableError:
    return UnreadableError(f"cut short: it ends among its {element.count} elements {element.name!r}")
