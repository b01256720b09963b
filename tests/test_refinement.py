from typing import Annotated, Literal

import numpy as np
import pytest

import shapewright as sw
from shapewright import Infeasible, Range
from shapewright.building import Workers
from shapewright.comparison.aligned import AlignedCost
from shapewright.modelling.solids import box, cylinder
from shapewright.prediction.refinement import QUICK, THOROUGH, likeliest, refine


@sw.procedure
def post(
    height: Annotated[float, Range(0.2, 2.0)] = 1.0,
    width: Annotated[float, Range(0.1, 1.0)] = 0.5,
    form: Literal["square", "round", "bare"] = "square",
    cap: Annotated[float, Range(0.0, 1.0, when=lambda p: p.form != "bare")] = 0.5,
):
    if form == "bare" and width > 0.8:
        raise Infeasible("too wide to be bare")
    shaft = box((width / 2, height, width / 2))
    if form == "bare":
        return shaft
    return shaft | (cylinder if form == "round" else box)((1, 0.1, 0.3 + cap), at=(0, height / 2, 0))


def inferred(*rows):
    """As a network would give: (height, width, probabilities of the forms, cap), encoded."""
    heights, widths, forms, caps = zip(*rows, strict=True)
    return [np.array(heights), np.array(widths), np.array(forms), np.array(caps)]


def measure_against(targets):
    costs = [AlignedCost(sw.light_field.descriptor(target)) for target in targets]
    return lambda pairs: [costs[i](mesh) for i, mesh in pairs]


SURE, MISTAKEN = [0.98, 0.01, 0.01], [0.6, 0.39, 0.01]


def test_refinement_finds_the_parameters_and_mends_a_wrong_choice():
    truth = [
        {"height": 1.4, "width": 0.3, "form": "square", "cap": 0.2},
        {"height": 0.5, "width": 0.6, "form": "round", "cap": 0.7},
    ]
    targets = [post(**values) for values in truth]
    start = inferred((0.6, 0.3, SURE, 0.3), (0.25, 0.45, MISTAKEN, 0.6))
    measure = measure_against(targets)
    with Workers(post, 1) as crew:
        quick = refine(post.space, start, crew, measure, QUICK, seed=3)
        again = refine(post.space, start, crew, measure, QUICK, seed=3)
        alone = refine(post.space, [column[:1] for column in start], crew, measure, QUICK, seed=3)
    assert quick == again and quick[0] == alone[0]
    assert [found["form"] for found in quick] == ["square", "round"]
    predicted = [post.space.decode(row) for row in ([0.6, 0.3, 0, 0.3], [0.25, 0.45, 0, 0.6])]
    for target, found, before in zip(targets, quick, predicted, strict=True):
        cost = AlignedCost(sw.light_field.descriptor(target))
        assert cost(post(**found)) < 0.5 * cost(post(**before))


def test_refinement_never_makes_it_worse():
    targets = [box((1, 0.2 * i, 0.5)).mesh() for i in range(1, 6)]
    rng = np.random.default_rng(0)
    start = inferred(*[(rng.random(), rng.random(), rng.dirichlet(np.ones(3)), rng.random()) for _ in targets])
    measure = measure_against(targets)
    with Workers(post, 1) as crew:
        found = refine(post.space, start, crew, measure, QUICK.within(24), seed=1)
        builds = crew.build(
            [
                post.space.canonical(post.space.decode(likeliest(post.space, [c[i] for c in start], 1)[0]))
                for i in range(5)
            ]
        )
    for i, (build, values) in enumerate(zip(builds, found, strict=True)):
        if build.shape is not None:
            assert measure([(i, post(**values))])[0] <= measure([(i, build.shape)])[0]


def test_where_nothing_can_be_built_the_prediction_stays():
    start = inferred((0.5, 0.95, [0.0, 0.0, 1.0], 0.5))
    with Workers(post, 1) as crew:
        (found,) = refine(post.space, start, crew, lambda pairs: [np.inf] * len(pairs), QUICK.within(1))
    assert found["form"] == "bare" and found["width"] == pytest.approx(0.955) and found["cap"] == 0.5


def test_the_likeliest_vectors_come_in_order_and_mean_different_shapes():
    vectors = likeliest(post.space, [np.float32(0.5), np.float32(0.2), np.array([0.2, 0.5, 0.3]), np.float32(0.9)], 5)
    assert [vector[2] for vector in vectors] == [1, 2, 0]
    space = sw.ParameterSpace(
        (sw.Binary("a", False), sw.Choice("b", ("x", "y", "z"), "x", when=lambda p: p.a), sw.Binary("c", True))
    )
    vectors = likeliest(space, [np.array([0.9, 0.1]), np.array([0.1, 0.2, 0.7]), np.array([0.4, 0.6])], 10)
    assert len(vectors) == 2 + 2 * 3
    assert vectors[0].tolist()[0] == 0 and vectors[0].tolist()[2] == 1


def test_budgets_are_cut_to_what_there_is_time_for():
    assert QUICK.evaluations == 64 and THOROUGH.evaluations > 600
    assert QUICK.within(25).evaluations == 20 and QUICK.within(0).rungs == QUICK.rungs[:1]
