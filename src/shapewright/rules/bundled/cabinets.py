"""What stands between the sides of furniture: shelves, compartments, drawers, doors; backs and arms of seats."""

from typing import Annotated

from shapewright.modelling.solids import Solid, Vector, box, cushion, sphere, union
from shapewright.parameters import Range
from shapewright.rules.rule import rule


@rule("within")
def shelves(
    size: Vector, count: Annotated[int, Range(2, 8)] = 3, thickness: Annotated[float, Range(0.05, 0.4)] = 0.15
) -> Solid:
    """Boards one above the other; thickness: of the distance between them."""
    width, height, depth = size
    board = thickness * height / count
    step = (height - board) / (count - 1)
    return box((width, board, depth), (0, (board - height) / 2, 0)).array(count, (0, step, 0))


@rule("within")
def compartments(
    size: Vector,
    columns: Annotated[int, Range(1, 6)] = 2,
    rows: Annotated[int, Range(1, 6)] = 3,
    board: Annotated[float, Range(0.01, 0.08)] = 0.03,
) -> Solid:
    """A box that is open in front, divided into columns and rows."""
    width, height, depth = size
    side = board * max(width, height)
    across, up = (width - side) / columns, (height - side) / rows
    upright = box((side, height, depth), ((side - width) / 2, 0, 0)).array(columns + 1, (across, 0, 0))
    level = box((width, side, depth), (0, (side - height) / 2, 0)).array(rows + 1, (0, up, 0))
    return upright | level | box((width, height, side), (0, 0, (side - depth) / 2))


@rule("front", turns=4)
def drawers(
    size: Vector,
    columns: Annotated[int, Range(1, 4)] = 1,
    rows: Annotated[int, Range(1, 6)] = 3,
    gap: Annotated[float, Range(0.02, 0.2)] = 0.06,
) -> Solid:
    """Fronts in columns and rows, each with a knob."""
    width, height, depth = size
    across, up = width / (columns - gap), height / (rows - gap)
    front = box(((1 - gap) * across, (1 - gap) * up, 0.6 * depth), (0, 0, -0.2 * depth))
    knob = 0.12 * min(across, up)
    drawer = front | sphere((knob, knob, 0.6 * depth), (0, 0, 0.2 * depth), segments=8)
    corner = ((1 - gap) * across - width) / 2, ((1 - gap) * up - height) / 2
    places = [(corner[0] + i * across, corner[1] + j * up, 0) for i in range(columns) for j in range(rows)]
    return union(*(drawer.translate(place) for place in places))


@rule("front", turns=4)
def doors(
    size: Vector, count: Annotated[int, Range(1, 4)] = 2, gap: Annotated[float, Range(0.01, 0.1)] = 0.03
) -> Solid:
    """Doors side by side, each with a handle."""
    width, height, depth = size
    across = width / (count - gap)
    leaf = box(((1 - gap) * across, height, 0.6 * depth), (0, 0, -0.2 * depth))
    handle = box((0.04 * across, 0.2 * height, 0.6 * depth), (0.4 * across, 0, 0.2 * depth))
    first = ((1 - gap) * across - width) / 2
    return union(*((leaf | handle).translate((first + i * across, 0, 0)) for i in range(count)))


@rule("back", turns=4)
def spindle_back(
    size: Vector,
    count: Annotated[int, Range(2, 9)] = 5,
    post: Annotated[float, Range(0.04, 0.2)] = 0.08,
    crest: Annotated[float, Range(0.06, 0.4)] = 0.15,
    spindle: Annotated[float, Range(0.15, 0.7)] = 0.35,
) -> Solid:
    """Two posts, a rail at the top, and upright spindles under it; spindle: of the distance between them."""
    width, height, depth = size
    side, top, step = post * width, crest * height, (1 - post) * width / (count + 1)
    posts = box((side, height, depth), ((width - side) / 2, 0, 0)).mirror("x", keep=True)
    rail = box((width, top, depth), (0, (height - top) / 2, 0))
    bar = box((spindle * step, height, 0.6 * depth), (-step * (count - 1) / 2, 0, 0))
    return posts | rail | bar.array(count, (step, 0, 0))


@rule("back", turns=4)
def ladder_back(
    size: Vector,
    count: Annotated[int, Range(1, 6)] = 3,
    post: Annotated[float, Range(0.04, 0.2)] = 0.08,
    rail: Annotated[float, Range(0.2, 0.8)] = 0.5,
    opening: Annotated[float, Range(0.0, 0.7)] = 0.2,
) -> Solid:
    """Two posts with rails between them, up to the top; rail: of the distance between them; opening: below them."""
    width, height, depth = size
    side, bay = post * width, (1 - opening) * height / count
    posts = box((side, height, depth), ((width - side) / 2, 0, 0)).mirror("x", keep=True)
    first = box((width - side, rail * bay, 0.7 * depth), (0, (height - rail * bay) / 2, 0))
    return posts | first.array(count, (0, -bay, 0))


@rule("back", turns=4)
def framed_back(size: Vector, post: Annotated[float, Range(0.05, 0.25)] = 0.1) -> Solid:
    """A thin panel in a frame."""
    width, height, depth = size
    bar = post * min(width, height)
    opening = box((width - 2 * bar, height - 2 * bar, 2 * depth))
    return (box(size) - opening) | box((width - bar, height - bar, 0.4 * depth))


@rule("around")
def open_arms(
    size: Vector, thickness: Annotated[float, Range(0.04, 0.2)] = 0.08, pad: Annotated[float, Range(0.08, 0.4)] = 0.15
) -> Solid:
    """At either side an arm on a post in front."""
    width, height, depth = size
    side, top = thickness * width, pad * height
    arm = box((side, top, depth), ((width - side) / 2, (height - top) / 2, 0))
    post = box((side, height, min(side, depth)), ((width - side) / 2, 0, (depth - min(side, depth)) / 2))
    return (arm | post).mirror("x", keep=True)


@rule("around")
def solid_arms(size: Vector, thickness: Annotated[float, Range(0.05, 0.35)] = 0.15) -> Solid:
    """At either side an arm that reaches down."""
    width, height, depth = size
    side = thickness * width
    return box((side, height, depth), ((width - side) / 2, 0, 0)).mirror("x", keep=True)


@rule("around")
def wrapped_back(size: Vector, thickness: Annotated[float, Range(0.05, 0.3)] = 0.12) -> Solid:
    """A back with arms of the same height."""
    width, height, depth = size
    side = thickness * min(width, depth)
    return box(size) - box((width - 2 * side, 2 * height, depth), (0, 0, side))


@rule("on")
def seat_cushions(
    size: Vector, count: Annotated[int, Range(1, 4)] = 2, crown: Annotated[float, Range(0.0, 0.6)] = 0.3
) -> Solid:
    """Cushions side by side."""
    width, height, depth = size
    each = width / count
    one = cushion((each, min(height, each, depth), depth), (0, 0, 0), crown).translate(((each - width) / 2, 0, 0))
    return one.array(count, (each, 0, 0)).scale((1, height / min(height, each, depth), 1))


@rule("back", turns=4)
def back_cushions(
    size: Vector, count: Annotated[int, Range(1, 4)] = 2, crown: Annotated[float, Range(0.0, 0.6)] = 0.3
) -> Solid:
    """Cushions that stand side by side."""
    width, height, depth = size
    each, thick = width / count, min(depth, width / count, height)
    one = cushion((each, thick, height), (0, 0, 0), crown).rotate(90, "x").translate(((each - width) / 2, 0, 0))
    return one.array(count, (each, 0, 0)).scale((1, 1, depth / thick))
