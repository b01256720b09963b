"""Vessels, version 5: stems, as glasses have them. The width is 1 without handles."""

from typing import Annotated, Literal

import numpy as np

from shapewright import Range, procedure
from shapewright.modelling.solids import box, cone, revolve


def is_bottle(p):
    return p.top == "neck"


def is_open(p):
    return p.top == "open"


def has_handle(p):
    return p.handle != "none"


def has_stem(p):
    return p.stemmed


def open_body(outside, floor, wall, sides):
    """A hollow body. outside: points (r, y) of its side, from the bottom up; floor: a part of its height."""
    radii, heights = zip(*outside, strict=True)
    bottom = floor * heights[-1]
    deepest = max(np.interp(bottom, heights, radii) - wall, 0.02)
    inside = [(r - wall, y) for r, y in outside[:0:-1] if y > bottom + 0.01 * heights[-1]]
    return revolve([(0, 0), *outside, *inside, (deepest, bottom), (0, bottom)], segments=sides).label("body")


def bottle(outside, height, slope, neck, cap, cap_height, cap_top, sides):
    """A full body with a neck above its side, and a cap."""
    rim = outside[-1][1]
    start = rim + slope * (height - rim)
    high, wide = cap_height * (height - start), cap * neck
    side = [*outside, (neck / 2, start), (neck / 2, height - high)]
    body = revolve([(0, 0), *side, (0, height - high)], segments=sides).label("body")
    return body | cone((wide, high, wide), at=(0, height - high / 2, 0), top=cap_top, segments=sides).label("cap")


def handles(kind, reach, size, thick):
    """From the axis outwards: a loop on the left, a bar in front, or ears on both sides. thick: of a bar."""
    if kind == "bar":
        return box((size / 3, thick, reach), at=(0, 0, reach / 2))
    ring = box((reach, size, thick), at=(-reach / 2, 0, 0))
    ring -= box((reach - thick, size - 2 * thick, 2 * thick), at=((thick - reach) / 2, 0, 0))
    if kind == "loop":
        return ring
    return ring.rotate(90, "x").mirror("x", keep=True).rotate(90 if kind == "ears in front" else 0)


def gripped(outside, wall, kind, reach, grip, grip_height, thick, sides):
    """The handles of a body that has such a side."""
    rim = outside[-1][1]
    radii, heights = zip(*outside, strict=True)
    around = 1.2 * np.interp(grip_height * rim, heights, radii)
    size = max(grip * (rim if kind == "loop" else around), 3 * thick)
    half = size / 2 if kind == "loop" else thick / 2
    at = max(min(grip_height * rim, rim - half), min(half, rim / 2))
    core = revolve([(0, -1), *((max(r - wall / 2, 0.01), y) for r, y in outside), (0, rim)], segments=sides)
    return (handles(kind, 0.5 + reach, size, thick).translate((0, at, 0)) - core).label("handle")


def stem(height, width, foot, sides):
    """A round foot and a thin stem, from the ground up to that height."""
    thick = 0.1 * height
    disc = cone((foot, thick, foot), at=(0, thick / 2, 0), top=0.5, segments=sides)
    return (disc | cone((width, height, width), at=(0, height / 2, 0), top=0.9, segments=sides)).label("stem")


@procedure
def vessel(
    height: Annotated[float, Range(0.1, 4.0)] = 0.8,
    foot: Annotated[float, Range(0.15, 1.0)] = 0.7,  # parts of the width: at the bottom,
    belly: Annotated[float, Range(0.6, 1.2)] = 1.0,  # halfway up, of a straight side's,
    wall: Annotated[float, Range(0.02, 0.1, when=is_open)] = 0.05,
    floor: Annotated[float, Range(0.03, 0.97, when=is_open)] = 0.1,  # of the height
    shoulder: Annotated[float, Range(0.4, 0.95, when=is_bottle)] = 0.7,  # of the height
    slope: Annotated[float, Range(0.02, 0.8, when=is_bottle)] = 0.4,  # of what is above the shoulder
    neck: Annotated[float, Range(0.15, 0.95, when=is_bottle)] = 0.4,
    cap: Annotated[float, Range(0.6, 1.5, when=is_bottle)] = 1.2,  # its width, of the neck's
    cap_height: Annotated[float, Range(0.1, 0.95, when=is_bottle)] = 0.3,  # of what is above the slope
    cap_top: Annotated[float, Range(0.3, 1.0, when=is_bottle)] = 1.0,  # of its width
    reach: Annotated[float, Range(0.1, 0.6, when=has_handle)] = 0.2,  # of a handle, beyond the width
    grip: Annotated[float, Range(0.3, 0.8, when=has_handle)] = 0.5,  # its size, of the height or the width there
    grip_height: Annotated[float, Range(0.4, 0.95, when=has_handle)] = 0.6,  # where it is, of the height
    thick: Annotated[float, Range(0.03, 0.09, when=has_handle)] = 0.06,
    stem_height: Annotated[float, Range(0.2, 0.7, when=has_stem)] = 0.5,  # of the height
    stem_width: Annotated[float, Range(0.04, 0.15, when=has_stem)] = 0.1,
    stem_foot: Annotated[float, Range(0.4, 1.2, when=has_stem)] = 0.8,
    sides: Annotated[int, Range(6, 16)] = 12,
    top: Literal["open", "neck"] = "open",
    handle: Literal["none", "loop", "bar", "ears", "ears in front"] = "none",
    stemmed: bool = False,
):
    below = stem_height * height if stemmed else 0
    height -= below
    rim = shoulder * height if top == "neck" else height
    outside = [(foot / 2, 0), (belly * (1 + foot) / 4, rim / 2), (0.5, rim)]
    if top == "open":
        whole = open_body(outside, floor, wall, sides)
    else:
        whole = bottle(outside, height, slope, neck, cap, cap_height, cap_top, sides)
    if handle != "none":
        whole |= gripped(outside, wall, handle, reach, grip, grip_height, thick, sides)
    if not stemmed:
        return whole
    return whole.translate((0, below, 0)) | stem(below, stem_width, stem_foot, sides)
