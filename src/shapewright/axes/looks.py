"""What is seen of shapes, for all 24 ways to turn them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shapewright.axes.features import features
from shapewright.axes.sides import Sides
from shapewright.axes.turns import AFTER, INVERSE
from shapewright.shapes import Floats, Ints, Mesh, Points
from shapewright.threads import in_threads

ALIKE = 0.08
"""Share of what is seen that a turn may change after which a shape looks the same: a twelfth. By eye it is the least
with which slatted tables and cabinets with plain doors have no front (docs/benchmarks.md)."""


@dataclass(frozen=True, eq=False)
class Looks:
    """What is seen of N shapes.

    features: (N, 24, F), see ``features``.
    apart: (N, 2, 24), see ``Sides.apart``.
    points: (N,), which of them are points.
    """

    features: Floats
    apart: Floats
    points: NDArray[np.bool_]

    @classmethod
    def of(cls, shapes: Sequence[Mesh | Points], threads: int | None = None) -> Looks:
        """Of one shape at least. threads: one a core by default."""
        sides = in_threads(Sides.of, shapes, threads)
        seen, apart = (np.array(in_threads(each, sides, threads)) for each in (features, Sides.apart))
        return cls(seen, apart, np.array([isinstance(shape, Points) for shape in shapes]))

    @classmethod
    def joined(cls, parts: Sequence[Looks]) -> Looks:
        """Of the shapes of all parts, one at least."""
        return cls(
            *(np.concatenate(each) for each in zip(*((p.features, p.apart, p.points) for p in parts), strict=True))
        )

    def turned(self, turns: Ints) -> Looks:
        """Of the shapes after each was turned. turns: (N,), of TURNS."""
        rows = np.arange(len(turns))[:, None]
        same = AFTER[INVERSE[turns][:, None], AFTER[:, turns].T]  # a turn of the turned shape, as one of the shape
        apart = np.stack([self.apart[rows, i, same] for i in range(2)], axis=1)
        return Looks(self.features[rows, AFTER[:, turns].T], apart, self.points)

    def take(self, rows: Ints) -> Looks:
        """Of some of the shapes."""
        return Looks(self.features[rows], self.apart[rows], self.points[rows])
