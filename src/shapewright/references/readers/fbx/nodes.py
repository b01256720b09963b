"""The nodes of an FBX file: each has a name, values and nodes below, in its binary form as in its text."""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.shapes import Floats, Ints

DEEPEST = 64
"""Levels of nodes. Files have up to eight."""
_LARGEST = 2**29
"""Bytes of an array: more than the points of ten million triangles."""
_EXACT = 2.0**53  # whole numbers beyond are no longer exact as floats


@dataclass(frozen=True, eq=False)
class Packed:
    """An array as the binary form stores it.

    Attributes:
        kind: the type of its values, as numpy writes it.
        count: how many values it has.
        data: its bytes.
        is_compressed: whether they are compressed.
    """

    kind: str
    count: int
    data: memoryview
    is_compressed: bool

    def values(self) -> Floats:
        """(count,). Raises UnreadableError where it is broken or too large."""
        size = self.count * np.dtype(self.kind).itemsize
        if size > _LARGEST:
            raise UnreadableError(f"an array of {size:,} bytes, more than are read")
        data: bytes | memoryview = self.data
        if self.is_compressed:
            try:
                data = zlib.decompressobj().decompress(self.data, size + 1)
            except zlib.error as error:
                raise UnreadableError(f"broken: an array cannot be unpacked ({error})") from error
        if len(data) != size:
            raise UnreadableError(f"broken: an array of {size:,} bytes has {len(data):,}")
        return np.frombuffer(data, self.kind).astype(np.float64)


Value: TypeAlias = int | float | str | Packed | Floats


@dataclass(frozen=True, eq=False)
class Node:
    """A node.

    Attributes:
        name: of its kind.
        values: numbers, texts and arrays.
        below: the nodes in it.
    """

    name: str
    values: Sequence[Value]
    below: Sequence[Node]

    def child(self, name: str) -> Node | None:
        """The first node in it of this name."""
        return next((node for node in self.below if node.name == name), None)

    def children(self, name: str) -> list[Node]:
        """The nodes in it of this name."""
        return [node for node in self.below if node.name == name]

    def text(self, index: int) -> str:
        """The value at an index where it is a text, else an empty one."""
        value = self.values[index] if index < len(self.values) else ""
        return value if isinstance(value, str) else ""

    def floats(self, name: str) -> Floats:
        """The numbers (N,) of the node of this name in it; none without it. Raises UnreadableError, with the reason."""
        node = self.child(name)
        if node is None:
            return np.empty(0)
        inner = node.child("a")
        announced = node.values[0] if inner is not None and node.values else None
        pieces = [np.empty(0)]
        for value in (node if inner is None else inner).values:
            if isinstance(value, str):
                raise UnreadableError(f"broken: {name} has a text among its numbers")
            pieces.append(value.values() if isinstance(value, Packed) else np.atleast_1d(np.float64(value)))
        found = np.concatenate(pieces)
        if announced is not None and announced != len(found):
            raise UnreadableError(f"broken: {name} announces {announced} values, but has {len(found)}")
        return found

    def points(self, name: str) -> Floats:
        """The same in rows of three."""
        found = self.floats(name)
        if len(found) % 3:
            raise UnreadableError(f"broken: {name} has {len(found)} numbers, which is no multiple of 3")
        return found.reshape(-1, 3)

    def integers(self, name: str) -> Ints:
        """The same for whole numbers."""
        found = self.floats(name)
        if not (np.abs(found) < _EXACT).all() or (found != np.floor(found)).any():
            raise UnreadableError(f"broken: {name} has a value that is no whole number")
        return found.astype(np.int64)
