"""Front views of tables, version 5: one form of leg that leans, bows and tapers, and turned columns.

Version 4 asked what kind of leg a table has before it asked how it stands, so one wrong choice spoiled a replica. Here
a leg is described at its top, middle and foot, and all numbers at their plain values give the straight leg again. Most
tables are nearly plain and many are thin, so that is what is sampled most (``steps``); what is found may lie between.
"""

from typing import Annotated, Literal

import numpy as np

from shapewright import Range, When, procedure
from shapewright.modelling.drawing import bezier, box, ellipse, line, polygon, spline, union

THICK = (0.005, 0.01, 0.016, 0.024, 0.033, 0.043, 0.055, 0.07, 0.09, 0.12, 0.16, 0.2)
ALIKE = (0.5, 0.75, 0.9, 1.0, 1.1, 1.4)
LEANING = (-0.12, -0.03, 0.0, 0.03, 0.07, 0.12, 0.18)
BENT = (-0.2, -0.08, -0.03, -0.01, 0.0, 0.01, 0.03)


def on_legs(p):
    return p.base != "column"


def column(p):
    return p.base == "column"


def braced(p):
    return on_legs(p) and p.extra in ("brace down", "brace up")


@procedure
def table(
    height: Annotated[float, Range(0.2, 2.2, (0.25, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.8, 1.0, 1.3))] = 0.6,
    top: Annotated[float, Range(0.004, 0.25, THICK)] = 0.05,  # of the width, as all lengths
    bevel: Annotated[float, Range(0.0, 0.4, (0.0, 0.005, 0.01, 0.03, 0.3))] = 0.0,  # its underside's, on each side
    aside: Annotated[float, Range(-0.05, 0.05, (-0.01, -0.003, 0.0, 0.003, 0.01))] = 0.0,  # off the middle
    base: Literal["legs", "trestles", "crossed", "column"] = "legs",
    leg: Annotated[float, Range(0.004, 0.3, THICK)] = 0.06,  # its width under the top
    middle: Annotated[float, Range(0.3, 2.0, ALIKE)] = 1.0,  # the same half-way down, as a part of it
    foot: Annotated[float, Range(0.2, 2.0, ALIKE)] = 1.0,  # and at the floor
    inset: Annotated[float, Range(0.0, 0.4, (0.0, 0.005, 0.01, 0.02, 0.04, 0.08, 0.12, 0.2, 0.3))] = 0.0,
    splay: Annotated[float, Range(-0.3, 0.3, LEANING, when=on_legs)] = 0.0,  # how far outwards a leg's foot is
    bow: Annotated[float, Range(-0.3, 0.3, BENT, when=lambda p: p.base == "legs")] = 0.0,  # and its middle
    spread: Annotated[float, Range(0.05, 0.4, when=lambda p: p.base == "trestles")] = 0.2,
    apart: Annotated[float, Range(0.0, 0.1, (0.0, 0.02, 0.05), when=lambda p: p.base == "trestles")] = 0.0,
    pad: Annotated[float, Range(0.0, 0.06, (0.0, 0.002, 0.005, 0.01, 0.03), when=on_legs)] = 0.0,  # wider than a foot
    pad_height: Annotated[float, Range(0.0, 0.1, when=on_legs)] = 0.02,
    apron: Annotated[float, Range(0.0, 0.45, (0.0, 0.005, 0.02, 0.1, 0.2, 0.3), when=on_legs)] = 0.0,
    arch: Annotated[float, Range(0.0, 1.0, (0.0, 0.02, 0.05, 0.3, 0.7), when=on_legs)] = 0.0,  # of the apron
    bars: Annotated[int, Range(0, 2, when=on_legs)] = 0,
    bar: Annotated[float, Range(0.004, 0.2, THICK, when=lambda p: on_legs(p) and p.bars > 0)] = 0.04,
    level: Annotated[
        float, Range(0.0, 0.95, when=lambda p: on_legs(p) and p.bars > 0)
    ] = 0.2,  # of what is under the top
    beyond: Annotated[
        float, Range(0.0, 0.15, (0.0, 0.005, 0.02, 0.06), when=lambda p: on_legs(p) and p.bars > 0)
    ] = 0.0,
    second: Annotated[float, Range(0.0, 0.95, when=lambda p: on_legs(p) and p.bars > 1)] = 0.5,
    extra: Annotated[Literal["nothing", "post", "brace down", "brace up", "body"], When(on_legs)] = "nothing",
    post: Annotated[float, Range(0.004, 0.15, when=lambda p: on_legs(p) and p.extra == "post")] = 0.05,
    post_end: Annotated[
        float, Range(0.0, 0.5, (0.0, 0.01, 0.1, 0.3), when=lambda p: on_legs(p) and p.extra == "post")
    ] = 0.0,
    brace: Annotated[float, Range(0.004, 0.08, when=braced)] = 0.03,
    brace_level: Annotated[float, Range(0.1, 0.9, when=braced)] = 0.5,
    body_width: Annotated[float, Range(0.2, 1.0, when=lambda p: on_legs(p) and p.extra == "body")] = 0.8,
    body_flare: Annotated[
        float, Range(-0.2, 0.5, (-0.02, 0.0, 0.02, 0.3), when=lambda p: on_legs(p) and p.extra == "body")
    ] = 0.0,
    body_top: Annotated[float, Range(0.2, 1.0, when=lambda p: on_legs(p) and p.extra == "body")] = 1.0,
    body_bottom: Annotated[float, Range(0.0, 0.8, when=lambda p: on_legs(p) and p.extra == "body")] = 0.4,
    upper: Annotated[float, Range(0.3, 2.5, ALIKE, when=column)] = 1.0,  # a column's widths a quarter and three down
    lower: Annotated[float, Range(0.3, 2.5, ALIKE, when=column)] = 1.0,
    collar: Annotated[float, Range(0.0, 0.9, when=column)] = 0.2,
    collar_height: Annotated[float, Range(0.0, 0.3, (0.0, 0.01, 0.04, 0.08, 0.2), when=column)] = 0.0,
    collar_hollow: Annotated[float, Range(-1.0, 1.0, when=column)] = 0.0,
    plate: Annotated[float, Range(0.1, 1.0, when=column)] = 0.5,
    plate_height: Annotated[float, Range(0.005, 0.4, (0.01, 0.02, 0.04, 0.08, 0.15, 0.3), when=column)] = 0.04,
    plate_rim: Annotated[float, Range(0.0, 1.0, when=column)] = 1.0,
    plate_hollow: Annotated[float, Range(-1.0, 1.0, when=column)] = 0.0,
    plate_arch: Annotated[float, Range(0.0, 1.0, (0.0, 0.02, 0.5, 0.8), when=column)] = 0.0,
):
    top = min(top, 0.9 * height)
    under = height - top
    edge, low = height - top / 2, 0.5 - bevel
    board = polygon([(-0.5, height), (0.5, height), (0.5, edge), (low, under), (-low, under), (-0.5, edge)])
    parts = [board.translate((aside, 0))]
    widths = np.array([leg, leg * middle, leg * foot])
    if base == "column":
        half, plate_height = widths / 2, min(plate_height, 0.9 * under)
        ys = under + (plate_height - under) * np.linspace(0, 1, 5)
        right = spline(*zip([half[0], half[0] * upper, half[1], half[2] * lower, half[2]], ys, strict=True))
        parts.append(polygon([*right, *(right[::-1] * [-1, 1])]))
        if collar_height > 0:
            parts.append(flared(collar, leg, under, under - collar_height * under, 0, collar_hollow))
        stand = flared(plate, widths[2], 0, plate_height, plate_rim, plate_hollow)
        if plate_arch > 0:
            stand -= ellipse((0.8 * plate, 1.8 * plate_arch * plate_height))
        parts.append(stand)
    else:
        x = max(0.5 - inset - leg / 2, leg / 2)
        toe, apart = x + splay, apart / 2 if base == "trestles" else 0.0
        toes = {"legs": [toe], "trestles": [toe - spread / 2, toe + spread / 2], "crossed": [-toe]}
        for side, toe in zip((-apart, apart), toes[base], strict=False):
            parts += both(leaning((x + side, under), (toe, 0), widths, bow if base == "legs" else 0.0))
            if pad > 0 and pad_height > 0:
                parts += both(box((widths[2] + pad, pad_height), at=(toe, pad_height / 2)))
        if apron > 0:
            board = box((2 * x, apron * under), at=(0, under - apron * under / 2))
            if arch > 0:
                board -= ellipse((1.5 * x, 2 * arch * apron * under), at=(0, under - apron * under))
            parts.append(board)
        for place in (level, second)[:bars]:
            reach = x + (splay + 4 * bow * place if base == "legs" else splay) * (1 - place)
            parts.append(box((2 * max(reach + beyond, leg / 2), bar), at=(0, max(place * under, bar / 2))))
        if extra.startswith("brace"):
            ends = (brace_level * under, under - brace / 2) if extra == "brace up" else (under, brace_level * under)
            parts += both(line((x, ends[0]), (0, ends[1]), width=brace))
        if extra == "post":
            parts.append(box((post, under * (1 - post_end)), at=(0, under * (1 + post_end) / 2)))
        if extra == "body":
            high, low = max(body_top, body_bottom + 0.02) * under, body_bottom * under
            wide, wider = body_width / 2, max(body_width + body_flare, 0.1) / 2
            parts.append(polygon([(-wide, high), (wide, high), (wider, low), (-wider, low)]))
    return union(*parts)


