"""Front views of tables, version 3: a column on a plate, or legs that lean and taper, with one in the middle."""

from typing import Annotated, Literal

from shapewright import Range, When, procedure
from shapewright.modelling.drawing import box, polygon, union


@procedure
def table(
    height: Annotated[float, Range(0.2, 2.2)] = 0.6,  # of the width, as all lengths
    top: Annotated[float, Range(0.008, 0.3)] = 0.05,
    base: Literal["legs", "column"] = "legs",
    leg: Annotated[float, Range(0.01, 0.3)] = 0.06,  # its width under the top
    foot: Annotated[float, Range(0.2, 2.0)] = 1.0,  # of that, its width on the floor
    inset: Annotated[float, Range(0.0, 0.35, when=lambda p: p.base == "legs")] = 0.0,
    splay: Annotated[float, Range(-0.2, 0.25, when=lambda p: p.base == "legs")] = 0.0,
    plate: Annotated[float, Range(0.1, 1.0, when=lambda p: p.base == "column")] = 0.5,
    plate_height: Annotated[float, Range(0.005, 0.3, when=lambda p: p.base == "column")] = 0.04,
    middle: Annotated[bool, When(lambda p: p.base == "legs")] = False,
    apron: Annotated[float, Range(0.0, 0.35, when=lambda p: p.base == "legs")] = 0.0,
    bars: Annotated[int, Range(0, 2, when=lambda p: p.base == "legs")] = 0,
    level: Annotated[float, Range(0.0, 0.95, when=lambda p: p.base == "legs" and p.bars > 0)] = 0.2,
    bar: Annotated[float, Range(0.01, 0.2, when=lambda p: p.base == "legs" and p.bars > 0)] = 0.04,
    second: Annotated[float, Range(0.0, 0.9, when=lambda p: p.base == "legs" and p.bars > 1)] = 0.5,
):
    top = min(top, 0.9 * height)
    under = height - top
    parts = [box((1, top), at=(0, height - top / 2))]
    if base == "column":
        parts.append(tapered((0, under), (0, 0), leg, leg * foot))
        parts.append(box((plate, plate_height), at=(0, plate_height / 2)))
    else:
        x = max(0.5 - inset - leg / 2, leg / 2)
        parts.append(tapered((x, under), (x + splay, 0), leg, leg * foot).mirror("x", keep=True))
        if middle:
            parts.append(box((leg, under), at=(0, under / 2)))
        if apron > 0:
            parts.append(box((2 * x, apron * under), at=(0, under - apron * under / 2)))
        for place in (level, second)[:bars]:
            reach = max(x + splay * (1 - place), leg / 2)
            parts.append(box((2 * reach, bar), at=(0, max(place * under, bar / 2))))
    return union(*parts)


def tapered(top, foot, wide, narrow):
    """A leg from one point to another, as wide at its ends as given."""
    (x, y), (u, v) = top, foot
    return polygon([(x - wide / 2, y), (x + wide / 2, y), (u + narrow / 2, v), (u - narrow / 2, v)])
