import numpy as np

from shapewright.comparison.surfaces import sample_surface
from shapewright.feedback.surfaces.interior import filled, inside
from shapewright.modelling.solids import box, cylinder
from shapewright.shapes import Mesh, concatenate


def table():
    top = box((1, 0.05, 0.6), at=(0, 0.3, 0))
    legs = box((0.06, 0.6, 0.06), at=(0.45, 0, 0.25)).mirror("x", keep=True).mirror("z", keep=True)
    return concatenate([top.mesh(), legs.mesh()]).normalised()


def test_points_inside_parts_are_told_from_those_between_them():
    points = np.array([(0, 0.3, 0), (0.45, 0, 0.25), (0, 0, 0), (0.45, 0, 0), (0, 0.5, 0)])
    assert inside(table(), points - np.array([0, 0.0125, 0])).tolist() == [True, True, False, False, False]


def test_soups_with_flipped_faces_have_an_inside_too():
    mesh = cylinder((0.3, 1, 0.3)).mesh()
    flipped = Mesh(mesh.vertices, np.where(np.arange(len(mesh.faces))[:, None] % 2, mesh.faces, mesh.faces[:, ::-1]))
    assert inside(flipped.normalised(), np.zeros((1, 3))).all()


def test_a_post_is_filled_and_a_table_is_not():
    post = cylinder((0.2, 1, 0.2)).mesh()
    points = filled(post, sample_surface(post, 500))
    assert len(points) > 700 and np.hypot(points[500:, 0], points[500:, 2]).min() < 0.02
    points = filled(table(), sample_surface(table(), 500))
    assert 500 < len(points) < 800
    assert not (np.abs(points[500:]) < [0.3, 0.25, 0.15]).all(axis=1).any()
