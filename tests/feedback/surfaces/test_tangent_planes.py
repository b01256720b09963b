import numpy as np
import pytest

from shapewright.comparison.surfaces import sample
from shapewright.feedback.surfaces.tangent_planes import tangent_distances
from shapewright.modelling.solids import box


def test_points_above_a_face_are_as_far_as_its_plane():
    drawn = sample(box((2, 2, 2)).mesh(), 400)
    spacing = np.sqrt(drawn.area / 400)
    asked = np.array([[0.1, 1.3, 0.2], [0.0, 1.0, 0.0], [4.0, 0.0, 0.0]])
    assert tangent_distances(asked, drawn.points, drawn.normals, spacing) == pytest.approx([0.3, 0.0, 3.0], abs=1e-9)


def test_a_plane_ends_a_spacing_from_its_point():
    point, normal = np.zeros((1, 3)), np.array([[0.0, 1.0, 0.0]])
    asked = np.array([[0.5, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 1.5, 0.0]])
    assert tangent_distances(asked, point, normal, 1.0) == pytest.approx([0.0, 2.0, 2.5])
