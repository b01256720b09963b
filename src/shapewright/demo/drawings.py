"""Fifty bundled drawings for the study of the paper's section 6.2, front views of tables; and benches to try it on.

Each is drawn by one of the functions below at sizes of its own, with details that no procedure is expected to have:
rounded edges, feet, lips, turned legs. All lengths are parts of the width.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from shapewright.modelling.drawing import Sketch, box, ellipse, line, polygon, polyline, spline, union
from shapewright.rendering.ink import png
from shapewright.shapes import Drawing
from shapewright.shapes.files import svg

SEED = 2023
Random = np.random.Generator
PICTURES = 4
"""One drawing in this many is written as PNG, the others as SVG."""


def top(rng: Random, height: float, thick: float) -> Sketch:
    """A board, often with soft edges, sometimes with a lip below its ends."""
    board = box((1, thick), at=(0, height - thick / 2), radius=float(rng.choice([0.0, 0.25, 0.45])) * thick)
    if rng.random() < 0.15:
        board |= box((0.9, thick / 4), at=(0, height - thick - thick / 8))
    return board


def pair(part: Sketch) -> Sketch:
    return part.mirror("x", keep=True)


def tapered(x: float, u: float, tall: float, wide: float, narrow: float) -> Sketch:
    """A leg from (x, tall) to (u, 0)."""
    return polygon([(x - wide / 2, tall), (x + wide / 2, tall), (u + narrow / 2, 0), (u - narrow / 2, 0)])


def plain(rng: Random) -> Sketch:
    height, thick, leg = rng.uniform(0.4, 0.85), rng.uniform(0.03, 0.09), rng.uniform(0.04, 0.11)
    x = 0.5 - leg / 2 - rng.choice([0.0, 0.02, 0.08])
    legs = pair(box((leg, height), at=(x, height / 2)))
    pads = pair(box((leg * 1.15, 0.012), at=(x, 0.006))) if rng.random() < 0.3 else box(leg, at=(x, leg / 2))
    return top(rng, height, thick) | legs | pads


def with_apron(rng: Random) -> Sketch:
    height, thick, leg = rng.uniform(0.5, 0.8), rng.uniform(0.025, 0.05), rng.uniform(0.04, 0.08)
    x, deep = 0.5 - leg / 2 - rng.uniform(0.01, 0.06), rng.uniform(0.06, 0.16)
    apron = box((2 * x, deep), at=(0, height - thick - deep / 2))
    if rng.random() < 0.4:
        apron -= ellipse((1.5 * x, deep * 0.8), at=(0, height - thick - deep))
    return top(rng, height, thick) | pair(tapered(x, x, height, leg, leg * rng.uniform(0.6, 1))) | apron


def with_bar(rng: Random) -> Sketch:
    height, thick, leg = rng.uniform(0.45, 0.9), rng.uniform(0.03, 0.07), rng.uniform(0.04, 0.09)
    x, level = 0.5 - leg / 2 - rng.choice([0.0, 0.05]), rng.uniform(0.08, 0.45)
    bar = box((2 * x, rng.uniform(0.025, 0.06)), at=(0, level * height))
    return top(rng, height, thick) | pair(box((leg, height), at=(x, height / 2))) | bar


def with_shelves(rng: Random) -> Sketch:
    height, leg = rng.uniform(0.55, 1.0), rng.uniform(0.04, 0.08)
    levels = (rng.uniform(0.1, 0.3), rng.uniform(0.45, 0.65))
    boards = union(*(box((1 - leg, 0.035), at=(0, level * height)) for level in levels))
    return top(rng, height, 0.045) | pair(box((leg, height), at=(0.5 - leg / 2, height / 2))) | boards


def splayed(rng: Random) -> Sketch:
    height, thick, leg = rng.uniform(0.45, 0.8), rng.uniform(0.03, 0.06), rng.uniform(0.05, 0.08)
    x, lean = rng.uniform(0.3, 0.42), rng.uniform(0.03, 0.12)
    legs = pair(tapered(x, x + lean, height - thick / 2, leg, leg * rng.uniform(0.4, 0.8)))
    size, level = ((2 * x, 0.06), thick + 0.03) if rng.random() < 0.5 else ((0.1, thick), thick / 2)
    return top(rng, height, thick) | legs | box(size, at=(0, height - level))


def pedestal(rng: Random) -> Sketch:
    height, thick, wide = rng.uniform(0.65, 1.05), rng.uniform(0.025, 0.05), rng.uniform(0.07, 0.16)
    stand, low = rng.uniform(0.4, 0.7), rng.uniform(0.03, 0.08)
    waist, hem = wide * rng.uniform(0.5, 1.3), wide * rng.uniform(0.9, 1.6)
    shaft = spline((wide / 2, height - thick), (waist / 2, height / 2), (hem / 2, low / 2))
    slope = rng.uniform(0.3, 1.0) * low
    base = ((stand / 2, 0), (stand / 2, low - slope), (hem / 2, low))
    foot, column = (polygon([*right, *((-x, y) for x, y in right[::-1])]) for right in (base, shaft))
    return top(rng, height, thick) | column | foot


def trestle(rng: Random) -> Sketch:
    height, thick, leg = rng.uniform(0.5, 0.75), rng.uniform(0.025, 0.05), rng.uniform(0.025, 0.045)
    x, spread = rng.uniform(0.25, 0.36), rng.uniform(0.12, 0.24)
    legs = [line((x, height - thick / 2), (x + side * spread / 2, 0), width=leg) for side in (-1, 1)]
    tie = box((spread * 0.5, 0.02), at=(x, height * 0.4))
    return (top(rng, height, thick) | pair(union(*legs, tie))) & box((2, height), at=(0, height / 2))


def crossed(rng: Random) -> Sketch:
    height, thick, leg = rng.uniform(0.5, 0.8), rng.uniform(0.03, 0.06), rng.uniform(0.03, 0.06)
    x = rng.uniform(0.3, 0.45)
    bar = line((-x, 0), (x, height - thick / 2), width=leg)
    return (top(rng, height, thick) | pair(bar)) & box((2, height), at=(0, height / 2))


def three_legs(rng: Random) -> Sketch:
    height, thick, leg = rng.uniform(0.45, 0.75), rng.uniform(0.03, 0.05), rng.uniform(0.035, 0.06)
    x = 0.5 - leg / 2 - rng.uniform(0.0, 0.05)
    bowed = spline((x, height - thick), (x + 0.01, height * 0.8), (x + rng.uniform(0, 0.03), 0))
    return top(rng, height, thick) | pair(polyline(bowed, width=leg)) | box((leg, height), at=(0, height / 2))


def desk(rng: Random) -> Sketch:
    """With a closed body that hangs between its legs, or stands."""
    height, thick, leg = rng.uniform(0.5, 0.8), rng.uniform(0.03, 0.05), rng.uniform(0.03, 0.06)
    x, low = 0.5 - leg / 2 - rng.uniform(0.0, 0.03), rng.choice([0.0, 0.15, 0.45]) * height
    body = box((2 * x * rng.choice([0.8, 1.0]), height - low), at=(0, (height + low) / 2))
    return top(rng, height, thick) | pair(box((leg, height), at=(x, height / 2))) | body


def braced(rng: Random) -> Sketch:
    height, leg = rng.uniform(0.45, 0.65), rng.uniform(0.03, 0.05)
    x = rng.uniform(0.4, 0.46)
    ends = ((x, 0.5 * height), (0, height - 0.02)) if rng.random() < 0.5 else ((x, height - 0.02), (0, 0.45 * height))
    return top(rng, height, 0.05) | pair(box((leg, height), at=(x, height / 2)) | line(*ends, width=leg))


COUNTS: dict[Callable[[Random], Sketch], int] = {
    plain: 9,
    with_apron: 8,
    with_bar: 6,
    with_shelves: 3,
    splayed: 6,
    pedestal: 6,
    trestle: 3,
    crossed: 2,
    three_legs: 3,
    desk: 2,
    braced: 2,
}
"""Kinds of tables, and how many of each are drawn."""


def bench(rng: Random) -> Sketch:
    """A seat, two or three legs, sometimes a back: the worked example."""
    height, leg = rng.uniform(0.2, 0.4), rng.uniform(0.04, 0.08)
    count = int(rng.integers(2, 4))
    step = (0.96 - leg) / (count - 1)
    legs = box((leg, height), at=(leg / 2 - 0.48, height / 2)).array(count, (step, 0))
    seat = box((1, 0.06), at=(0, height - 0.03)) | legs
    if rng.random() < 0.5:
        return seat
    return seat | box((1, 0.1), at=(0, 1.7 * height)) | pair(box((leg, height), at=(0.48 - leg / 2, 1.3 * height)))


def tables() -> dict[str, Drawing]:
    """The fifty drawings by name; the same ones every time."""
    rng = np.random.default_rng(SEED)
    return {
        f"{kind.__name__.replace('_', '-')}-{i + 1}": kind(rng).drawing()
        for kind, count in COUNTS.items()
        for i in range(count)
    }


def benches(count: int = 6) -> dict[str, Drawing]:
    """A few benches by name."""
    rng = np.random.default_rng(SEED)
    return {f"bench-{i + 1}": bench(rng).drawing() for i in range(count)}


def write(folder: Path) -> list[Path]:
    """Write the tables into a folder, made if it is not there, as SVG and PNG; the same files every time."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for i, (name, drawing) in enumerate(tables().items()):
        picture = i % PICTURES == PICTURES - 1
        paths.append(folder / f"{name}.{'png' if picture else 'svg'}")
        paths[-1].write_bytes(png(drawing) if picture else svg(drawing))
    return paths
