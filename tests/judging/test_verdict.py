import math

import pytest

import shapewright as sw
from shapewright.judging.verdict import grade_of


@pytest.mark.parametrize(
    ("value", "grade"),
    [(1.0, "replicated"), (0.5, "replicated"), (0.49, "close"), (0.2, "close"), (0.19, "different")],
)
def test_two_cuts_make_three_grades(value, grade):
    assert grade_of(value, sw.Settings()) == grade


def test_what_has_no_value_is_different():
    assert grade_of(math.nan, sw.Settings()) == "different"
