"""Forms that many things have: turned, bent, hollow and sloping ones."""

from math import cos, radians, sin
from typing import Annotated

from shapewright.modelling.solids import (
    Solid,
    Vector,
    box,
    cone,
    cylinder,
    ellipse,
    extrude,
    hull,
    rectangle,
    revolve,
    sphere,
    spline,
    sweep,
    union,
)
from shapewright.parameters import Range
from shapewright.rules.rule import rule


@rule("anywhere")
def turned_body(
    size: Vector,
    foot: Annotated[float, Range(0.1, 1.0)] = 0.5,
    low: Annotated[float, Range(0.1, 1.0)] = 0.9,
    middle: Annotated[float, Range(0.1, 1.0)] = 1.0,
    high: Annotated[float, Range(0.1, 1.0)] = 0.7,
    rim: Annotated[float, Range(0.1, 1.0)] = 0.5,
) -> Solid:
    """A body turned on a lathe: its widths at five heights, joined by a smooth curve."""
    line = spline((foot, 0), (low, 0.25), (middle, 0.5), (high, 0.75), (rim, 1))
    turned = revolve([(0, 0), *((max(r, 0.02), y) for r, y in line), (0, 1)])
    return turned.fit(size)


@rule("body")
def bowl(
    size: Vector, foot: Annotated[float, Range(0.2, 1.0)] = 0.5, wall: Annotated[float, Range(0.03, 0.2)] = 0.08
) -> Solid:
    """A round body with a wall, open at the top; foot: of the width."""
    width, height, depth = size
    outer = [(0.5 * foot, 0), (0.5 * (0.3 * foot + 0.7), 0.35), (0.5, 1)]
    inner = [(x - wall, max(y, wall)) for x, y in reversed(outer)]
    return revolve([(0, 0), *outer, *inner, (0, wall)]).translate((0, -0.5, 0)).scale((width, height, depth))


@rule("on")
def dome(size: Vector, wall: Annotated[float, Range(0.05, 0.3)] = 0.12) -> Solid:
    """Half a hollow ball that is open below."""
    width, height, depth = size
    ball = sphere((width, 2 * height, depth), (0, -height / 2, 0))
    hollow = sphere(((1 - wall) * width, 2 * (1 - wall) * height, (1 - wall) * depth), (0, -height / 2, 0))
    return (ball - hollow) & cylinder((2 * width, height, 2 * depth))


@rule("anywhere")
def block(size: Vector) -> Solid:
    """A plain block: a plate, a post or a panel."""
    return box(size)


@rule("anywhere")
def round_block(size: Vector) -> Solid:
    """A plain round block: a disc or a column."""
    return cylinder(size)


@rule("around")
def tube(
    size: Vector, wall: Annotated[float, Range(0.03, 0.3)] = 0.1, top: Annotated[float, Range(0.2, 1.0)] = 1.0
) -> Solid:
    """A hollow cylinder or cone, open at both ends; wall: of the width; top: how wide it is there, of the bottom."""
    inside = max(top / 2 - wall, 0.01)
    return revolve([(0.5 - wall, 0), (0.5, 0), (inside + wall, 1), (inside, 1)]).fit(size)


@rule("around")
def frame(size: Vector, bar: Annotated[float, Range(0.04, 0.3)] = 0.12) -> Solid:
    """A box, open above and below; bar: the thickness of its walls, of the narrower side."""
    width, height, depth = size
    wall = bar * min(width, depth)
    return box(size) - box((width - 2 * wall, 2 * height, depth - 2 * wall))


@rule("within")
def tray(size: Vector, wall: Annotated[float, Range(0.03, 0.2)] = 0.08) -> Solid:
    """A box, open above; wall: of its least extent."""
    width, height, depth = size
    side = wall * min(width, height, depth) * 2
    return box(size) - box((width - 2 * side, height, depth - 2 * side), (0, side, 0))


@rule("beside", turns=4)
def half_ring(size: Vector, thickness: Annotated[float, Range(0.08, 0.4)] = 0.18) -> Solid:
    """Half a ring that is open towards the body; thickness: of the height."""
    width, height, depth = size
    bar = min(thickness * height, 0.6 * width)
    path = [(x - width / 2, y, 0) for x, y in bow(width - bar / 2, (height - bar) / 2, bar)]
    return sweep(ellipse(depth, bar, segments=8), path).fit(size)


