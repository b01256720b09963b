import pytest

from shapewright.comparison.views import depth_difference
from shapewright.modelling.solids import box


def test_equal_shapes_do_not_differ_whatever_their_size_and_place():
    shape = box((1, 0.5, 0.3)).mesh()
    moved = box((2, 1.0, 0.6), at=(5, 0, 0)).mesh()
    assert depth_difference(shape, moved) == pytest.approx(0.0, abs=1e-3)


def test_it_grows_with_the_difference():
    thin, thick, cube = (box((1, depth, 1)).mesh() for depth in (0.2, 0.3, 1.0))
    near, far = depth_difference(thin, thick), depth_difference(thin, cube)
    assert 0.0 < near < far <= 1.0
