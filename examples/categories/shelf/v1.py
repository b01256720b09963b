"""Shelves, version 1: an open bookcase."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.grammar import Grammar

BACK = 0.01

shelf = Grammar()


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


@procedure
def shelves(
    upright: Annotated[float, Range(0.25, 0.8)] = 0.65,
    depth: Annotated[float, Range(0.1, 0.6)] = 0.16,
    board: Annotated[float, Range(0.015, 0.035)] = 0.02,
    along: Annotated[int, Range(1, 5)] = 4,
    across: Annotated[int, Range(1, 3)] = 1,
    back: bool = True,
):
    """An open bookcase, with a back or without.

    Width and height together are 1; upright: the height. depth: of all. board: the thickness of boards and panels.
    along, across:
    compartments along the longer side, and the shorter.
    """
    return shelf.derive((1 - upright, upright, depth), board=board, along=along, across=across, back=back)
