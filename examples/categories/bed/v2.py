"""Beds, version 2: head and foot are arched, and may be made of spindles; pillows."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.grammar import Grammar
from shapewright.modelling.solids import chamfered_box, extrude

MATTRESS = 0.45  # its part of the height from below the frame to its own top
SPINDLE, SPACE = 0.02, 0.11  # the thickness of spindles, and the room between them
ARCH = extrude([(0.1 * i, 0.5 - 0.04 * i * i) for i in range(-5, 6)], 1).rotate(-90, "x")
PILLOW = chamfered_box((1, 0.4, 0.7), 0.12).scale((1, 1 / 0.4, 1 / 0.7))

bed = Grammar()


@bed.rule("bed")
def posts(box, board, head, foot):
    for corner, rise in zip(box.corners(board), (head, head, foot, foot), strict=True):
        yield corner.inset(y=(0, -rise)).tag("post")
    yield box.tag("parts")


@bed.rule("parts")
def parts(box, clearance, board, head, foot):
    above = box.split("y", clearance * box.height, ...)[1]
    back, middle, front = above.split("z", board, ..., board)
    yield back.inset(y=(0, -head)).tag("head")
    yield front.inset(y=(0, -foot)).tag("foot")
    yield middle.tag("couch")


# Head and foot: panels or spindles below an arch


@bed.rule("head")
def head_board(box, head, arch):
    below, above = box.split("y", ..., head)
    yield below.tag("panel")
    yield above.tag("end")
    yield above.face("top").extrude(arch * box.width).fill(ARCH.scale).tag("arch")


@bed.rule("foot")
def foot_board(box, foot, arch):
    below, above = box.split("y", ..., foot)
    yield below.tag("panel")
    yield above.tag("end")
    yield above.face("top").extrude(arch / 2 * box.width).fill(ARCH.scale).tag("arch")


@bed.rule("end", when=lambda p: p.ends == "panels")
def panel(box):
    yield box.label("panel")


@bed.rule("end")
def spindles(box, board):
    yield box.split("y", ..., min(board, box.height / 2))[1].tag("rail")
    places = box.repeat("x", count=round(box.width / (SPINDLE + SPACE)) + 2, size=SPINDLE)[1:-1]
    yield from (place.sub((None, None, SPINDLE)).tag("spindle") for place in places)


# Between them: a frame, a mattress and what lies on it


@bed.rule("couch")
def bedding(box, board):
    frame, mattress = box.split("y", ..., MATTRESS * box.height)
    yield frame.tag("frame")
    yield mattress.inset(x=board).tag("mattress")
    top = box.face("top")
    yield top.inset(x=board, z=(0.02, 0)).split("z", 0.24, ...)[0].extrude(0.08).tag("pillows")


@bed.rule("pillows", when=lambda p: p.pillows > 0)
def pillow_row(box, pillows):
    for place in box.repeat("x", count=pillows):
        yield place.inset(y=(-0.01, 0)).sub((0.4 * box.width, None, None)).fill(PILLOW.scale).tag("pillow")


@bed.rule("pillows")
def no_pillows(box):
    return []


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
):
    """A bed of length 1.

    width: of all. height: of the mattress's top above the floor. clearance: the part of this height below the frame.
    head, foot: how far the posts at both ends rise above the mattress. board: the thickness of posts, head and foot.
    arch: how far the head rises between its posts, as a part of its width, and the foot half as far. ends: what head
    and foot are above the mattress. pillows: side by side.
    """
    return bed.derive(
        (width, height, 1),
        clearance=clearance, head=head, foot=foot, board=board, arch=arch, ends=ends, pillows=pillows,
    )  # fmt: skip
