"""Vessels, version 2: filled up to anywhere, so that cans and bowls of soup are vessels, too. The width is 1."""

from typing import Annotated

import numpy as np

from shapewright import Range, procedure
from shapewright.modelling.solids import revolve


@procedure
def vessel(
    height: Annotated[float, Range(0.1, 2.5)] = 0.8,
    foot: Annotated[float, Range(0.3, 1.0)] = 0.7,  # parts of the width: at the bottom,
    belly: Annotated[float, Range(0.6, 1.2)] = 1.0,  # halfway up, of a straight side's,
    wall: Annotated[float, Range(0.02, 0.1)] = 0.05,
    floor: Annotated[float, Range(0.03, 0.97)] = 0.1,  # of the height: where the hollow, or what is in it, begins
    sides: Annotated[int, Range(6, 16)] = 12,
):
    middle, bottom = belly * (1 + foot) / 4, floor * height
    outside = [(foot / 2, 0), (middle, height / 2), (0.5, height)]
    radii, heights = zip(*outside, strict=True)
    deepest = np.interp(bottom, heights, radii) - wall
    inside = [(r - wall, y) for r, y in outside[:0:-1] if y > bottom + 0.01 * height]
    return revolve([(0, 0), *outside, *inside, (deepest, bottom), (0, bottom)], segments=sides).label("body")
