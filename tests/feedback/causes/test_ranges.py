import numpy as np

from shapewright.feedback.causes.ranges import Wish, beyond, inside, limits, pressed, widened
from shapewright.parameters import Binary, Integer, ParameterSpace, Scalar

SPACE = ParameterSpace(
    (
        Scalar("height", 0.5, 1.0, 0.7, steps=6),
        Scalar("tilt", -1.0, 1.0, 0.0),
        Scalar("gap", 0.0, 0.2, 0.1, when=lambda p: p.shelves > 0),
        Integer("shelves", 0, 3, 1),
        Binary("round", False),
    )
)


def values(**changes):
    return {**SPACE.defaults, **changes}


def test_pressed_ends_are_those_of_numbers_that_matter():
    assert pressed(SPACE, values()) == set()
    assert pressed(SPACE, values(height=0.99, tilt=-1.0)) == {("height", "high"), ("tilt", "low")}
    assert pressed(SPACE, values(shelves=3)) == {("shelves", "high")}
    assert pressed(SPACE, values(gap=0.0)) == {("gap", "low")}
    assert pressed(SPACE, values(gap=0.0, shelves=0)) == {("shelves", "low")}


def test_a_widened_space_keeps_the_sense_of_its_numbers():
    wide = widened(SPACE)
    assert (wide["height"].low, wide["height"].high) == (0.125, 2.0)
    assert (wide["tilt"].low, wide["tilt"].high) == (-3.0, 5.0)
    assert (wide["gap"].low, round(wide["gap"].high, 9)) == (0.0, 0.6)
    assert (wide["shelves"].low, wide["shelves"].high) == (0, 6)
    assert wide["round"] == SPACE["round"] and wide["height"].steps is None
    assert wide.active(values(shelves=0)) == SPACE.active(values(shelves=0))


def test_limits_are_the_spaces_own_but_for_free_ends():
    wide = widened(SPACE)
    low, high = limits(SPACE, wide, [set(), {("height", "high")}])
    own = [wide["height"].encode(end) for end in (0.5, 1.0)]
    assert np.allclose([low[0, 0], high[0, 0]], own)
    assert np.allclose([low[1, 0], high[1, 0]], [own[0], 1.0])
    assert wide["height"].decode(high[1, 0]) == 2.0


def test_wishes_are_what_lies_outside():
    assert beyond(SPACE, values(height=1.0)) == ()
    high, low = beyond(SPACE, values(height=1.4, tilt=-1.5))
    assert high == Wish("height", 1.4, 1.0) and high.side == "high"
    assert low == Wish("tilt", -1.5, -1.0) and low.side == "low"
    assert beyond(SPACE, values(gap=0.4, shelves=0)) == ()


def test_inside_moves_only_the_named_parameters():
    outside = values(height=1.4, tilt=-1.5)
    assert inside(SPACE, outside, ["height"]) == {**outside, "height": 1.0}
