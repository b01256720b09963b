"""Shelves, version 2: the case may stand on legs or a plinth, and be closed by doors or drawers."""

from typing import Annotated, Literal

from shapewright import Range, When, procedure
from shapewright.modelling.grammar import Grammar

BACK = 0.01
DOOR, DRAWER = 0.2, 0.12  # doors are about so wide, drawers so high
FRONT, GAP, GRIP = 0.02, 0.008, 0.015  # how thick they are, the gaps between them, and their handles

shelf = Grammar()


# The floor and the case


@shelf.rule("shelf", when=lambda p: p.stand == "floor")
def grounded(box):
    yield box.tag("case")


@shelf.rule("shelf")
def raised(box, stand, clearance):
    below, case = box.split("y", clearance * box.height, ...)
    yield below.tag(stand)
    yield case.tag("case")


@shelf.rule("plinth")
def plinth(box):
    yield box.inset(x=0.02, z=(0, 0.05)).label("plinth")


@shelf.rule("legs")
def legs(box, board, closed):
    box = box.inset(z=(0, FRONT + GRIP if closed else 0))
    yield from (corner.tag("leg") for corner in box.corners((board, min(board, box.depth / 3))))


@shelf.rule("case", when=lambda p: not p.closed)
def open_case(box):
    yield box.tag("shelves")


@shelf.rule("case")
def closed_case(box):
    yield box.tag("chest" if box.width > box.height else "cupboard")


# Shelves


def counts(box, along, across):
    """Columns and rows of compartments."""
    return (across, along) if box.height > box.width else (along, across)


@shelf.rule("shelves")
def compartments(box, board, along, across, back):
    columns, rows = counts(box, along, across)
    yield from (plank.tag("board") for plank in box.repeat("y", count=rows + 1, size=board))
    yield from (panel.tag("panel") for panel in box.repeat("x", count=columns + 1, size=board))
    if back:
        yield box.split("z", BACK, ...)[0].tag("back")


# Doors and drawers, as many as fit


@shelf.rule("cupboard")
def doors(box):
    carcase, ahead = box.split("z", ..., FRONT + GRIP)
    yield carcase.tag("carcase")
    for door in ahead.inset(x=GAP, y=GAP).repeat("x", size=DOOR, gap=GAP):
        leaf, grip = door.split("z", FRONT, ...)
        yield leaf.tag("door")
        yield grip.sub((GRIP, door.height / 3, None), anchor=(0.9, 0.6, 0.5)).tag("handle")


@shelf.rule("chest")
def drawers(box):
    carcase, ahead = box.split("z", ..., FRONT + GRIP)
    yield carcase.tag("carcase")
    for drawer in ahead.inset(x=GAP, y=GAP).repeat("y", size=DRAWER, gap=GAP):
        leaf, grip = drawer.split("z", FRONT, ...)
        yield leaf.tag("drawer")
        yield grip.sub((drawer.width / 3, GRIP, None), anchor=(0.5, 0.7, 0.5)).tag("handle")


@procedure
def shelves(
    upright: Annotated[float, Range(0.25, 0.8)] = 0.65,
    depth: Annotated[float, Range(0.1, 0.6)] = 0.16,
    board: Annotated[float, Range(0.015, 0.035, when=lambda p: not p.closed or p.stand == "legs")] = 0.02,
    along: Annotated[int, Range(1, 5, when=lambda p: not p.closed)] = 4,
    across: Annotated[int, Range(1, 3, when=lambda p: not p.closed)] = 1,
    closed: bool = False,
    back: Annotated[bool, When(lambda p: not p.closed)] = True,
    stand: Literal["floor", "plinth", "legs"] = "plinth",
    clearance: Annotated[float, Range(0.07, 0.35, when=lambda p: p.stand != "floor")] = 0.08,
):
    """Shelves, cupboards and chests of drawers.

    Width and height together are 1; upright: the height. depth: of all. board: the thickness of boards, panels and
    legs. along, across: open compartments along the longer side, and the shorter. closed: by doors or, where the case
    is wider than high, by drawers. back: whether open compartments have one. clearance: the part of the height below
    the case.
    """
    return shelf.derive(
        (1 - upright, upright, depth),
        board=board, along=along, across=across, closed=closed, back=back, stand=stand, clearance=clearance,
    )  # fmt: skip
