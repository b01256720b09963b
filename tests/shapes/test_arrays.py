import numpy as np
import pytest

from shapewright.shapes.arrays import ends


@pytest.mark.parametrize("count", [1, 63, 64, 65, 1000])
@pytest.mark.parametrize("width", [2, 3])
def test_the_ends_of_points_are_the_least_and_the_greatest_of_each_column(count, width):
    points = np.random.default_rng(count).normal(size=(count, width))
    np.testing.assert_array_equal(ends(points), [points.min(axis=0), points.max(axis=0)])
