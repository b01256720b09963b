"""Beds, version 3: bunk beds and cots, blankets that hang out at the sides, pillows."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.grammar import Grammar
from shapewright.modelling.solids import chamfered_box, extrude

MATTRESS = 0.45  # its part of the height from below the frame to its own top
BLANKET = 0.03  # how far a blanket hangs out at the sides
RAIL = 0.12  # how far side rails rise above the mattress at least
SPINDLE, SPACE = 0.02, 0.11  # the thickness of spindles, and the room between them
ARCH = extrude([(0.1 * i, 0.5 - 0.04 * i * i) for i in range(-5, 6)], 1).rotate(-90, "x")
PILLOW = chamfered_box((1, 0.4, 0.7), 0.12).scale((1, 1 / 0.4, 1 / 0.7))

bed = Grammar()


# Posts, and one storey or two


@bed.rule("bed")
def posts(box, board, head, foot, storey, blanket):
    body = box.inset(x=BLANKET) if blanket else box
    for corner, rise in zip(body.corners(board), (head, head, foot, foot), strict=True):
        yield corner.inset(y=(0, -storey - rise)).tag("post")
    if storey:
        yield body.tag("lower storey")
    yield body.move((0, storey, 0)).tag("storey")


@bed.rule("storey")
def parts(box, clearance, board, head, foot):
    back, middle, front = box.split("y", clearance * box.height, ...)[1].split("z", board, ..., board)
    yield from (back.tag("panel"), back.face("top").extrude(head).tag("head"))
    yield from (front.tag("panel"), front.face("top").extrude(foot).tag("foot"))
    yield middle.tag("couch")


@bed.rule("lower storey")
def lower_parts(box, clearance, board, head, foot, headroom):
    back, middle, front = box.split("y", clearance * box.height, ...)[1].split("z", board, ..., board)
    yield from (back.tag("panel"), back.face("top").extrude(min(head, 0.8 * headroom)).tag("end"))
    yield from (front.tag("panel"), front.face("top").extrude(min(foot, 0.8 * headroom)).tag("end"))
    yield middle.tag("couch")


# Head and foot: panels or spindles, on top an arch


@bed.rule("head")
def head_board(box, arch):
    yield box.tag("end")
    yield box.face("top").extrude(arch * box.width).fill(ARCH.scale).tag("arch")


@bed.rule("foot")
def foot_board(box, arch):
    yield box.tag("end")
    yield box.face("top").extrude(arch / 2 * box.width).fill(ARCH.scale).tag("arch")


@bed.rule("end", when=lambda p: p.ends == "panels")
def panel(box):
    yield box.label("panel")


@bed.rule("end")
def spindles(box, board):
    yield box.split("y", ..., min(board, box.height / 2))[1].tag("rail")
    yield from (spindle.tag("spindle") for spindle in row(box, "x"))


def row(box, axis):
    """Places for spindles at equal distances."""
    number = round(box.width / (SPINDLE + SPACE)) if axis == "x" else round(box.depth / (SPINDLE + SPACE))
    places = box.repeat(axis, count=number + 2, size=SPINDLE)[1:-1]
    return [place.sub((SPINDLE, None, SPINDLE)) for place in places]


# Between them: a frame, a mattress and what lies on it


@bed.rule("couch")
def bedding(box, board, blanket, rails, side_rails):
    frame, mattress = box.split("y", ..., MATTRESS * box.height)
    yield frame.tag("frame")
    yield mattress.inset(x=board).tag("mattress")
    top = box.face("top")
    yield top.inset(x=board, z=(0.02, 0)).split("z", 0.24, ...)[0].extrude(0.08).tag("pillows")
    if blanket:
        yield box.split("z", 0.3, ...)[1].inset(x=-BLANKET, y=(0.3 * box.height, -0.012)).tag("blanket")
    if rails:
        yield from (side.extrude(side_rails).tag("side") for side in top.ends("x", board))


@bed.rule("pillows", when=lambda p: p.pillows > 0)
def pillow_row(box, pillows):
    for place in box.repeat("x", count=pillows):
        yield place.inset(y=(-0.01, 0)).sub((0.4 * box.width, None, None)).fill(PILLOW.scale).tag("pillow")


@bed.rule("pillows")
def no_pillows(box):
    return []


@bed.rule("side")
def side_rail(box):
    yield box.split("y", ..., 0.025)[1].tag("rail")
    yield from (spindle.tag("spindle") for spindle in row(box, "z"))


@procedure
def beds(
    width: Annotated[float, Range(0.4, 1.0)] = 0.7,
    height: Annotated[float, Range(0.15, 0.5)] = 0.25,
    clearance: Annotated[float, Range(0.05, 0.6)] = 0.3,
    head: Annotated[float, Range(0.1, 0.45)] = 0.2,
    foot: Annotated[float, Range(0.04, 0.35)] = 0.06,
    board: Annotated[float, Range(0.025, 0.06)] = 0.035,
    arch: Annotated[float, Range(0.02, 0.2)] = 0.06,
    ends: Literal["panels", "spindles"] = "panels",
    pillows: Annotated[int, Range(0, 2)] = 2,
    blanket: bool = False,
    rails: bool = False,
    bunk: bool = False,
    headroom: Annotated[float, Range(0.15, 0.45, when=lambda p: p.bunk)] = 0.3,
):
    """A bed, a cot or a bunk bed, of length 1.

    width: of all. height: of the mattress's top above the floor. clearance: the part of this height below the frame.
    head, foot: how far the posts at both ends rise above the mattress. board: the thickness of posts, head and foot.
    arch: how far the head rises between its posts, as a part of its width, and the foot half as far. ends: what head
    and foot are above the mattress. pillows: side by side. blanket: whether there is one. rails: whether the long
    sides have them, as high as the foot. bunk: whether there is a second bed, with so much headroom above the first
    one's mattress.
    """
    side_rails = max(RAIL, foot)
    return bed.derive(
        (width, height, 1),
        clearance=clearance, head=head, foot=foot, board=board, arch=arch, ends=ends, pillows=pillows,
        blanket=blanket, rails=rails, headroom=headroom,
        side_rails=min(side_rails, 0.8 * headroom) if bunk else side_rails,
        storey=headroom + (1 - clearance) * height if bunk else 0,
    )  # fmt: skip
