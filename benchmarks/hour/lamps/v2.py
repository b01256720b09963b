"""Lamps, version 2: square feet. The height is 1."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box, cone, cylinder


@procedure
def lamp(
    foot: Annotated[float, Range(0.1, 0.6)] = 0.35,
    foot_height: Annotated[float, Range(0.01, 0.1)] = 0.03,
    pole: Annotated[float, Range(0.01, 0.15)] = 0.03,
    shade: Annotated[float, Range(0.15, 0.8)] = 0.5,  # its width at the bottom
    shade_top: Annotated[float, Range(0.2, 1.0)] = 0.6,  # of that width
    shade_height: Annotated[float, Range(0.1, 0.7)] = 0.35,
    square: bool = False,
):
    plan = box if square else cylinder
    stand = plan((foot, foot_height, foot), at=(0, foot_height / 2, 0)).label("foot")
    stem = cylinder((pole, 1 - shade_height, pole), at=(0, (1 - shade_height) / 2, 0)).label("pole")
    cover = cone((shade, shade_height, shade), at=(0, 1 - shade_height / 2, 0), top=shade_top).label("shade")
    return stand | stem | cover
