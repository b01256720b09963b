"""Parts that stand another way in the reference."""

import pytest

from shapewright.feedback.remarks.part_boxes import parts_of
from shapewright.feedback.remarks.turned import turned
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.modelling.solids import box, cone, cylinder


def umbrella(canopy):
    return (cylinder((0.05, 1.0, 0.05), at=(0, 0.5, 0)).label("pole") | canopy.label("canopy")).mesh()


def bowl(over):
    made = cone((0.8, 0.3, 0.8), top=0.1, bottom=1.0)
    return (made.rotate(180, "x") if over else made).translate((0, 0.85, 0))


def side(x):
    return box((0.8, 0.06, 0.3), at=(0, 0.85, 0)) | box((0.1, 0.4, 0.3), at=(x, 0.65, 0))


@pytest.mark.parametrize(
    ("there", "here", "turn"),
    [(bowl(True), bowl(False), "upside down"), (side(0.35), side(-0.35), "mirrored")],
)
def test_a_part_that_fits_better_another_way(there, here, turn):
    where = residuals(umbrella(there), umbrella(here))
    (found,) = turned(where, where.regions, parts_of(where))
    assert (found.label, found.turn) == ("canopy", turn) and found.left < 0.5
    assert found.words == f"canopy: {turn} in the reference"


def test_another_form_is_not_told_as_a_turn():
    where = residuals(umbrella(bowl(False)), umbrella(box((0.8, 0.3, 0.8), at=(0, 0.85, 0))))
    assert turned(where, where.regions, parts_of(where)) == ()
