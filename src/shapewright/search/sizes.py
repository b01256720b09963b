"""The size of a replica, beside its form: where lengths mean what they say, a replica has its reference's size."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from shapewright.search.objective import Objective
from shapewright.shapes import Drawing, Floats, Shape, extent_of

_MESH, _DRAWING = 1e4, 1e5
"""Cost of a size, times the logarithm of how far it is off. One of 1 % costs what a side of a box does that is off by
1 %: some 100 by the pictures of a mesh, 1,000 by those of a drawing."""
_HALF, _STEEPNESS = 0.1, 4.0
"""How far off a size halves the fidelity, and how steeply: 1 % takes nothing away, 5 % takes 6 %, 20 % nearly all. By
hand."""


def likeness(shape: Shape | None, extent: float) -> float:
    """By what a fidelity is multiplied: 1 for a shape of this extent, 0 for one of another size."""
    if shape is None:
        return 1.0
    off = abs(math.log(extent_of(shape) / extent))
    return float(1.0 / (1.0 + (off / _HALF) ** _STEEPNESS))


@dataclass(frozen=True, eq=False)
class SizedObjective:
    """A reference of which the size counts as well.

    Attributes:
        form: the reference, normalised.
        extent: its longest side.
        parts: those of the residual of its form.
    """

    form: Objective
    extent: float
    parts: tuple[slice, ...]

    def residual(self, replica: Shape) -> Floats | None:
        """Each part of the residual of the form, with the size before it; see ``parts_with_size``."""
        form = self.form.residual(replica)
        if form is None:
            return None
        weight = _DRAWING if isinstance(replica, Drawing) else _MESH
        size = np.array([weight * math.log(extent_of(replica) / self.extent)])
        return np.concatenate([piece for part in self.parts for piece in (size, form[part])])


def parts_with_size(parts: Sequence[slice]) -> tuple[slice, ...]:
    """Where the parts of a residual are when each has the size before it."""
    if len(parts) == 1:
        return (slice(None),)
    ends = np.cumsum([0, *(part.stop - part.start + 1 for part in parts)])
    return tuple(slice(int(low), int(high)) for low, high in pairwise(ends))
