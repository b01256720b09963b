import numpy as np

from shapewright.fitting.adaptive import around
from shapewright.parameters import Binary, Choice, Integer, ParameterSpace, Scalar

SPACE = ParameterSpace((Scalar("s", 0.0, 2.0, 1.0), Scalar("t", 0.0, 1.0, 0.5), Choice("c", ("a", "b", "d"), "a")))
CENTRES = [{"s": 0.5, "t": 0.2, "c": "a"}, {"s": 1.5, "t": 0.9, "c": "d"}]


def test_samples_lie_around_the_centres_and_spread_where_errors_are_large():
    metrics = {"s": {"mae": 0.001}, "t": {"mae": 0.1}, "c": {"accuracy": 0.5}}
    vectors = around(SPACE, CENTRES, metrics, 2000, seed=1)
    assert len(vectors) == 2000 == len({tuple(v.values()) for v in vectors})
    first = [v for v in vectors if v["s"] < 1.0]
    assert np.std([v["s"] / 2.0 for v in first]) < 0.04 < 0.15 < np.std([v["t"] for v in first])
    assert 0.6 < np.mean([v["c"] == "a" for v in first]) < 0.75
    assert all(0.0 <= v["t"] <= 1.0 for v in vectors)
    assert vectors == around(SPACE, CENTRES, metrics, 2000, seed=1) != around(SPACE, CENTRES, metrics, 2000, seed=2)


def test_without_centres_or_room_there_are_fewer():
    assert around(SPACE, [], {}, 10, seed=0) == []
    tiny = ParameterSpace((Binary("a", False), Integer("n", 0, 2, 0)))
    assert len(around(tiny, [{"a": True, "n": 1}], {}, 100, seed=0)) <= 6
