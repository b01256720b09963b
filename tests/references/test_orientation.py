import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapewright.references import CollectionError, Orientation
from shapewright.references.orientation import AXES, QUARTER_TURNS

PAIRS = [(up, front) for up, front in itertools.product(AXES, AXES) if up[-1] != front[-1]]
coordinates = st.floats(-1e6, 1e6)


def unit(axis: str) -> np.ndarray:
    return np.eye(3)["xyz".index(axis[-1])] * (-1 if axis.startswith("-") else 1)


@pytest.mark.parametrize(("up", "front"), PAIRS)
def test_up_becomes_y_and_front_becomes_z_by_a_proper_rotation(up, front):
    orientation = Orientation(up, front)
    np.testing.assert_array_equal(unit(up) @ orientation.matrix.T, [0, 1, 0])
    np.testing.assert_array_equal(unit(front) @ orientation.matrix.T, [0, 0, 1])
    np.testing.assert_array_equal(orientation.matrix @ orientation.matrix.T, np.eye(3))
    assert np.linalg.det(orientation.matrix) == pytest.approx(1.0)


def test_there_are_24_orientations_and_they_differ():
    assert len({Orientation(*pair).matrix.tobytes() for pair in PAIRS}) == 24


@given(st.sampled_from(PAIRS), st.tuples(coordinates, coordinates, coordinates))
def test_invert_undoes_apply_exactly(pair, point):
    orientation = Orientation(*pair)
    np.testing.assert_array_equal(orientation.invert(point @ orientation.matrix.T), point)


@pytest.mark.parametrize(
    ("up", "front"), [("y", "z"), ("-y", "z"), ("x", "z"), ("-x", "z"), ("z", "-y"), ("-z", "-y"), (" +Z ", "-y")]
)
def test_the_front_by_convention(up, front):
    assert Orientation.of(up).front == front


def test_words_are_read_in_either_case():
    assert Orientation.of("Z", "-X") == Orientation("z", "-x")


@pytest.mark.parametrize(("up", "front"), [("w", "z"), ("", "z"), ("y", "forward"), ("--y", "z")])
def test_an_unknown_axis_is_named_with_what_there_is(up, front):
    with pytest.raises(CollectionError, match="is no axis; use one of x, y, z, -x, -y, -z"):
        Orientation.of(up, front)


@pytest.mark.parametrize("front", ["y", "-y"])
def test_up_and_front_on_one_axis_are_refused(front):
    with pytest.raises(CollectionError, match="parallel; use two different axes"):
        Orientation.of("y", front)


@pytest.mark.parametrize("quarters", range(5))
@pytest.mark.parametrize(("up", "front"), PAIRS[::5])
def test_a_turned_orientation_is_the_orientation_and_then_the_turn(up, front, quarters):
    turned = Orientation(up, front).turned(quarters)
    turn = QUARTER_TURNS[quarters % 4]
    np.testing.assert_array_equal(turned.matrix, turn @ Orientation(up, front).matrix)
    np.testing.assert_array_equal(QUARTER_TURNS[1] @ [0, 0, 1], [1, 0, 0])
