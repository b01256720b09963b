"""Shelves, version 3: racks on posts, cabinets below open shelves, tops that stand out."""

from typing import Annotated, Literal

from shapewright import Range, When, procedure
from shapewright.modelling.grammar import Grammar, share

BACK = 0.01
DOOR, DRAWER = 0.2, 0.12  # doors are about so wide, drawers so high
CROWN = 0.025  # how thick a top is that stands out, and how far it does
FRONT, GAP, GRIP = 0.02, 0.008, 0.015  # how thick they are, the gaps between them, and their handles

shelf = Grammar()


# From the top to the floor


@shelf.rule("shelf", when=lambda p: p.crown)
def crowned(box):
    body, top = box.split("y", ..., CROWN)
    yield top.tag("top")
    yield body.inset(x=CROWN, z=(0, CROWN)).tag("body")


@shelf.rule("shelf")
def plain(box):
    yield box.tag("body")


@shelf.rule("body", when=lambda p: p.stand == "floor")
def grounded(box):
    yield box.tag("case")


@shelf.rule("body")
def raised(box, stand, clearance):
    below, case = box.split("y", clearance * box.height, ...)
    yield below.tag(stand)
    yield case.tag("case")


@shelf.rule("plinth")
def plinth(box):
    yield box.inset(x=0.02, z=(0, 0.05)).label("plinth")


@shelf.rule("legs")
def legs(box, board, front):
    box = box.inset(z=(0, 0 if front == "open" else FRONT + GRIP))
    yield from (corner.tag("leg") for corner in box.corners((2 * board, min(2 * board, box.depth / 3))))


# Open, closed, or in part


@shelf.rule("case", when=lambda p: p.front == "open")
def open_case(box):
    yield box.tag("shelves")


@shelf.rule("case", when=lambda p: p.front == "half")
def half_open_case(box):
    closed, opened = box.split("y" if box.height > box.width else "x", share(2), share(3))
    yield closed.tag("closed")
    yield opened.inset(z=(0, FRONT + GRIP)).tag("shelves")


@shelf.rule("case")
def closed_case(box):
    yield box.tag("closed")


@shelf.rule("closed")
def doors_or_drawers(box):
    yield box.tag("chest" if box.width > box.height else "cupboard")


# Shelves: boards between panels or posts


@shelf.rule("shelves")
def compartments(box, board, along, across, back):
    _, rows = counts(box, along, across)
    yield from (plank.tag("board") for plank in box.repeat("y", count=rows + 1, size=board))
    yield box.tag("uprights")
    if back:
        yield box.split("z", BACK, ...)[0].tag("back")


@shelf.rule("uprights", when=lambda p: p.sides)
def panels(box, board, along, across):
    columns, _ = counts(box, along, across)
    yield from (panel.tag("panel") for panel in box.repeat("x", count=columns + 1, size=board))


@shelf.rule("uprights")
def posts(box, board, along, across):
    columns, _ = counts(box, along, across)
    for pair in box.repeat("x", count=columns + 1, size=board):
        yield from (post.tag("post") for post in pair.ends("z", min(board, box.depth / 3)))


def counts(box, along, across):
    """Columns and rows of compartments."""
    return (across, along) if box.height > box.width else (along, across)


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


def is_open(p):
    return p.front != "closed"


@procedure
def shelves(
    upright: Annotated[float, Range(0.25, 0.8)] = 0.65,
    depth: Annotated[float, Range(0.1, 0.6)] = 0.16,
    board: Annotated[float, Range(0.015, 0.035, when=lambda p: is_open(p) or p.stand == "legs")] = 0.02,
    along: Annotated[int, Range(1, 5, when=is_open)] = 4,
    across: Annotated[int, Range(1, 3, when=is_open)] = 1,
    front: Literal["open", "half", "closed"] = "open",
    back: Annotated[bool, When(is_open)] = True,
    sides: Annotated[bool, When(is_open)] = True,
    stand: Literal["floor", "plinth", "legs"] = "plinth",
    clearance: Annotated[float, Range(0.07, 0.35, when=lambda p: p.stand != "floor")] = 0.08,
    crown: bool = False,
):
    """Shelves, cupboards and chests of drawers.

    Width and height together are 1; upright: the height. depth: of all. board: the thickness of boards and posts; legs
    are twice as thick. along, across: compartments along the longer side of what is open, and the shorter. front: open,
    closed by doors or, where it is wider than high, by drawers, or two fifths of it closed, below or at the left. back,
    sides: whether open compartments have them; without sides boards rest on posts. clearance: the part of the height
    below the case. crown: whether the top stands out at the sides and in front.
    """
    return shelf.derive(
        (1 - upright, upright, depth),
        board=board, along=along, across=across, front=front, back=back, sides=sides,
        stand=stand, clearance=clearance, crown=crown,
    )  # fmt: skip
