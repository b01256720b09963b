from typing import Any

import pytest

from shapewright.parameters import Binary, Choice, Integer, ParameterSpace, Scalar
from shapewright.studio.bench.planning.plan import planned
from shapewright.studio.wire.requests import Explore

SPACE = ParameterSpace(
    (
        Scalar("height", 0.5, 1.5, 0.6),
        Integer("legs", 1, 9, 4),
        Choice("top", ("round", "square"), "square"),
        Binary("shelf", False),
        Scalar("depth", 0.1, 0.2, 0.15, when=lambda p: p.shelf),
    )
)


def plan(**order: Any) -> Any:
    return planned(SPACE, Explore(id=1, **order))


def test_a_seed_gives_the_same_shapes_and_another_gives_others() -> None:
    assert plan(seed=3) == plan(seed=3) != plan(seed=4)
    assert len(plan(seed=3, count=7).shapes) == 7 and not plan().along


def test_what_is_locked_all_shapes_have_and_the_rest_varies() -> None:
    shapes = plan(locked={"shelf": True, "height": 9.0, "gone": 1}, count=40).shapes
    assert {(one["shelf"], one["height"]) for one in shapes} == {(True, 1.5)}
    # What a locked value makes matter is drawn, and does not rest at its default.
    assert len({one["depth"] for one in shapes}) == 40


def test_one_parameter_varies_from_end_to_end_and_the_others_are_as_they_were() -> None:
    found = plan(vary=["height"], base={"legs": 3, "shelf": True, "depth": 0.2})
    assert [name for name, _ in found.along] == ["height"]
    heights = [one["height"] for one in found.shapes]
    assert (heights[0], heights[-1]) == (0.5, 1.5) and heights == sorted(heights)
    assert {(one["legs"], one["shelf"], one["depth"], one["top"]) for one in found.shapes} == {(3, True, 0.2, "square")}


def test_two_parameters_make_a_grid_the_last_one_fastest() -> None:
    found = plan(vary=["legs", "top"], locked={"height": 1.0})
    (_, legs), (_, tops) = found.along
    assert (legs[0], legs[-1], len(legs)) == (1, 9, 7) and tops == ("round", "square")
    assert [(one["legs"], one["top"]) for one in found.shapes] == [(n, top) for n in legs for top in tops]
    assert {one["height"] for one in found.shapes} == {1.0}


def test_parameters_that_are_gone_do_not_vary() -> None:
    assert plan(vary=["gone"]) == plan()
    assert [name for name, _ in plan(vary=["gone", "shelf"]).along] == ["shelf"]


def test_a_condition_that_fails_is_told() -> None:
    broken = ParameterSpace((Scalar("a", 0.0, 1.0, 0.5, when=lambda p: p.nobody),))
    with pytest.raises(ValueError, match="when"):
        planned(broken, Explore(id=1))