def bow(reach: float, half: float, bar: float) -> list[tuple[float, float]]:
    """Points (x, y) from x = 0 out to x = reach and back, ``half`` above and below y = 0, with round corners."""
    radius = min(reach, half) - bar / 10  # straight ends leave room for the slanted first cut of the bar
    turns = [radians(degrees) for degrees in range(0, 91, 15)]
    out = [(reach - radius + radius * sin(turn), half - radius + radius * cos(turn)) for turn in turns]
    return [(0, half), *out, *((x, -y) for x, y in reversed(out)), (0, -half)]


@rule("beside", turns=4)
def bracket(size: Vector, thickness: Annotated[float, Range(0.08, 0.4)] = 0.18) -> Solid:
    """Two bars that reach out, joined by an upright one."""
    width, height, depth = size
    bar = min(thickness * height, 0.6 * width)
    x, y = (width - bar) / 2, (height - bar) / 2
    handle = sweep(rectangle(depth, bar), [(-width / 2, y, 0), (x, y, 0), (x, -y, 0), (-width / 2, -y, 0)])
    return handle.fit(size)


@rule("on", turns=2)
def arch(size: Vector, thickness: Annotated[float, Range(0.04, 0.3)] = 0.1) -> Solid:
    """A bar bent to an arch that stands on both its ends."""
    width, height, depth = size
    bar = min(thickness * width, 0.6 * height)
    path = [(-y, x - height / 2, 0) for x, y in bow(height - bar / 2, (width - bar) / 2, bar)]
    return sweep(ellipse(bar, depth, segments=8), path).fit(size)


@rule("beside", turns=4)
def bent_bar(
    size: Vector, thickness: Annotated[float, Range(0.05, 0.4)] = 0.12, bend: Annotated[float, Range(0.4, 1.0)] = 0.7
) -> Solid:
    """A bar that rises and bends outwards; bend: the radius, of the shorter side."""
    width, height, depth = size
    bar = thickness * min(width, height)
    x, y = (width - bar) / 2, (height - bar) / 2
    radius = 2 * bend * min(x, y)
    turns = [radians(degrees) for degrees in range(0, 91, 15)]
    arc = [(radius - x - radius * cos(turn), y - radius + radius * sin(turn), 0) for turn in turns]
    return sweep(ellipse(bar, depth, segments=8), [(-x, -y - bar, 0), *arc, (x + bar, y, 0)]).fit(size)


@rule("on", turns=2)
def gable(size: Vector) -> Solid:
    """Two slopes that meet in a ridge from front to back."""
    width, height, depth = size
    gable = [(-width / 2, -height / 2), (width / 2, -height / 2), (0, height / 2)]
    return extrude(gable, depth).rotate(-90, "x").mirror("z")


@rule("on", turns=2)
def hip(size: Vector, ridge: Annotated[float, Range(0.0, 0.8)] = 0.4) -> Solid:
    """Four slopes; ridge: the part of the depth that the ridge has."""
    width, height, depth = size
    eaves = box((width, 0.02 * height, depth), (0, -0.49 * height, 0))
    top = box((0.01 * width, 0.02 * height, max(ridge, 0.01) * depth), (0, 0.49 * height, 0))
    return hull(eaves, top)


@rule("on")
def block_narrower_above(
    size: Vector,
    width_above: Annotated[float, Range(0.2, 0.95)] = 0.6,
    depth_above: Annotated[float, Range(0.2, 0.95)] = 0.6,
) -> Solid:
    """A block with sloping sides: how wide and deep it is above, of its width and depth below."""
    width, height, depth = size
    return extrude(rectangle(width, depth), height, taper=(width_above, depth_above))


@rule("under")
def block_narrower_below(
    size: Vector,
    width_below: Annotated[float, Range(0.2, 0.95)] = 0.6,
    depth_below: Annotated[float, Range(0.2, 0.95)] = 0.6,
) -> Solid:
    """A block with sloping sides: how wide and deep it is below, of its width and depth above."""
    width, height, depth = size
    return extrude(
        rectangle(width * width_below, depth * depth_below), height, taper=(1 / width_below, 1 / depth_below)
    )


