import numpy as np
import pytest

from shapewright.parameters import Binary, Excess, Integer, ParameterSpace, Scalar, whole_number

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
    assert SPACE.pressed(values()) == set()
    assert SPACE.pressed(values(height=0.99, tilt=-1.0)) == {("height", "high"), ("tilt", "low")}
    assert SPACE.pressed(values(shelves=3)) == {("shelves", "high")}
    assert SPACE.pressed(values(gap=0.0)) == {("gap", "low")}
    assert SPACE.pressed(values(gap=0.0, shelves=0)) == {("shelves", "low")}


def test_a_widened_space_keeps_the_sense_of_its_numbers():
    wide = SPACE.widened()
    assert (wide["height"].low, wide["height"].high) == (0.125, 2.0)
    assert (wide["tilt"].low, wide["tilt"].high) == (-3.0, 5.0)
    assert (wide["gap"].low, round(wide["gap"].high, 9)) == (0.0, 0.6)
    assert (wide["shelves"].low, wide["shelves"].high) == (0, 6)
    assert wide["round"] == SPACE["round"] and wide["height"].steps is None
    assert wide.active(values(shelves=0)) == SPACE.active(values(shelves=0))


def test_limits_are_the_spaces_own_but_for_free_ends():
    wide = SPACE.widened()
    low, high = SPACE.limits(wide, [set(), {("height", "high")}])
    own = [wide["height"].encode(end) for end in (0.5, 1.0)]
    assert np.allclose([low[0, 0], high[0, 0]], own)
    assert np.allclose([low[1, 0], high[1, 0]], [own[0], 1.0])
    assert wide["height"].decode(high[1, 0]) == 2.0


def test_values_outside_are_those_past_an_end():
    assert SPACE.outside(values(height=1.0)) == ()
    high, low = SPACE.outside(values(height=1.4, tilt=-1.5))
    assert high == Excess("height", 1.4, 1.0, "high")
    assert low == Excess("tilt", -1.5, -1.0, "low")
    assert SPACE.outside(values(gap=0.4, shelves=0)) == ()


def test_clipping_moves_only_the_named_parameters():
    outside = values(height=1.4, tilt=-1.5)
    assert SPACE.clipped(outside, ["height"]) == {**outside, "height": 1.0}


def test_the_author_is_shown_scalars_nearer_to_an_end_than_a_search_asks_for():
    near = values(height=0.987, shelves=3)
    assert SPACE.at_limit(near) == () and SPACE.pressed(near) == {("height", "high"), ("shelves", "high")}
    assert SPACE.at_limit(values(height=0.995, gap=0.0)) == ("height", "gap")


def test_an_integer_has_no_margins():
    many = Integer("many", 0, 200, 1)
    assert many.end_at(1, 0.03) is None and many.end_at(0, 0.03) == "low"
    assert many.end_passed(201) == "high" and many.end_passed(200) is None


def test_a_longer_range_of_an_integer_adds_at_least_what_is_asked_for():
    assert Integer("n", 1, 2, 1).widened() == Integer("n", 1, 3, 1)
    assert Integer("n", 1, 2, 1).widened(least=2) == Integer("n", 1, 4, 1)


@pytest.mark.parametrize(("values", "kind"), [(2, Integer), (16, Integer), (17, Scalar), (26, Scalar), (2000, Scalar)])
def test_an_integer_of_more_than_sixteen_values_is_a_number_that_is_rounded(values, kind):
    hole = whole_number("hole", 5, 4 + values, 5)
    assert isinstance(hole, kind) and bool(hole.classes) == (kind is Integer)
    numbers = range(5, 5 + values)
    decoded = [hole.decode(hole.encode(number)) for number in numbers]
    assert decoded == list(numbers) and {type(number) for number in decoded} == {int}
    if kind is Scalar:
        between = [hole.decode(encoded) for encoded in np.linspace(0, 1, 7)]
        assert {type(number) for number in between} == {int}
        assert between == sorted(between) and (between[0], between[-1]) == (5, 4 + values)
