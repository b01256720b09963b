"""Shelves, version 1: an open bookcase."""

from typing import Annotated

from shapewright import Infeasible, Range, procedure
from shapewright.modelling.grammar import Grammar

BACK = 0.01
NARROW = 0.02  # no compartment is less high or wide

shelf = Grammar()


@shelf.rule("shelves")
def compartments(box, board, rows, columns, back):
    if min((box.height - board) / rows, (box.width - board) / columns) < board + NARROW:
        raise Infeasible("the compartments are too narrow for anything to be kept in them")
    yield from (plank.tag("board") for plank in box.repeat("y", count=rows + 1, size=board))
    yield from (panel.tag("panel") for panel in box.repeat("x", count=columns + 1, size=board))
    if back:
        yield box.split("z", BACK, ...)[0].tag("back")


@procedure
def shelves(
    upright: Annotated[float, Range(0.22, 0.82)] = 0.65,
    depth: Annotated[float, Range(0.1, 0.6)] = 0.16,
    board: Annotated[float, Range(0.01, 0.04)] = 0.02,
    columns: Annotated[int, Range(1, 3)] = 1,
    rows: Annotated[int, Range(1, 5)] = 4,
    back: bool = True,
):
    """An open bookcase, with a back or without.

    Width and height together are 1; upright: the height. depth: of all. board: the thickness of boards and panels.
    columns, rows: of compartments.
    """
    return shelf.derive((1 - upright, upright, depth), board=board, columns=columns, rows=rows, back=back)
