"""Explaining an iteration of drawings."""

from typing import Annotated

import pytest

import shapewright as sw
from shapewright import Range
from shapewright.feedback.explanation import explain
from shapewright.feedback.record import record_of
from shapewright.modelling.drawing import box
from shapewright.report.explained import outlines

SETTINGS = sw.Settings(seed=0, samples=300, epochs=3, image_size=32, refine="off", workers=1, judge="paper", vif=0.9)


@sw.procedure
def table(
    height: Annotated[float, Range(0.4, 0.8)] = 0.6,
    leg: Annotated[float, Range(0.06, 0.2)] = 0.1,
    rail: bool = False,
):
    side = box((leg, height), at=((1 - leg) / 2, height / 2)).mirror("x", keep=True)
    shape = box((1, 0.08), at=(0, height - 0.04)) | side
    return shape | box((1, 0.2), at=(0, height - 0.1)) if rail else shape


def tall():
    return box((1, 0.08), at=(0, 0.94)) | box((0.1, 0.98), at=(0.45, 0.49)).mirror("x", keep=True)


def post():
    return (
        box((1, 0.08), at=(0, 0.56))
        | box((0.1, 0.6), at=(0.45, 0.3)).mirror("x", keep=True)
        | box((0.06, 0.6), at=(0, 0.3))
    )


@pytest.fixture(scope="module")
def explanation():
    shapes = {f"like {i}": table(0.45 + 0.05 * i, 0.08, i % 2 > 0) for i in range(4)}
    shapes |= {"tall": tall(), "post": post()}
    references = sw.Collection.of(shapes)
    iteration = sw.fit(table, references, SETTINGS)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("shapewright.feedback.causes.better_replicas.EVALUATIONS", 150)
        return explain(iteration, table, references)


def test_a_range_that_ends_too_soon_is_told(explanation):
    cause = explanation.references["tall"].causes[0]
    assert cause.kind == "out of range" and cause.evidence["wishes"][0]["parameter"] == "height"
    assert any(shared.outside and "tall" in shared.references for shared in explanation.summary)


def test_what_is_missing_is_told_and_shown_in_place(explanation):
    case = explanation.references["post"]
    assert case.causes[0].kind == "missing part" and "of the reference's area" in case.causes[0].text
    told = record_of(explanation)["references"]["post"]
    assert told["dimensions"] == 2 and told["regions"]
    (path, *_), _ = outlines(told)
    left, right = float(path[1:].split()[0]), float(path.split("H")[1].split("V")[0])
    assert 45 < left < 50 < right < 55


def test_what_a_longer_search_finds_is_a_prediction_that_went_wrong(explanation):
    solved = [case for name, case in explanation.references.items() if name.startswith("like") and case.causes]
    assert solved
    for case in solved:
        assert case.causes[0].kind in ("badly predicted", "wrong choice")
        assert case.nearest.distance < 0.1 < case.replica.distance


def test_no_rules_are_suggested(explanation):
    assert explanation.suggestions == ()
