"""How a replica differs from its reference, as numbers."""

import numpy as np
import pytest

from shapewright.judging.differences import Look, compare
from shapewright.modelling.solids import box, cone, sphere

CONE = cone((1, 1.4, 1), top=0.5).mesh()


def test_a_stretch_explains_a_stretched_replica_and_not_another_shape():
    taller = CONE.transformed(np.diag([1.0, 1.4, 1.0]))
    other = (box((1, 0.1, 0.4)) | sphere(0.3, at=(0.3, 0.2, 0))).mesh()
    stretch = [compare(Look.of(CONE), Look.of(replica))[0].stretch for replica in (taller, other)]
    assert stretch[0] == pytest.approx(0.0, abs=0.02) and stretch[1] == 1.0


def test_a_shape_differs_from_itself_in_nothing():
    differences, gaps = compare(Look.of(CONE), Look.of(CONE))
    assert differences.row()[:-1] == pytest.approx(0.0) and differences.stretch == 1.0
    assert not any(gap.any() for gap in gaps)
