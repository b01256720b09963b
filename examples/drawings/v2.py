"""Front views of tables, version 2: boards under the top and bars between the legs."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.drawing import box, union


@procedure
def table(
    height: Annotated[float, Range(0.2, 2.2)] = 0.6,  # of the width, as all lengths
    top: Annotated[float, Range(0.008, 0.3)] = 0.05,
    leg: Annotated[float, Range(0.01, 0.3)] = 0.06,
    inset: Annotated[float, Range(0.0, 0.35)] = 0.0,
    apron: Annotated[float, Range(0.0, 0.35)] = 0.0,
    bars: Annotated[int, Range(0, 2)] = 0,
    level: Annotated[float, Range(0.0, 0.95, when=lambda p: p.bars > 0)] = 0.2,
    bar: Annotated[float, Range(0.01, 0.2, when=lambda p: p.bars > 0)] = 0.04,
    second: Annotated[float, Range(0.0, 0.9, when=lambda p: p.bars > 1)] = 0.5,
):
    top = min(top, 0.9 * height)
    under = height - top
    x = max(0.5 - inset - leg / 2, leg / 2)
    parts = [box((1, top), at=(0, height - top / 2))]
    parts.append(box((leg, under), at=(x, under / 2)).mirror("x", keep=True))
    if apron > 0:
        parts.append(box((2 * x, apron * under), at=(0, under - apron * under / 2)))
    parts += [box((2 * x, bar), at=(0, max(place * under, bar / 2))) for place in (level, second)[:bars]]
    return union(*parts)
