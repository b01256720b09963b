import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapewright.parameters import Binary, Choice, Integer, ParameterSpace, Scalar

ends = st.floats(-1e6, 1e6, allow_nan=False).flatmap(
    lambda low: st.tuples(st.just(low), st.floats(low + 1e-3 + abs(low) * 1e-6, low + 2e6, allow_nan=False))
)


@st.composite
def scalars(draw, name="s"):
    low, high = draw(ends)
    return Scalar(name, low, high, low, draw(st.none() | st.integers(2, 12)))


@st.composite
def spaces(draw):
    parameters = [
        draw(scalars("s")),
        Integer("i", low := draw(st.integers(-50, 50)), low + draw(st.integers(1, 20)), low),
        Choice("c", ("a", "b", "c")[: draw(st.integers(2, 3))], "a"),
        Binary("b", False),
    ]
    return ParameterSpace(tuple(draw(st.permutations(parameters))))


@given(spaces(), st.integers(0, 2**32 - 1))
def test_decode_inverts_encode(space, seed):
    for values in space.sample(5, seed=seed):
        encoded = space.encode(values)
        decoded = space.decode(encoded)
        for parameter in space:
            if isinstance(parameter, Scalar):
                tolerance = 1e-12 * max(abs(parameter.low), abs(parameter.high))
                assert decoded[parameter.name] == pytest.approx(values[parameter.name], abs=tolerance)
                assert 0.0 <= encoded[space.names.index(parameter.name)] <= 1.0
            else:
                assert decoded[parameter.name] == values[parameter.name]
                assert type(decoded[parameter.name]) is type(values[parameter.name])


@given(spaces(), st.lists(st.floats(-3, 30), min_size=4, max_size=4))
def test_decode_stays_inside_the_space(space, encoded):
    again = space.encode(space.decode(encoded))
    for parameter, value in zip(space, again, strict=True):
        assert -1e-9 <= value <= (parameter.classes - 1 if parameter.classes else 1 + 1e-9)


def stepped(count, steps):
    return ParameterSpace(tuple(Scalar(f"p{i}", 0.0, 1.0, 0.0, steps) for i in range(count)))


def test_sampling_draws_without_replacement_from_a_space_too_large_to_hold():
    space = stepped(12, 10)
    assert space.combinations == 10**12
    vectors = space.sample(3000, seed=4)
    assert len({tuple(v.values()) for v in vectors}) == 3000
    assert vectors == space.sample(3000, seed=4)
    assert vectors != space.sample(3000, seed=5)


def test_sampling_a_small_space_gives_all_of_it_once():
    space = stepped(3, 4)
    vectors = space.sample(1000, seed=0)
    assert len(vectors) == 64 == len({tuple(v.values()) for v in vectors})
    assert len(space.sample(60, seed=0)) == 60


def test_steps_are_evenly_spaced_or_the_values_given():
    assert Scalar("s", 0.5, 1.0, 0.7, 6).levels == pytest.approx((0.5, 0.6, 0.7, 0.8, 0.9, 1.0))
    assert Scalar("bed", 0.9, 1.8, 0.9, (0.9, 1.4, 1.8)).levels == (0.9, 1.4, 1.8)
    space = ParameterSpace((Scalar("bed", 0.9, 1.8, 0.9, (0.9, 1.4, 1.8)), Binary("b", False)))
    assert {v["bed"] for v in space.sample(10)} == {0.9, 1.4, 1.8}


def test_continuous_sampling_fills_the_range():
    space = ParameterSpace((Scalar("s", -2.0, 3.0, 0.0),))
    assert space.combinations == math.inf
    values = np.array([v["s"] for v in space.sample(2000, seed=1)])
    assert len(np.unique(values)) == 2000
    assert values.min() == pytest.approx(-2.0, abs=0.02) and values.max() == pytest.approx(3.0, abs=0.02)
    assert np.histogram(values, 10)[0].min() > 140


def test_inactive_parameters_rest_at_their_default_and_make_no_duplicates():
    space = ParameterSpace((Integer("shelves", 0, 2, 0), Scalar("gap", 0.0, 1.0, 0.5, 4, when=lambda p: p.shelves > 0)))
    vectors = space.sample(100)
    assert len(vectors) == 1 + 2 * 4
    assert all(v["gap"] == 0.5 for v in vectors if v["shelves"] == 0)
    assert space.active({"shelves": 0, "gap": 0.1}) == ("shelves",)
    assert space.active({"shelves": 1, "gap": 0.1}) == ("shelves", "gap")


def test_a_failing_condition_names_its_parameter():
    space = ParameterSpace((Binary("b", False, when=lambda p: p.missing),))
    with pytest.raises(ValueError, match="b: its when= failed: AttributeError"):
        space.sample(1)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Scalar("h", 1.0, 0.5, 0.7), "lower one first"),
        (lambda: Scalar("h", 0.0, math.inf, 0.7), "finite"),
        (lambda: Scalar("h", 0.0, 1.0, 2.0), "default 2.0 lies outside"),
        (lambda: Scalar("h", 0.0, 1.0, 0.5, 1), "at least 2"),
        (lambda: Scalar("h", 0.0, 1.0, 0.5, (0.1, 2.0)), "outside"),
        (lambda: Integer("n", 3, 3, 3), "lower one first"),
        (lambda: Choice("c", ("a", "a"), "a"), "each once"),
        (lambda: Choice("c", ("a", "b"), "z"), "default 'z'"),
    ],
)
def test_impossible_parameters_are_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_a_space_is_indexed_by_name():
    space = stepped(2, 3)
    assert len(space) == 2 and space.names == ("p0", "p1") and space["p1"] == list(space)[1]
    with pytest.raises(KeyError, match="no parameter 'x'; there are p0, p1"):
        space["x"]
    assert repr(space["p0"]) == "Scalar(name='p0', low=0.0, high=1.0, default=0.0, steps=3, log=False, whole=False)"


def test_values_are_carried_to_an_edited_space():
    space = ParameterSpace(
        (
            Scalar("height", 0.5, 1.0, 0.7),
            Integer("shelves", 0, 2, 1),
            Choice("legs", ("four", "pedestal"), "four"),
            Binary("round", False),
        )
    )
    old = {"height": 1.4, "shelves": 2, "legs": "trestle", "gone": 3.0}
    assert space.carry(old) == {"height": 1.0, "shelves": 2, "legs": "four", "round": False}
    assert space.carry(old, {"legs": "pedestal", "round": True})["round"] is True
    assert space.carry(old, {"legs": "pedestal"})["legs"] == "pedestal"
    assert space.carry({"height": "tall", "shelves": True}) == space.defaults


@given(spaces(), st.integers(0, 2**16))
def test_values_that_are_held_all_vectors_have(space, seed):
    held = {"b": True, "i": space["i"].high + 5}
    found = list(space.draw(6, seed, held))
    assert found and all(one["b"] is True and one["i"] == space["i"].high for one in found)
    assert found == list(space.draw(6, seed, held))
