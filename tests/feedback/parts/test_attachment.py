import numpy as np

from shapewright.feedback.parts.attachment import loose, separate
from shapewright.feedback.parts.pieces import Piece
from shapewright.modelling.solids import box
from shapewright.shapes import Mesh, concatenate

TOP = box((1, 0.05, 0.6), at=(0, 0.5, 0)).mesh()
COLUMN = Piece("cylinder", np.array([-0.05, -0.2, -0.05]), np.array([0.05, 0.47, 0.05]))
DISC = Piece("cylinder", np.array([-0.3, -0.25, -0.3]), np.array([0.3, -0.2, 0.3]))


def test_a_disc_hangs_in_the_air_without_its_column():
    assert loose([DISC], [TOP]) == 1
    assert loose([DISC, COLUMN], [TOP]) == 0
    assert loose([], [TOP]) == 0


def test_where_nothing_stands_pieces_hold_each_other():
    far = Piece("box", np.array([2.0, 0, 0]), np.array([2.1, 1, 0.1]))
    assert loose([COLUMN, DISC], []) == 0 and loose([COLUMN, far], []) == 1


def test_a_mirrored_copy_holds_as_well():
    bars = Piece("box", np.array([0.4, 0, 0]), np.array([0.5, 0.1, 0.4]), mirrored=(True, False))
    post = Piece("box", np.array([-0.5, 0.1, 0]), np.array([-0.4, 0.45, 0.1]))
    assert loose([bars, post], [TOP]) == 0


def test_narrow_gaps_do_not_separate():
    def apart(gap):
        return concatenate([TOP, box((0.1, 0.4, 0.1), at=(0, 0.275 - gap, 0)).mesh()])

    assert separate(TOP) == 1
    assert separate(apart(0.005)) == 1
    assert separate(apart(0.1)) == 2


def test_a_copy_that_touches_attaches_its_original_whichever_comes_first():
    leg = Piece("box", np.array([0.8, 0, 0]), np.array([1.0, 0.4, 0.1]), mirrored=(True, False))
    arm = Piece("box", np.array([-1.5, 0, 0]), np.array([-1.0, 0.1, 0.1]))
    assert loose([leg, arm], []) == loose([arm, leg], []) == 0
    assert loose([leg], [box((0.2, 0.1, 0.1), at=(-0.9, -0.05, 0.05)).mesh()]) == 0


def test_a_component_without_area_is_no_part():
    line = Mesh(np.array([[3.0, 0, 0], [4, 0, 0], [5, 0, 0]]), np.array([[0, 1, 2]]))
    assert separate(concatenate([TOP, line])) == 1
    assert loose([COLUMN], [line]) == 0
