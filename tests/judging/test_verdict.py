import math

import pytest

import shapewright as sw
from shapewright.judging.verdict import apart_of, grade_of


@pytest.mark.parametrize(
    ("value", "grade"),
    [(1.0, "replicated"), (0.65, "replicated"), (0.64, "close"), (0.35, "close"), (0.34, "different")],
)
def test_two_cuts_make_three_grades(value, grade):
    assert grade_of(value, sw.Settings()) == grade


def test_what_has_no_value_is_different():
    assert grade_of(math.nan, sw.Settings()) == "different"


def test_what_lies_apart_is_one_at_the_cut_and_tells_poor_replicas_apart():
    values = (1.0, 0.99, 0.8, 0.65, 0.3, 1e-3, 1e-9, 1e-20)
    apart = [apart_of(value, sw.Settings()) for value in values]
    assert apart[:2] == [0.0, 0.0] and apart[3] == pytest.approx(1.0) and apart[1:] == sorted(set(apart[1:]))
    assert apart_of(0.8, sw.Settings(replicated=0.8)) == pytest.approx(1.0)
    assert math.isfinite(apart_of(0.0, sw.Settings())) and math.isnan(apart_of(math.nan, sw.Settings()))
