"""Points of a surface in space, as scanners and samplers give them: no faces, and seldom all sides."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from shapewright.shapes.arrays import Floats, Transform


@dataclass(frozen=True, eq=False)
class Points:
    """Points of a surface in space. They can be a reference; a procedure makes meshes and drawings alone.

    Attributes:
        positions: (N, 3) float64, N > 0, Y up, front towards +Z.
        normals: (N, 3) float64, of length 1, out of the surface; 0 where one is not known. None where none is.
        seen_from: (N, 3) float64, where the sensor stood that saw each point; one place (3,) stands for all. None where
            that is not known.

    Raises ValueError for arrays of another form, and for numbers that are not finite.
    """

    positions: Floats
    normals: Floats | None = None
    seen_from: Floats | None = None

    def __post_init__(self) -> None:
        for field in ("positions", "normals", "seen_from"):
            if (rows := getattr(self, field)) is None:
                continue
            rows = np.asarray(rows, dtype=np.float64)
            if field == "seen_from" and rows.shape == (3,):
                rows = np.broadcast_to(rows, self.positions.shape)
            if rows.ndim != 2 or rows.shape[1] != 3 or len(rows) != len(self.positions):
                count = "N" if field == "positions" else len(self.positions)
                raise ValueError(f"{field} have the form {rows.shape}, not ({count}, 3)")
            if not np.isfinite(rows).all():
                raise ValueError(f"some {field} are not finite (NaN or infinity)")
            object.__setattr__(self, field, np.ascontiguousarray(_unit(rows) if field == "normals" else rows))
        if not len(self.positions):
            raise ValueError("there are no points")

    @property
    def bounds(self) -> Floats:
        """(2, 3): the least and the greatest corner."""
        return np.stack([self.positions.min(axis=0), self.positions.max(axis=0)])

    @property
    def extent(self) -> Floats:
        """(3,): size of the bounding box."""
        return np.asarray(np.ptp(self.positions, axis=0))

    def chosen(self, rows: ArrayLike) -> Points:
        """The points of these rows: indices, or a mask (N,)."""
        some = [None if each is None else each[np.asarray(rows)] for each in (self.normals, self.seen_from)]
        return Points(self.positions[np.asarray(rows)], *some)

    def transformed(self, matrix: ArrayLike) -> Points:
        """The points under a 3x3 or 4x4 matrix; normals stay at right angles to the surface."""
        matrix = np.asarray(matrix, dtype=np.float64)
        turn, move = matrix[:3, :3], matrix[:3, 3] if matrix.shape == (4, 4) else 0.0
        places = [None if each is None else each @ turn.T + move for each in (self.positions, self.seen_from)]
        assert places[0] is not None
        return Points(places[0], None if self.normals is None else self.normals @ np.linalg.inv(turn), places[1])

    def normalisation(self) -> Transform:
        """Centre of the bounding box to the origin, largest extent to 1, as for a mesh."""
        largest = float(self.extent.max())
        if largest <= 0.0:
            raise ValueError("points of no size cannot be normalised")
        return Transform(tuple(self.bounds.mean(axis=0)), 1.0 / largest)

    def normalised(self) -> Points:
        apply = self.normalisation().apply
        seen_from = None if self.seen_from is None else apply(self.seen_from)
        return replace(self, positions=apply(self.positions), seen_from=seen_from)

    def __len__(self) -> int:
        return len(self.positions)

    def __repr__(self) -> str:
        return f"Points({len(self)} points{'' if self.normals is None else ', with normals'})"


def _unit(vectors: Floats) -> Floats:
    """Of length 1; those of no length stay."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    known = lengths > np.finfo(np.float64).tiny
    return np.asarray(np.divide(vectors, lengths, out=np.zeros_like(vectors), where=known))
