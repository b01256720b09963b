"""Lamps, version 6: arms of two bars with a joint, which hold a tilted head at its back. The height is 1."""

from typing import Annotated, Literal

from shapewright import Range, When, procedure
from shapewright.modelling.solids import box, cone, cylinder, ellipse, sphere, spline, sweep, union

THIN = 0.01  # the paper of a shade, and the bar that holds it


def bent(p):
    return p.stand == "arm"


def has_tray(p):
    return p.tray and not bent(p)


def open_shade(width, height, top):
    """From y = 0 upwards."""
    paper = cone((width, height, width), at=(0, height / 2, 0), top=top)
    hollow = cone((width - 2 * THIN, height, width - 2 * THIN), at=(0, height / 2, 0), top=top)
    held = box((0.5 * width * (1 + top) - THIN, 2 * THIN, 2 * THIN), at=(0, height / 2, 0))
    return (paper - hollow | held).label("shade")


def arm(pole, knee, knee_height, reach, head, head_height, joint, tilt):
    """From the ground over a knee to a head as far as ``reach`` in front. head: its width; tilt: to the back."""
    top = 1 - head_height / 2
    start, middle, end = (0, 0, 0), (0, knee_height * top, knee * reach), (0, top, reach)
    behind = 0, top, reach - 0.5 * head
    bars = [(start, middle), (middle, behind), (behind, end)] if joint else [spline(start, middle, end)]
    made = union(*(sweep(ellipse(pole, pole, segments=8), bar) for bar in bars)).label("arm")
    bowl = sphere((head, 2 * head_height, head), at=(0, 1 - head_height, reach))
    bowl -= box((head, head_height, head), at=(0, 1 - 1.5 * head_height, reach))
    return made | bowl.rotate(tilt, "x", about=(0, top, reach)).label("head")


@procedure
def lamp(
    foot: Annotated[float, Range(0.1, 0.6)] = 0.35,
    foot_height: Annotated[float, Range(0.01, 0.2)] = 0.03,
    pole: Annotated[float, Range(0.01, 0.15)] = 0.03,
    shade: Annotated[float, Range(0.15, 0.8)] = 0.5,  # its width at the bottom
    shade_top: Annotated[float, Range(0.2, 1.0, when=lambda p: not bent(p))] = 0.6,  # of that width
    shade_height: Annotated[float, Range(0.1, 0.7)] = 0.35,
    knee: Annotated[float, Range(-0.4, 0.6, when=bent)] = 0.1,  # of the reach
    knee_height: Annotated[float, Range(0.4, 0.95, when=bent)] = 0.7,
    reach: Annotated[float, Range(0.2, 0.8, when=bent)] = 0.5,
    tray_width: Annotated[float, Range(0.15, 0.5, when=has_tray)] = 0.3,
    tray_height: Annotated[float, Range(0.2, 0.6, when=has_tray)] = 0.4,
    forward: Annotated[float, Range(0.05, 0.3, when=has_tray)] = 0.1,
    tilt: Annotated[float, Range(-20, 70, when=bent)] = 0,
    square: bool = False,
    joint: Annotated[bool, When(bent)] = False,
    tray: Annotated[bool, When(lambda p: not bent(p))] = False,
    stand: Literal["pole", "arm"] = "pole",
):
    plan = box if square else cylinder
    base = plan((foot, foot_height, foot), at=(0, foot_height / 2, 0)).label("foot")
    if stand == "arm":
        return base | arm(pole, knee, knee_height, reach, shade, shade_height, joint, tilt)
    length = 1 - shade_height / 2 + THIN  # up to the bar
    stem = cylinder((pole, length, pole), at=(0, length / 2, 0)).label("pole")
    ahead = forward if tray else 0
    if tray:
        stem |= box((pole, pole, forward), at=(0, length - pole / 2, forward / 2)).label("pole")
        stem |= box((tray_width, 0.02, tray_width), at=(0, tray_height * (1 - shade_height), 0)).label("tray")
    return base | stem | open_shade(shade, shade_height, shade_top).translate((0, 1 - shade_height, ahead))
