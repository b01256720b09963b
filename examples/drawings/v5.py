"""Front views of tables, version 5: bent legs, braces, and a body that hangs or stands."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.drawing import box, line, polygon, spline, union

LEANING = ("leaning", "bowed")
BARS = ("bar", "two bars")
BRACES = ("brace down", "brace up")


@procedure
def table(
    height: Annotated[float, Range(0.2, 2.2)] = 0.6,  # of the width, as all lengths
    top: Annotated[float, Range(0.008, 0.3)] = 0.05,
    base: Literal["straight", "leaning", "bowed", "trestles", "crossed", "column"] = "straight",
    leg: Annotated[float, Range(0.01, 0.3)] = 0.06,  # its width under the top
    foot: Annotated[float, Range(0.2, 2.0, when=lambda p: p.base not in ("straight", "crossed"))] = 1.0,
    inset: Annotated[float, Range(0.0, 0.35, when=lambda p: p.base != "column")] = 0.0,
    splay: Annotated[float, Range(-0.2, 0.25, when=lambda p: p.base in LEANING)] = 0.0,
    bow: Annotated[float, Range(-0.3, 0.3, when=lambda p: p.base == "bowed")] = 0.0,
    spread: Annotated[float, Range(0.05, 0.4, when=lambda p: p.base == "trestles")] = 0.2,
    waist: Annotated[float, Range(0.3, 3.0, when=lambda p: p.base == "column")] = 1.0,
    plate: Annotated[float, Range(0.1, 1.0, when=lambda p: p.base == "column")] = 0.5,
    plate_height: Annotated[float, Range(0.005, 0.3, when=lambda p: p.base == "column")] = 0.04,
    plate_slope: Annotated[float, Range(0.0, 1.0, when=lambda p: p.base == "column")] = 0.0,
    extra: Literal["none", "apron", "bar", "two bars", "middle leg", "brace down", "brace up", "body"] = "none",
    apron: Annotated[float, Range(0.03, 0.4, when=lambda p: p.extra == "apron")] = 0.1,  # of the height under the top
    level: Annotated[float, Range(0.0, 0.95, when=lambda p: p.extra in BARS)] = 0.2,
    bar: Annotated[float, Range(0.01, 0.2, when=lambda p: p.extra in BARS)] = 0.04,
    second: Annotated[float, Range(0.0, 0.9, when=lambda p: p.extra == "two bars")] = 0.5,
    brace_level: Annotated[float, Range(0.1, 0.9, when=lambda p: p.extra in BRACES)] = 0.5,
    body_width: Annotated[float, Range(0.3, 1.0, when=lambda p: p.extra == "body")] = 0.8,
    body_top: Annotated[float, Range(0.3, 1.0, when=lambda p: p.extra == "body")] = 0.9,
    body_bottom: Annotated[float, Range(0.0, 0.8, when=lambda p: p.extra == "body")] = 0.4,
):
    top = min(top, 0.9 * height)
    under = height - top
    parts = [box((1, top), at=(0, height - top / 2))]
    if base == "column":
        parts += column(under, leg, foot, waist, plate, plate_height, plate_slope)
    else:
        x = max(0.5 - inset - leg / 2, leg / 2)
        if base == "crossed":
            parts.append(line((-x, 0), (x, under), width=leg))
            parts.append(parts[-1].mirror("x"))
        elif base == "trestles":
            for toe in (-spread / 2, spread / 2):
                parts += both(tapered((x - spread / 2, under), (x - spread / 2 + toe, 0), leg, leg * foot))
        else:
            parts += both(tapered((x, under), (x + splay, 0), leg, leg * foot, bow))
        if extra == "middle leg":
            parts.append(box((leg, under), at=(0, under / 2)))
        if extra == "apron":
            parts.append(box((2 * x, apron * under), at=(0, under - apron * under / 2)))
        if extra in BARS:
            for place in (level, second)[: BARS.index(extra) + 1]:
                reach = max(x + splay * (1 - place), leg / 2)
                parts.append(box((2 * reach, bar), at=(0, max(place * under, bar / 2))))
        if extra in BRACES:
            ends = (brace_level * under, under) if extra == "brace up" else (under, brace_level * under)
            parts += both(line((x, ends[0]), (0, ends[1]), width=leg))
    if extra == "body":
        low, high = sorted((body_bottom * under, max(body_top, body_bottom + 0.02) * under))
        parts.append(box((body_width, high - low), at=(0, (low + high) / 2)))
    shape = union(*parts)
    return shape if base not in ("trestles", "crossed") else shape & box((4, height), at=(0, height / 2))


def both(part):
    return [part, part.mirror("x")]


def tapered(top, foot, wide, narrow, bow=0.0):
    """A leg from one point to another, as wide at its ends as given; ``bow`` bends its middle outwards."""
    (x, y), (u, v) = top, foot
    if not bow:
        return polygon([(x - wide / 2, y), (x + wide / 2, y), (u + narrow / 2, v), (u - narrow / 2, v)])
    middle, half = (x + u) / 2 + bow, (wide + narrow) / 4
    outer = spline((x + wide / 2, y), (middle + half, (y + v) / 2), (u + narrow / 2, v))
    inner = spline((u - narrow / 2, v), (middle - half, (y + v) / 2), (x - wide / 2, y))
    return polygon([*outer, *inner])


def column(under, leg, foot, waist, plate, plate_height, slope):
    half = leg / 2
    right = spline((half, under), (half * waist, under / 2), (half * foot, plate_height))
    shaft = polygon([*right, *([-x, y] for x, y in right[::-1])])
    rim = plate / 2
    shoulder = rim * (1 - slope) + half * foot * slope if rim > half * foot else rim
    low = plate_height * (1 - slope)
    base = polygon([(-rim, 0), (rim, 0), (rim, low), (shoulder, plate_height), (-shoulder, plate_height), (-rim, low)])
    return [shaft, base]
