"""Shapes on disk in place of memory: in files without a name, which are gone with the process, mapped into memory.

A shape on a shelf is used as any other. What is computed of it again and again is computed of a fresh copy: then its
pages, and what a shape keeps of itself, take no memory afterwards.
"""

from __future__ import annotations

import mmap
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any, ClassVar, Protocol, TypeVar

import numpy as np

from shapewright.shapes.drawing import Drawing
from shapewright.shapes.mesh import Mesh
from shapewright.shapes.packed import pack, size_of, unpack
from shapewright.shapes.points import Points
from shapewright.shapes.views import Views

AnyShape = TypeVar("AnyShape", bound=Mesh | Drawing | Points | Views)


IN_MEMORY = 2**26
"""Bytes of shapes that stay in memory, and of those that are put on disk at once: of some thousand plain meshes."""


class Holder(Protocol):
    """A dataclass that has a shape, such as a reference."""

    @property
    def shape(self) -> Mesh | Drawing | Points | Views: ...

    __dataclass_fields__: ClassVar[dict[str, Any]]


AnyHolder = TypeVar("AnyHolder", bound=Holder)


def shelved(holders: Iterable[AnyHolder]) -> tuple[AnyHolder, ...]:
    """The same, taken one after the other, of whose meshes and points all but the first are on disk.

    Drawings and views stay in memory. Raises OSError where the disk is full.
    """
    done: list[AnyHolder] = []
    waiting: list[int] = []
    size, full = 0, False

    def put() -> None:
        some = [shape for row in waiting if isinstance(shape := done[row].shape, Mesh | Points)]
        for row, shape in zip(waiting, on_disk(some), strict=True):
            done[row] = replace(done[row], shape=shape)

    for holder in holders:
        done.append(holder)
        if not isinstance(holder.shape, Mesh | Points) or is_shelved(holder.shape):
            continue
        waiting.append(len(done) - 1)
        size += size_of(holder.shape)
        if size >= IN_MEMORY:
            if full:
                put()
            size, full, waiting = 0, True, []
    if full and waiting:
        put()
    return tuple(done)


def on_disk(shapes: Sequence[Mesh | Points]) -> list[Mesh | Points]:
    """The same shapes on a shelf of their own. Raises OSError where the disk is full."""
    heads, length = [], 0
    try:
        with tempfile.TemporaryFile(prefix="shapewright-") as file:
            for shape in shapes:
                head, content = pack(shape)
                file.write(content)
                heads.append((head, length))
                length += len(content)
            file.flush()
            there = memoryview(mmap.mmap(file.fileno(), length, access=mmap.ACCESS_READ))
    except OSError as error:
        where = f"{tempfile.gettempdir()}: many references lie here while they are fitted"
        what = f"{where}, and it cannot be written: {error.strerror}"
        raise OSError(f"{what}; free some space, or name another folder in TMPDIR") from error
    found = [unpack(head, there[start : start + head["bytes"]]) for head, start in heads]
    _give_back(there)
    return found  # type: ignore[return-value]  # no drawing was given


def is_shelved(shape: Mesh | Drawing | Points | Views) -> bool:
    """Whether a shape is on a shelf."""
    return isinstance(shape, Mesh | Points) and _shelf_of(shape) is not None


def fresh(shape: AnyShape) -> AnyShape:
    """A copy in memory of a shape on a shelf, whose pages are given back; any other shape itself."""
    if not isinstance(shape, Mesh | Points) or (there := _shelf_of(shape)) is None:
        return shape
    head, content = pack(shape)
    _give_back(there)
    return unpack(head, content)  # type: ignore[return-value]  # of the same kind


def _shelf_of(shape: Mesh | Points) -> memoryview | None:
    """The bytes that hold the arrays of a shape; None where they are in memory."""
    array: Any = shape.vertices if isinstance(shape, Mesh) else shape.positions
    while isinstance(array, np.ndarray):
        array = array.base
    return array if isinstance(array, memoryview) and isinstance(array.obj, mmap.mmap) else None


def _give_back(there: memoryview) -> None:
    """The pages of a file need not be in memory until somebody reads them again."""
    if hasattr(mmap, "MADV_DONTNEED") and isinstance(there.obj, mmap.mmap):
        there.obj.madvise(mmap.MADV_DONTNEED)
