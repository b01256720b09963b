"""Parts of houses and towers."""

from typing import Annotated

from shapewright.modelling.solids import Solid, Vector, box, cylinder, extrude, hull, prism, union
from shapewright.parameters import Range
from shapewright.rules.rule import rule


@rule("on")
def spire(size: Vector, sides: Annotated[int, Range(4, 12)] = 4) -> Solid:
    """A roof that ends in a point, over as many sides."""
    low = prism((1, 0.02, 1), (0, -0.49, 0), sides=sides)
    return hull(low, box((0.01, 0.02, 0.01), (0, 0.49, 0))).fit(size)


@rule("on")
def battlements(
    size: Vector, count: Annotated[int, Range(2, 6)] = 3, height: Annotated[float, Range(0.2, 0.8)] = 0.5
) -> Solid:
    """A parapet with teeth; count: on each side; height: that of the teeth."""
    width, tall, depth = size
    wall = 0.12 * min(width, depth)
    parapet = box(size) - box((width - 2 * wall, 2 * tall, depth - 2 * wall))
    across, along = width / (2 * count - 1), depth / (2 * count - 1)
    notch, notches = height * tall, []
    for i in range(count - 1):
        x, z = (2 * i + 1.5) * across - width / 2, (2 * i + 1.5) * along - depth / 2
        notches.append(box((across, notch, 2 * depth), (x, (tall - notch) / 2 + 0.01 * tall, 0)))
        notches.append(box((2 * width, notch, along), (0, (tall - notch) / 2 + 0.01 * tall, z)))
    return parapet - union(*notches)


@rule("on")
def chimney(size: Vector, rim: Annotated[float, Range(0.05, 0.3)] = 0.15) -> Solid:
    """A shaft with a wider rim."""
    width, height, depth = size
    top = rim * height
    return box((0.75 * width, height, 0.75 * depth)) | box((width, top, depth), (0, (height - top) / 2, 0))


@rule("front", turns=4)
def dormer(size: Vector, wall: Annotated[float, Range(0.3, 0.8)] = 0.5) -> Solid:
    """A small house that looks out of a roof; wall: the part of the height below its gable."""
    width, height, depth = size
    low = wall * height
    gable = [(-width / 2, -height / 2), (width / 2, -height / 2), (width / 2, low - height / 2)]
    gable += [(0, height / 2), (-width / 2, low - height / 2)]
    return extrude(gable, depth).rotate(-90, "x").mirror("z")


@rule("front", turns=4)
def porch(
    size: Vector, posts: Annotated[int, Range(2, 6)] = 2, thickness: Annotated[float, Range(0.04, 0.2)] = 0.08
) -> Solid:
    """A roof on posts in front of a wall."""
    width, height, depth = size
    side, top = thickness * width, 0.12 * height
    roof = box((width, top, depth), (0, (height - top) / 2, 0))
    post = box((side, height, min(side, depth)), ((side - width) / 2, 0, (depth - min(side, depth)) / 2))
    return roof | post.array(posts, ((width - side) / (posts - 1), 0, 0))


@rule("around")
def colonnade(
    size: Vector, count: Annotated[int, Range(2, 8)] = 4, thickness: Annotated[float, Range(0.1, 0.5)] = 0.3
) -> Solid:
    """Columns in front and at the back; count: in a row; thickness: of the distance between them."""
    width, height, depth = size
    side = min(thickness * width / count, depth / 2)
    post = cylinder((side, height, side), ((side - width) / 2, 0, (depth - side) / 2), segments=12)
    return post.array(count, ((width - side) / (count - 1), 0, 0)).mirror("z", keep=True)


@rule("under")
def braced_posts(
    size: Vector, thickness: Annotated[float, Range(0.04, 0.2)] = 0.08, level: Annotated[float, Range(0.2, 0.8)] = 0.5
) -> Solid:
    """Four posts with bars between them all round; level: the height of the bars."""
    width, height, depth = size
    side = thickness * min(width, depth)
    post = box((side, height, side), ((width - side) / 2, 0, (depth - side) / 2))
    bars = box((width, side, depth)) - box((width - 1.4 * side, 2 * side, depth - 1.4 * side))
    bars = bars.translate((0, (level - 0.5) * (height - side), 0))
    return post.mirror("x", keep=True).mirror("z", keep=True) | bars


@rule("front", turns=4)
def windows(
    size: Vector,
    columns: Annotated[int, Range(1, 6)] = 2,
    rows: Annotated[int, Range(1, 6)] = 2,
    gap: Annotated[float, Range(0.2, 0.8)] = 0.5,
) -> Solid:
    """Windows in columns and rows, as blocks that stand out from a wall; gap: between them, of their distance."""
    width, height, depth = size
    across, up = width / (columns - gap), height / (rows - gap)
    pane = box(((1 - gap) * across, (1 - gap) * up, depth))
    corner = ((1 - gap) * across - width) / 2, ((1 - gap) * up - height) / 2
    places = [(corner[0] + i * across, corner[1] + j * up, 0) for i in range(columns) for j in range(rows)]
    return union(*(pane.translate(place) for place in places))


@rule("beside", turns=4)
def wing(size: Vector, wall: Annotated[float, Range(0.4, 1.0)] = 0.7) -> Solid:
    """A lower house beside the house, with a gable; wall: the part of its height below the gable."""
    width, height, depth = size
    low = wall * height
    gable = [(-depth / 2, -height / 2), (depth / 2, -height / 2), (depth / 2, low - height / 2)]
    gable += [(0, height / 2), (-depth / 2, low - height / 2)] if wall < 1 else [(-depth / 2, height / 2)]
    return extrude(gable, width).rotate(-90, "x").rotate(90)


@rule("front", turns=4)
def sails(
    size: Vector, count: Annotated[int, Range(3, 6)] = 4, breadth: Annotated[float, Range(0.05, 0.3)] = 0.15
) -> Solid:
    """The sails of a windmill, around a hub."""
    _, height, depth = size
    sail = box((breadth * height, 0.5 * height, 0.4 * depth), (0, 0.25 * height, 0)).polar_array(count, "z")
    wheel = sail | cylinder((0.14 * height, depth, 0.14 * height)).rotate(90, "x")
    return wheel.fit(size)
