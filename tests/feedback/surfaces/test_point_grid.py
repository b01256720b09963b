"""Points sorted into cells: distances as a tree finds them, up to a cap."""

import numpy as np
import pytest

from shapewright.feedback.surfaces.point_grid import Cells
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.modelling.solids import box, sphere

MOST = 0.08


@pytest.mark.parametrize("scale", [1.0, 0.02, 30.0])
def test_distances_are_those_of_the_whole_surface_up_to_the_cap(scale):
    surface = VisibleSurface.roughly((box((1, 0.2, 0.5)) | sphere(0.6, at=(0.2, 0.3, 0))).scale(scale).mesh(), 1000)
    asked = np.random.default_rng(0).uniform(-0.5, 0.5, (2000, 3)) * scale
    most = MOST * scale
    found, exact = surface.nearness(asked, most), surface.distance(asked)
    np.testing.assert_allclose(found, np.minimum(exact, most), atol=1e-12)
    assert 0.05 < (found < most).mean() < 0.9


def test_a_plane_stands_for_its_surroundings_and_no_further():
    cells = Cells.of(np.zeros((1, 3)), np.array([[0.0, 1.0, 0.0]]))
    asked = np.array([[0.0, 0.02, 0.0], [0.03, 0.02, 0.0], [0.05, 0.0, 0.0], [0.2, 0.0, 0.0]])
    np.testing.assert_allclose(cells.distance(asked, 0.03, MOST), [0.02, 0.02, 0.02, MOST], atol=1e-12)
