"""What is seen of shapes, for all 24 ways to turn them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

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
    """

    features: Floats
    apart: Floats

    @classmethod
    def of(cls, shapes: Sequence[Mesh | Points], threads: int | None = None) -> Looks:
        """Of one shape at least. threads: one a core by default."""
        sides = in_threads(Sides.of, shapes, threads)
        return cls(np.array(in_threads(features, sides, threads)), np.array(in_threads(Sides.apart, sides, threads)))

    @classmethod
    def joined(cls, parts: Sequence[Looks]) -> Looks:
        """Of the shapes of all parts, one at least."""
        return cls(np.concatenate([p.features for p in parts]), np.concatenate([p.apart for p in parts]))

    def turned(self, turns: Ints) -> Looks:
        """Of the shapes after each was turned. turns: (N,), of TURNS."""
        rows = np.arange(len(turns))[:, None]
        same = AFTER[INVERSE[turns][:, None], AFTER[:, turns].T]  # a turn of the turned shape, as one of the shape
        apart = np.stack([self.apart[rows, i, same] for i in range(2)], axis=1)
        return Looks(self.features[rows, AFTER[:, turns].T], apart)

    def take(self, rows: Ints) -> Looks:
        """Of some of the shapes."""
        return Looks(self.features[rows], self.apart[rows])
