"""Trees, version 1: a straight trunk and one round crown. The height is 1."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import cone, sphere


@procedure
def tree(
    trunk: Annotated[float, Range(0.03, 0.2)] = 0.08,
    trunk_top: Annotated[float, Range(0.3, 1.0)] = 0.7,  # of its width at the bottom
    crown_width: Annotated[float, Range(0.2, 1.3)] = 0.6,
    crown_depth: Annotated[float, Range(0.2, 1.3)] = 0.6,
    crown_height: Annotated[float, Range(0.2, 0.95)] = 0.5,
):
    top = 1 - crown_height / 2
    stem = cone((trunk, top, trunk), at=(0, top / 2, 0), top=trunk_top, segments=8).label("trunk")
    crown = sphere((crown_width, crown_height, crown_depth), at=(0, top, 0), segments=12).label("crown")
    return stem | crown
