"""A procedure of few shapes: every one of them is measured against each reference."""

from typing import Annotated, Literal

import numpy as np

import shapewright as sw
from shapewright import Infeasible, Range
from shapewright.building import Workers
from shapewright.comparison.light_field.aligned import AlignedCost
from shapewright.modelling.solids import box
from shapewright.parameters import Prediction
from shapewright.search.budgets import CHOSEN, QUICK, whole
from shapewright.search.candidates import others
from shapewright.search.exhaustion import best_of_all, is_small
from shapewright.search.objective import Criterion
from shapewright.search.search import SearchStart, refine


@sw.procedure
def rack(boards: Annotated[int, Range(2, 9)] = 4, back: bool = False, size: Literal["low", "high"] = "low"):
    if boards == 9 and size == "low":
        raise Infeasible("no room")
    height = 2.0 if size == "high" else 1.0
    shelves = [box((1, 0.05, 0.5), at=(0, height * (k + 0.5) / boards, 0)) for k in range(boards)]
    sides = [box((0.05, height, 0.5), at=(x, height / 2, 0)) for x in (-0.5, 0.5)]
    return shelves + sides + ([box((1, height, 0.03), at=(0, height / 2, -0.25))] if back else [])


def unsure(count):
    """A network that knows nothing."""
    columns = [np.full((count, parameter.classes), 1.0 / parameter.classes) for parameter in rack.space]
    return Prediction(rack.space, tuple(columns))


def against(truth):
    costs = [AlignedCost(rack(**values)) for values in truth]
    asked = []

    def measure(pairs):
        asked.extend(row for row, _ in pairs)
        return [costs[row].residual(mesh) for row, mesh in pairs]

    return measure, asked


TRUTH = [{"boards": n, "back": n % 3 == 0, "size": "high"} for n in (3, 6, 9)]


def test_a_search_of_few_shapes_finds_every_truth_and_measures_each_shape_once_for_a_reference():
    measure, asked = against(TRUTH)
    with Workers(rack, 1) as crew:
        found = refine(SearchStart(unsure(3)), Criterion(measure), crew, QUICK)
    assert found == TRUTH
    assert [asked.count(row) for row in range(3)] == [30, 30, 30]  # 32 combinations, of which two cannot be built


def test_the_likelier_of_two_that_look_alike_wins():
    measure, _ = against(TRUTH[:1])
    prediction = unsure(1)
    prediction.columns[1][0] = (1.0 - 1e-6, 1e-6)  # without a back
    with Workers(rack, 1) as crew:
        sure = best_of_all(prediction, Criterion(measure, surprise_cost=1e6), crew)
        seen = best_of_all(prediction, Criterion(measure), crew)
    assert not sure[0]["back"] and seen[0] == TRUTH[0]


def test_what_cannot_be_measured_stays_as_it_is_predicted():
    steps = []
    with Workers(rack, 1) as crew:
        found = best_of_all(unsure(2), Criterion(lambda pairs: [None] * len(pairs)), crew, lambda *s: steps.append(s))
    assert found == unsure(2).decode() and steps == [(1, 2), (2, 2)]


def test_a_search_that_may_build_less_than_all_shapes_takes_the_likeliest():
    measure, asked = against(TRUTH[:1])
    with Workers(rack, 1) as crew:
        refine(SearchStart(unsure(1)), Criterion(measure), crew, QUICK.within(5, 0))
    assert len(asked) <= 5


@sw.procedure
def grid(
    across: Annotated[int, Range(1, 12)] = 4,
    up: Annotated[int, Range(1, 12)] = 4,
    deep: Annotated[int, Range(1, 12)] = 4,
    back: bool = False,
):
    wide, high, depth = 0.2 * across, 0.2 * up, 0.2 * deep
    return [box((wide, high, depth)), *([box((wide, 2 * high, 0.1), at=(0, high / 2, -depth / 2))] if back else [])]


def test_counts_alone_are_changed_one_after_the_other_while_that_brings_something():
    truth = {"across": 4, "up": 11, "deep": 7, "back": True}
    cost = AlignedCost(grid(**truth))

    def measure(pairs):
        return [cost.residual(mesh) for _, mesh in pairs]

    guess = Prediction.of(grid.space, [{"across": 4, "up": 4, "deep": 4, "back": False}], 0.1)
    assert not is_small(grid.space) and whole("meshes", thorough=False, numbers=False) == CHOSEN
    with Workers(grid, 1) as crew:
        (found,) = refine(SearchStart(guess), Criterion(measure), crew, CHOSEN)
        (quick,) = refine(SearchStart(guess), Criterion(measure), crew, QUICK)
    beside = [grid.space.decode(vector) for vector in others(grid.space, grid.space.encode(found))]
    assert min(cost(grid(**values)) for values in beside) >= cost(grid(**found)) < cost(grid(**quick))
    assert found["back"]


def test_a_number_makes_a_space_large():
    assert is_small(rack.space)
    assert not is_small(sw.ParameterSpace((*rack.space, sw.Scalar("width", 0.5, 2.0, 1.0))))
