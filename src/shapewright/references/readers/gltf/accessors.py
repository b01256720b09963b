"""Arrays in glTF: packed or strided, sparse, of whole numbers that stand for fractions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.gltf.buffers import Views
from shapewright.references.readers.gltf.document import Accessor, BufferView, Document, Sparse, at
from shapewright.shapes import Floats, Ints

Array = NDArray[Any]
_COMPONENTS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
"""Numbers in an element. The small matrices, whose columns are padded, are used by nothing that is read."""
_MOST = 2**22
"""Elements of an accessor without a buffer view, which a small file can announce: a mesh of eight million triangles."""
_ROUNDED = 0.01
_KEPT = 8
"""Arrays that are held at once; only sparse ones take memory of their own."""


@dataclass(frozen=True, eq=False)
class Accessors:
    """The arrays of a document.

    Attributes:
        described: the document's accessors.
        views: the document's buffer views.
        stored: the array of an accessor (count, width), as it is stored; read-only. Raises UnreadableError.
        bounds: the least and the greatest values (2, width) of an accessor; (0, width) where it is empty.
    """

    described: list[Accessor]
    views: list[BufferView]
    stored: Callable[[int], Array]
    bounds: Callable[[int], Floats]

    def floats(self, index: int, width: int, rows: Ints | slice = slice(None)) -> Floats:
        """Elements of an accessor (N, width) as what they stand for. Raises UnreadableError for another width."""
        array = self.stored(index)
        if array.shape[1] != width:
            raise UnreadableError(f"broken: accessor {index} is {self.described[index].type}, not of {width} numbers")
        return as_floats(array[rows], self.described[index].normalized)

    def indices(self, index: int, width: int = 1) -> Array:
        """The elements (N, width) of an accessor of whole numbers. Raises UnreadableError for others."""
        array = self.stored(index)
        if array.dtype.kind != "u" or array.shape[1] != width:
            raise UnreadableError(f"broken: accessor {index} holds no indices: {self.described[index].type} of "
                                  f"type {self.described[index].component_type}")  # fmt: skip
        return array

    def lie_elsewhere(self, index: int) -> bool:
        """Whether the least and the greatest values of an accessor are others than it says; by 1 %, not less.

        Some programs round them.
        """
        accessor, found = at(self.described, index, "accessor"), self.bounds(index)
        try:
            ends = np.array([accessor.min, accessor.max], dtype=np.float64)
        except (TypeError, ValueError):
            return False
        if ends.shape != found.shape or accessor.normalized or not np.isfinite(ends).all():
            return False
        slack = _ROUNDED * max(float(np.ptp(ends, axis=0).max()), float(np.abs(ends).max()))
        return not bool((np.abs(found - ends) <= slack).all())

    def begins_within_a_number(self, index: int) -> bool:
        """Whether an accessor begins where none can: at a byte that is no multiple of the size of its numbers."""
        accessor = at(self.described, index, "accessor")
        if accessor.buffer_view is None:
            return False
        view = at(self.views, accessor.buffer_view, "buffer view")
        begin = accessor.byte_offset + (0 if view.extensions else view.byte_offset)
        return begin % np.dtype(_COMPONENTS[accessor.component_type]).itemsize > 0

    def has_data(self, index: int) -> bool:
        """Whether an accessor has data of its own: others are zeros."""
        accessor = at(self.described, index, "accessor")
        return accessor.buffer_view is not None or accessor.sparse is not None


def as_floats(array: Array, normalized: bool) -> Floats:
    """Numbers as what they stand for: normalised whole numbers lie in [-1, 1], or [0, 1] where they have no sign."""
    with np.errstate(invalid="ignore"):  # some bytes are signalling NaNs
        values = array.astype(np.float64)
    if normalized and array.dtype.kind in "iu":
        values /= np.iinfo(array.dtype).max
        np.maximum(values, -1.0, out=values)
    return values


def accessors(document: Document, views: Views) -> Accessors:
    """The arrays of a document."""

    @lru_cache(_KEPT)
    def stored(index: int) -> Array:
        accessor = at(document.accessors, index, "accessor")
        kind, width = _COMPONENTS.get(accessor.component_type), _WIDTHS.get(accessor.type)
        if kind is None or width is None:
            raise UnreadableError(f"broken: accessor {index} is {accessor.type} of type {accessor.component_type}")
        if accessor.buffer_view is None:
            if accessor.count > _MOST:
                raise UnreadableError(f"broken: accessor {index} announces {accessor.count} elements without data")
            array: Array = np.broadcast_to(np.zeros(width, kind), (accessor.count, width))
        else:
            stride = at(document.buffer_views, accessor.buffer_view, "buffer view").byte_stride
            array = _array(views(accessor.buffer_view), accessor.byte_offset, accessor.count, width, kind, stride)
        return array if accessor.sparse is None else _replaced(array, accessor.sparse, views)

    @cache
    def bounds(index: int) -> Floats:
        array = stored(index)
        with np.errstate(invalid="ignore"):
            return np.array([array.min(axis=0), array.max(axis=0)] if len(array) else array, dtype=np.float64)

    return Accessors(document.accessors, document.buffer_views, stored, bounds)


def _array(data: memoryview, offset: int, count: int, width: int, kind: str, stride: int | None = None) -> Array:
    """Elements (count, width) that begin ``offset`` bytes into a view."""
    item = np.dtype(kind).itemsize
    stride = stride or item * width
    end = offset + (stride * (count - 1) + item * width if count else 0)
    if end > len(data) or stride < item * width:
        raise UnreadableError(f"broken: {count} elements of {item * width} bytes, {stride} apart, "
                              f"do not fit into {len(data) - offset}")  # fmt: skip
    return np.ndarray((count, width), kind, data, offset if count else 0, (stride, item))


def _replaced(base: Array, sparse: Sparse, views: Views) -> Array:
    kind = _COMPONENTS.get(sparse.indices.component_type, "")
    if kind[-2:-1] != "u":
        raise UnreadableError(f"broken: sparse indices of type {sparse.indices.component_type}")
    rows = _array(views(sparse.indices.buffer_view), sparse.indices.byte_offset, sparse.count, 1, kind)[:, 0]
    values = _array(
        views(sparse.values.buffer_view), sparse.values.byte_offset, sparse.count, base.shape[1], base.dtype.str
    )
    if len(rows) and rows.max() >= len(base):
        raise UnreadableError(f"broken: a sparse accessor replaces element {rows.max()} of {len(base)}")
    result = base.copy()
    result[rows] = values
    return result
