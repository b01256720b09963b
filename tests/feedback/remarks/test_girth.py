"""Widths at a height."""

import numpy as np
import pytest

from shapewright.feedback.remarks.girth import girth
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.modelling.solids import cone, cylinder


def test_a_vase_that_narrows_where_the_replica_does_not():
    vase, plain = cone((0.5, 1.0, 0.5), top=0.2, bottom=1.0).mesh(), cylinder((0.5, 1.0, 0.5)).mesh()
    where = residuals(vase, plain)
    told = girth(where, np.array([[-0.25, 0.1, -0.25], [0.25, 0.5, 0.25]]), where.reference_bounds)
    assert told.replica == pytest.approx(0.5, abs=0.03) and told.reference < 0.35 and 0.7 < told.height < 0.9
    assert "at 80 % of the height" in told.words


def test_equal_widths_are_not_told():
    plain = cylinder((0.5, 1.0, 0.5)).mesh()
    where = residuals(plain, plain)
    assert girth(where, where.reference_bounds, where.reference_bounds) is None
