"""Rows of which the reference has another number."""

import pytest

from shapewright.feedback.remarks.counting import Count, counts
from shapewright.feedback.remarks.part_boxes import parts_of
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.modelling.solids import box


def back(count, label="slats"):
    frame = box((1, 0.08, 0.06), at=(0, 0.04, 0)) | box((1, 0.08, 0.06), at=(0, 0.96, 0))
    width = 0.05
    rows = [box((width, 0.84, 0.03), at=(-0.42 + 0.84 * i / (count - 1), 0.5, 0)) for i in range(count)]
    slats = rows[0]
    for one in rows[1:]:
        slats = slats | one
    return (frame.label("frame") | slats.label(label)).mesh()


def counted(reference, replica):
    where = residuals(reference, replica)
    return counts(where, parts_of(where))


@pytest.mark.parametrize(("there", "here"), [(5, 3), (3, 6), (7, 4)])
def test_the_reference_has_more_or_fewer(there, here):
    assert counted(back(there), back(here)) == (Count("slats", there, here),)
    assert Count("slats", 5, 3).words == "the reference has 5 slats, the replica 3"


def test_equal_rows_are_not_told():
    assert counted(back(4), back(4)) == ()


def test_four_legs_are_no_row():
    legs = box((0.1, 0.6, 0.1), at=(0.4, 0.3, 0.2)).mirror("x", keep=True).mirror("z", keep=True).label("legs")
    top = box((1, 0.1, 0.6), at=(0, 0.65, 0)).label("top")
    assert counted(top.mesh(), (legs | top).mesh()) == ()