def both(part):
    return [part, part.mirror("x")]


def leaning(top, foot, widths, bow):
    """A leg between two points, as thick at its top, middle and foot as given; its middle bends outwards by ``bow``."""
    down = np.linspace(0, 1, 2 if bow == 0 and widths[1] == (widths[0] + widths[2]) / 2 else 13)
    (x, y), (u, v) = top, foot
    bend = 4 * down * (1 - down)
    slope = (u - x + 4 * bow * (1 - 2 * down)) / (y - v)
    thick = widths[0] + (widths[2] - widths[0]) * down + (widths[1] - (widths[0] + widths[2]) / 2) * bend
    middle, half = x + (u - x) * down + bow * bend, thick * np.sqrt(1 + slope**2) / 2
    ys = y + (v - y) * down
    return polygon(np.concatenate([np.stack([middle + half, ys], 1), np.stack([middle - half, ys], 1)[::-1]]))


def flared(wide, narrow, outer, inner, rim, hollow):
    """What widens towards the height ``outer``, with an upright rim; straight, hollow (1) or bulging (-1) above it."""
    wide = max(wide, narrow)
    edge = outer + rim * (inner - outer)
    if edge == inner:
        return box((wide, abs(inner - outer)), at=(0, (inner + outer) / 2))
    corner = (narrow / 2, edge) if hollow > 0 else (wide / 2, inner)
    between = np.array([(wide + narrow) / 4, (edge + inner) / 2])
    side = bezier((wide / 2, edge), between + abs(hollow) * (corner - between), (narrow / 2, inner))
    side = np.concatenate([[(wide / 2, outer)], side] if rim > 0 else [side])
    return polygon(np.concatenate([side, side[::-1] * [-1, 1]]))