@rule("front", turns=4)
def wedge(size: Vector, edge: Annotated[float, Range(0.0, 0.9)] = 0.1) -> Solid:
    """A block whose top slopes down to the front; edge: the height that it has there."""
    width, height, depth = size
    low = max(edge, 0.01) * height
    back = box((width, height, 0.01 * depth), (0, 0, -0.495 * depth))
    return hull(back, box((width, low, 0.01 * depth), (0, (low - height) / 2, 0.495 * depth)))


@rule("within")
def bars(
    size: Vector,
    columns: Annotated[int, Range(1, 8)] = 2,
    rows: Annotated[int, Range(1, 8)] = 2,
    thickness: Annotated[float, Range(0.1, 0.7)] = 0.3,
) -> Solid:
    """Upright and level bars across each other, as of a window; thickness: of the distance between them."""
    width, height, depth = size
    bar = thickness * min(width / (columns + 1), height / (rows + 1))
    across, up = (width - bar) / max(columns - 1, 1), (height - bar) / max(rows - 1, 1)
    upright = box((bar, height, depth), ((bar - width) / 2 if columns > 1 else 0, 0, 0))
    level = box((width, bar, depth), (0, (bar - height) / 2 if rows > 1 else 0, 0))
    return upright.array(columns, (across, 0, 0)) | level.array(rows, (0, up, 0))


@rule("front", turns=4)
def steps(size: Vector, count: Annotated[int, Range(2, 8)] = 3) -> Solid:
    """Steps that rise towards the back."""
    width, height, depth = size
    treads = []
    for i in range(count):
        tall, deep = height * (i + 1) / count, depth * (count - i) / count
        treads.append(box((width, tall, deep), (0, (tall - height) / 2, (deep - depth) / 2)))
    return union(*treads)


@rule("under")
def tapered_column(size: Vector, top: Annotated[float, Range(0.2, 1.0)] = 0.6) -> Solid:
    """A round column that grows narrower upwards."""
    return cone(size, bottom=1, top=top, segments=12)


@rule("body")
def necked_body(
    size: Vector,
    neck: Annotated[float, Range(0.1, 0.9)] = 0.4,
    shoulder: Annotated[float, Range(0.3, 0.9)] = 0.6,
    slope: Annotated[float, Range(0.02, 0.5)] = 0.3,
) -> Solid:
    """A round body under a neck; shoulder: the height where it begins to grow narrower; slope: how far, of the rest."""
    end = shoulder + slope * (1 - shoulder)
    return revolve([(0, 0), (1, 0), (1, shoulder), (neck, end), (neck, 1), (0, 1)]).fit(size)


@rule("body")
def domed_body(size: Vector, dome: Annotated[float, Range(0.05, 0.6)] = 0.3) -> Solid:
    """A round body under half a ball; dome: its part of the height."""
    width, height, depth = size
    top = dome * height
    ball = sphere((width, 2 * top, depth), (0, height / 2 - top, 0))
    return ball | cylinder((width, height - top, depth), (0, -top / 2, 0))


@rule("body")
def turned_shell(
    size: Vector,
    foot: Annotated[float, Range(0.4, 1.0)] = 0.6,
    middle: Annotated[float, Range(0.4, 1.0)] = 1.0,
    rim: Annotated[float, Range(0.4, 1.0)] = 0.8,
    wall: Annotated[float, Range(0.03, 0.15)] = 0.06,
) -> Solid:
    """A round body with a wall, open at the top: how wide it is below, in the middle and above."""
    outer = [(foot / 2, 0), (middle / 2, 0.5), (rim / 2, 1)]
    inner = [(x - wall, max(y, wall)) for x, y in reversed(outer)]
    return revolve([(0, 0), *outer, *inner, (0, wall)]).fit(size)


@rule("body")
def capped_body(
    size: Vector, cap: Annotated[float, Range(0.1, 0.6)] = 0.3, body: Annotated[float, Range(0.6, 1.0)] = 0.85
) -> Solid:
    """A round body under a cone; cap: its part of the height; body: how wide it is, of the cap."""
    width, height, depth = size
    top = cap * height
    column = cylinder((body * width, height - 0.9 * top, body * depth), (0, -0.45 * top, 0))
    return column | cone((width, top, depth), (0, (height - top) / 2, 0))
