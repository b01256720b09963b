"""Whether a procedure builds the same shape from the same parameters: some are built again, in another process.

Another process draws other random numbers, and has sets in another order.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice

import numpy as np

from shapewright.building import Build, Workers
from shapewright.procedures import is_foreign
from shapewright.procedures.randomness import Chance, chances
from shapewright.progress import Notice
from shapewright.shapes import Mesh, Shape

_AGAIN, _SUSPECTED = 2, 8
"""Shapes that are built again; of a procedure whose file has a line that may differ from call to call."""
_SAME = 1e-6
"""Of the extent: what no author means by another shape."""
_WAYS_OUT = {
    "random": "draw from numpy.random.default_rng(0) inside the function, or from a parameter `seed: Annotated[int, "
    "Seed()] = 0`",
    "set": "go through sorted(...) of it, since the order of a set differs from process to process",
    "moment": "make nothing depend on times, addresses and identifiers",
}


def unsteady(crew: Workers, builds: Sequence[Build]) -> Notice | None:
    """What to tell of a procedure that builds another shape from the same parameters; None where it does not."""
    suspected = chances(crew.procedure)
    first = list(islice((build for build in builds if build.shape is not None), _SUSPECTED if suspected else _AGAIN))
    again = crew.elsewhere(first)
    differing = sum(not alike(one.shape, other.shape) for one, other in zip(first, again, strict=True))
    if not differing:
        return None
    text = f"the same parameters gave another shape, {differing} of {len(first)} times, so what is found cannot be "
    text += "built again, and the same seed gives other results"
    return Notice("stochastic", f"{text}. {_why(suspected, is_foreign(crew.procedure.path))}")


def _why(suspected: Sequence[Chance], foreign: bool) -> str:
    if foreign:
        return "Give whatever it draws at random a fixed seed, or one that is a parameter."
    if not suspected:
        return f"Perhaps it draws at random: {_WAYS_OUT['random']}."
    chance = suspected[0]
    return f"{chance.place.says(chance.says)}: {_WAYS_OUT[chance.kind]}."


def alike(one: Shape | None, other: Shape | None) -> bool:
    """Whether two shapes are one but for rounding."""
    if one is None or other is None or type(one) is not type(other):
        return one is other
    size = _SAME * max(float(np.ptp(one.bounds, axis=0).max()), 1e-12)
    if isinstance(one, Mesh) and isinstance(other, Mesh):
        same = np.array_equal(one.faces, other.faces) and one.vertices.shape == other.vertices.shape
        return same and bool(np.abs(one.vertices - other.vertices).max(initial=0.0) <= size)
    return bool(one.geometry.equals_exact(other.geometry, size))  # type: ignore[union-attr]
