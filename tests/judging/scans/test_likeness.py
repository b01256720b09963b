from dataclasses import fields, replace

import pytest

from shapewright.judging.scans.likeness import features, likeness
from shapewright.judging.scans.shortfall import Shortfall

SAME = Shortfall(0.002, 0.001, 0.0, 0.0, 0.0, 0.0, 0.002, 0.01, 0.0, 0.04, 0.04, 0.3)


def test_what_is_there_and_no_more_is_likely_the_same():
    assert likeness(SAME) > 0.85


@pytest.mark.parametrize(
    "change",
    [
        {
            "gap": 0.03,
            "usual_gap": 0.02,
            "near_missing": 0.4,
            "far_missing": 0.2,
            "missing": 0.4,
            "missing_beside": 0.3,
        },
        {"excess": 0.015, "near_surplus": 0.25, "far_surplus": 0.1, "surplus": 0.35, "surplus_beside": 0.3},
    ],
    ids=["missing", "surplus"],
)
def test_what_is_missing_and_what_is_surplus_lower_it(change):
    assert likeness(replace(SAME, **change)) < 0.65


def test_every_number_is_a_feature():
    assert features(SAME).shape == (len(fields(Shortfall)),)
