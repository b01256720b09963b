"""Lamps, version 3: open shades, held by a bar. The height is 1."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box, cone, cylinder

THIN = 0.01  # the paper of a shade, and the bar that holds it


def open_shade(width, height, top):
    """From y = 0 upwards."""
    paper = cone((width, height, width), at=(0, height / 2, 0), top=top)
    hollow = cone((width - 2 * THIN, height, width - 2 * THIN), at=(0, height / 2, 0), top=top)
    held = box((0.5 * width * (1 + top) - THIN, 2 * THIN, 2 * THIN), at=(0, height / 2, 0))
    return (paper - hollow | held).label("shade")


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
    length = 1 - shade_height / 2 + THIN  # up to the bar
    stem = cylinder((pole, length, pole), at=(0, length / 2, 0)).label("pole")
    return stand | stem | open_shade(shade, shade_height, shade_top).translate((0, 1 - shade_height, 0))
