"""Parts that the reference has elsewhere."""

import numpy as np
import pytest

from shapewright.feedback.causes.structure import moved_pairs
from shapewright.feedback.remarks.moved import moved
from shapewright.feedback.remarks.part_boxes import parts_of
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.modelling.solids import box, cylinder


def lamp(forward, radius=0.03):
    base = box((0.6, 0.06, 1.2), at=(0, 0.03, 0)).label("base")
    pole = cylinder((2 * radius, 1.0, 2 * radius), at=(0, 0.5, -0.2)).label("pole")
    return (base | pole | box((0.3, 0.2, 0.3), at=(0, 0.7, forward)).label("shade")).mesh()


def found(reference, replica):
    where = residuals(reference, replica)
    return moved(moved_pairs(where), where.regions, parts_of(where), where.reference_bounds)


def test_a_shade_that_stands_further_forward():
    (told,) = found(lamp(0.4), lamp(0.05))
    assert told.label == "shade" and told.shift[2] == pytest.approx(0.35 / 1.2, abs=0.02)
    assert told.words.startswith("shade: 0.29 further forward in the reference, ")
    assert "shade" not in told.there.parts


def test_a_pole_that_is_only_thicker_has_not_moved():
    assert found(lamp(0.05, 0.09), lamp(0.05, 0.03)) == ()
    assert np.isfinite(lamp(0.05).bounds).all()
