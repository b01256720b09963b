import numpy as np
import pytest

from shapewright.parameters import Binary, Choice, ParameterSpace, Prediction, Scalar

SPACE = ParameterSpace(
    (
        Scalar("height", 0.0, 2.0, 1.0),
        Choice("form", ("square", "round", "bare"), "square"),
        Scalar("cap", 0.0, 1.0, 0.5, when=lambda p: p.form != "bare"),
        Binary("back", False),
    )
)
ROUND = {"height": 0.5, "form": "round", "cap": 0.25, "back": True}
BARE = {"height": 2.0, "form": "bare", "cap": 0.5, "back": False}


def of_one(space, *columns):
    return Prediction(space, tuple(np.array([column]) for column in columns))


def test_known_parameters_are_a_prediction_that_decodes_to_them():
    prediction = Prediction.of(SPACE, [ROUND, BARE])
    assert len(prediction) == 2 and prediction.decode() == [ROUND, BARE]
    assert prediction.take([1]).decode() == [BARE] and len(Prediction.of(SPACE, [])) == 0
    assert [column.tolist() for column in prediction.columns[:2]] == [[0.25, 1.0], [[0, 1, 0], [0, 0, 1]]]


def test_doubt_is_spread_over_the_classes_but_for_what_is_sure():
    form, back = (Prediction.of(SPACE, [ROUND], 0.3).columns[i][0] for i in (1, 3))
    assert form == pytest.approx([0.1, 0.8, 0.1]) and back == pytest.approx([0.15, 0.85])
    form, back = (Prediction.of(SPACE, [ROUND], 0.3, least=0.12, most=0.7, sure=["back"]).columns[i][0] for i in (1, 3))
    assert form == pytest.approx([0.12, 0.7, 0.12]) and back.tolist() == [0.0, 1.0]


def test_spreads_are_taken_along():
    spread = np.array([0.1, 0.2], dtype=np.float32)
    prediction = Prediction(SPACE, Prediction.of(SPACE, [ROUND, BARE]).columns, (spread, None, spread, None))
    assert [s if s is None else s.tolist() for s in prediction.take([1]).spreads] == [spread[1:].tolist(), None] * 2


def test_surprise_counts_the_choices_that_matter():
    inner = ParameterSpace((Binary("a", False), Choice("b", ("x", "y"), "x", when=lambda p: p.a)))
    prediction = of_one(inner, [0.25, 0.75], [0.0, 1.0])
    assert prediction.surprise(0, np.array([0.0, 0.0])) == pytest.approx(np.log(4.0))
    assert prediction.surprise(0, np.array([1.0, 0.0])) == pytest.approx(-np.log(0.75) - np.log(1e-4))


def test_the_likeliest_vectors_come_in_order_and_mean_different_shapes():
    vectors = of_one(ParameterSpace(SPACE.parameters[:3]), 0.5, [0.2, 0.5, 0.3], 0.9).likeliest(0, 5)
    assert [vector[1] for vector in vectors] == [1, 2, 0]
    space = ParameterSpace(
        (Binary("a", False), Choice("b", ("x", "y", "z"), "x", when=lambda p: p.a), Binary("c", True))
    )
    vectors = of_one(space, [0.9, 0.1], [0.1, 0.2, 0.7], [0.4, 0.6]).likeliest(0, 10)
    assert len(vectors) == 2 + 2 * 3
    assert vectors[0].tolist()[0] == 0 and vectors[0].tolist()[2] == 1
    sure = of_one(space, [1.0, 0.0], [0.1, 0.2, 0.7], [0.4, 0.6]).likeliest(0, 10)
    assert [vector.tolist()[2] for vector in sure] == [1, 0] and not any(vector[0] for vector in sure)
