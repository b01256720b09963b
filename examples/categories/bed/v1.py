"""Beds, version 1: a mattress in a frame between two boards, on four posts."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.grammar import Grammar

MATTRESS = 0.45  # its part of the height from below the frame to its own top

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


@bed.rule("couch")
def bedding(box, board):
    frame, mattress = box.split("y", ..., MATTRESS * box.height)
    yield frame.tag("frame")
    yield mattress.inset(x=board).tag("mattress")


@procedure
def beds(
    width: Annotated[float, Range(0.4, 1.0)] = 0.7,
    height: Annotated[float, Range(0.15, 0.5)] = 0.25,
    clearance: Annotated[float, Range(0.05, 0.6)] = 0.3,
    head: Annotated[float, Range(0.1, 0.45)] = 0.2,
    foot: Annotated[float, Range(0.04, 0.35)] = 0.06,
    board: Annotated[float, Range(0.025, 0.06)] = 0.035,
):
    """A bed of length 1.

    width: of all. height: of the mattress's top above the floor. clearance: the part of this height below the frame.
    head, foot: how far the boards at both ends rise above the mattress. board: the thickness of posts, head and foot.
    """
    return bed.derive((width, height, 1), clearance=clearance, head=head, foot=foot, board=board)
