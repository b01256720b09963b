"""The default judge of meshes: the probability that a person calls a replica and its reference the same, and where
they differ.

Both are looked at in place: nothing is turned or mirrored.
"""

from __future__ import annotations

import functools
import math

from shapewright.judging.differences import Look, compare, regions
from shapewright.judging.opinion import opinion
from shapewright.judging.verdict import Evidence
from shapewright.shapes import Mesh, Shape


class Fidelity:
    """A reference, described when it is first needed; any thread may ask."""

    def __init__(self, reference: Mesh) -> None:
        self._look = functools.cache(functools.partial(_look, reference))

    def value(self, replica: Shape | None) -> float:
        """The fidelity alone, in two thirds of the time; NaN where the two cannot be compared."""
        ours, theirs = self._look(), _look(replica)
        return opinion(compare(ours, theirs)[0]) if ours and theirs else math.nan

    def evidence(self, replica: Shape | None) -> Evidence:
        """What there is to say of a replica; a value of NaN where the two cannot be compared."""
        ours, theirs = self._look(), _look(replica)
        if not (ours and theirs):
            return Evidence(math.nan)
        differences, gaps = compare(ours, theirs)
        return Evidence(opinion(differences), *regions(ours, theirs, gaps))


def _look(shape: Shape | None) -> Look | None:
    """None for what no picture shows."""
    if not isinstance(shape, Mesh):
        return None
    try:
        look = Look.of(shape)
    except ValueError:
        return None
    return look if look.visible else None
