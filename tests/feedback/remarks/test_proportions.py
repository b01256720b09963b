"""Proportions that a procedure cannot make."""

from typing import Annotated

import pytest

import shapewright as sw
from shapewright import Range
from shapewright.building import Workers
from shapewright.feedback.remarks.proportions import Limit, Proportion, Reach
from shapewright.modelling.solids import box


@sw.procedure
def couch(
    depth: Annotated[float, Range(0.5, 1.1)] = 0.8,
    height: Annotated[float, Range(0.4, 0.8)] = 0.6,
    thick: Annotated[float, Range(0.05, 0.1)] = 0.08,
):
    return box((1, thick, depth), at=(0, thick / 2, 0)) | box((1, height, 0.1), at=(0, height / 2, 0.05 - depth / 2))


@pytest.fixture(scope="module")
def reach():
    with Workers(couch, 1) as crew:
        return Reach.of(crew, 0)


def test_a_lounger_is_deeper_than_any_couch(reach):
    found = reach.beyond(box((1, 0.5, 2.8)).mesh(), couch())
    assert found.limit == Limit("depth", 1.1, "high") and found.reference == pytest.approx(2.8)
    assert (found.long, found.short) == ("deep", "wide")
    assert found.wish() > 2.0


def test_one_number_that_explains_two_proportions_is_the_limit(reach):
    found = reach.beyond(box((1, 1.6, 0.8)).mesh(), couch())
    assert found.limit == Limit("height", 0.8, "high")


def test_what_parameters_give_is_not_told(reach):
    for depth, height in ((0.5, 0.8), (1.1, 0.4), (1.08, 0.79)):
        assert reach.beyond(couch(depth, height, 0.08), couch()) is None


def test_the_words_are_an_authors():
    told = Proportion("deep", "wide", 2.8, 0.9, 1.1, Limit("depth", 1.1, "high"))
    assert told.words == "2.8 times as deep as wide, the replica 0.9 times; your depth ends at 1.1"
    assert told.wish() == pytest.approx(2.8)
    free = Proportion("deep", "wide", 1.0, 0.5, 0.6, None)
    assert free.wish() is None
    assert free.words == "as deep as wide, the replica 0.5 times, the procedure 0.6 times at most"
