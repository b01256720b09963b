"""Triangles that stand in several places of a file, brought together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.parts import Parts
from shapewright.shapes import Floats, Ints

Piece: TypeAlias = tuple[Floats, Ints]
"""Vertices (V, 3) and faces (F, 3)."""


@dataclass(frozen=True, eq=False)
class Scene:
    """The triangles that a scene shows.

    Attributes:
        vertices: (V, 3) float64, in the file's own units and axes.
        faces: (F, 3) int64.
        notes: what of the file was left out.
        unit: in metres, where the file or its format states it; else None.
        up: the axis that points up, among x, y, z, -x, -y, -z, where the file or its format states it; else None.
        parts: which part each face belongs to; None where the file names none.
    """

    vertices: Floats
    faces: Ints
    notes: tuple[str, ...] = ()
    unit: float | None = None
    up: str | None = None
    parts: Parts | None = None


MOST = 10_000_000
"""Triangles of a file, repeated ones included: they take a gigabyte. A small file can announce any number."""


def refuse_too_many(triangles: int) -> None:
    """Raise UnreadableError where a file has more triangles than are read."""
    if triangles > MOST:
        raise UnreadableError(f"{triangles:,} triangles, more than the {MOST:,} that are read; simplify it first")


def placed(vertices: Floats, faces: Ints, matrix: Floats) -> Piece:
    """A piece where a matrix (4, 4) puts it; its faces turn over where the matrix mirrors, so outside stays outside."""
    with np.errstate(over="ignore", invalid="ignore"):
        mirrored = np.linalg.det(matrix[:3, :3]) < 0.0
        moved = vertices @ matrix[:3, :3].T + matrix[:3, 3]
    return moved, faces[:, ::-1] if mirrored else faces


def join(pieces: Sequence[Piece]) -> Piece:
    """All pieces in one; (0, 3) where there are none."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in pieces)])
    vertices = [np.empty((0, 3)), *(vertices for vertices, _ in pieces)]
    faces = [np.empty((0, 3), dtype=np.int64)]
    faces += [piece + start for (_, piece), start in zip(pieces, starts[:-1], strict=True)]
    return np.concatenate(vertices), np.concatenate(faces)
