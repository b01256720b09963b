import numpy as np
import pytest

from shapewright.axes.agreement import Z_UP, agreement
from shapewright.axes.linear import log_softmax
from shapewright.axes.turns import AS_IT_IS, TURNS

SURE = 8.0


def told(*turns):
    """What looks tell: one turn of each shape, all but surely."""
    values = np.zeros((len(turns), 24))
    values[np.arange(len(turns)), turns] = SURE
    return log_softmax(values)


def test_what_is_z_up_stands_right_after_that_turn():
    np.testing.assert_array_equal(TURNS[Z_UP] @ [0, 0, 1], [0, 1, 0])
    np.testing.assert_array_equal(TURNS[Z_UP] @ [0, -1, 0], [0, 0, 1])


@pytest.mark.parametrize("way", range(24))
def test_what_most_share_is_told_of_all(way):
    found = agreement(told(*[way] * 9, (way + 7) % 24), doubt=0.1)
    assert found.ways == (way,)
    assert (found.likely.argmax(axis=1) == way).all()


def test_two_sources_are_two_ways():
    found = agreement(told(*[AS_IT_IS] * 12, *[Z_UP] * 8), doubt=0.1)
    assert found.ways == (AS_IT_IS, Z_UP)
    assert found.likely.argmax(axis=1).tolist() == [AS_IT_IS] * 12 + [Z_UP] * 8


def test_where_nothing_is_shared_each_stands_as_it_looks():
    turns = np.random.default_rng(0).integers(0, 24, 40)
    assert (agreement(told(*turns), doubt=0.1).likely.argmax(axis=1) == turns).all()


def test_a_file_alone_needs_more_than_a_doubtful_look_to_be_turned():
    assert agreement(told(5), doubt=0.5).likely.argmax() == AS_IT_IS
    assert agreement(told(5), doubt=0.01).likely.argmax() == 5


def test_looks_that_tell_nothing_leave_all_as_it_is():
    found = agreement(np.full((6, 24), -np.log(24.0)), doubt=0.1)
    assert found.ways == (AS_IT_IS,)
    np.testing.assert_allclose(found.likely.sum(axis=1), 1.0)
