import numpy as np

from shapewright.comparison.surfaces import sample
from shapewright.feedback.surfaces.visible_surface import filled
from shapewright.modelling.solids import box, cylinder
from shapewright.shapes import concatenate


def table():
    top = box((1, 0.05, 0.6), at=(0, 0.3, 0))
    legs = box((0.06, 0.6, 0.06), at=(0.45, 0, 0.25)).mirror("x", keep=True).mirror("z", keep=True)
    return concatenate([top.mesh(), legs.mesh()]).normalised()


def test_a_post_is_filled_and_a_table_is_not():
    post = cylinder((0.2, 1, 0.2)).mesh()
    points = filled(post, sample(post, 500).points)
    assert len(points) > 700 and np.hypot(points[500:, 0], points[500:, 2]).min() < 0.02
    points = filled(table(), sample(table(), 500).points)
    assert 500 < len(points) < 800
    assert not (np.abs(points[500:]) < [0.3, 0.25, 0.15]).all(axis=1).any()
