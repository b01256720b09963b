import numpy as np
import pytest

from shapewright.comparison.surfaces import sample
from shapewright.comparison.views import intersection_over_union
from shapewright.modelling.solids import box
from shapewright.shapes import Mesh


def test_samples_lie_on_the_surface_in_proportion_to_area():
    points = sample(box((2, 1, 1)).mesh(), 20_000, seed=1).points
    on_face = np.isclose(np.abs(points), [1.0, 0.5, 0.5])
    assert on_face.any(axis=1).all()
    assert on_face[:, 0].mean() == pytest.approx(2 / 10, abs=0.02)
    assert np.array_equal(points, sample(box((2, 1, 1)).mesh(), 20_000, seed=1).points)


def test_a_surface_without_area_is_refused():
    line = Mesh(np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]), np.array([[0, 1, 2]]))
    with pytest.raises(ValueError, match="no area"):
        sample(line, 10)


def test_iou_of_silhouettes():
    square, tall = box((1, 1, 0.1)).mesh(), box((0.5, 1, 0.1)).mesh()
    same, half = intersection_over_union(square, square), intersection_over_union(square, tall)
    assert same == 1.0
    assert 0.4 < half < 0.8
    inside_out = Mesh(square.vertices * 9 + 4, square.faces[:, ::-1])
    assert intersection_over_union(square, inside_out) == pytest.approx(1.0, abs=0.01)
