import numpy as np
import pytest

from shapewright.modelling.solids import box, cylinder
from shapewright.rendering.cameras import THUMBNAIL, Camera
from shapewright.rendering.raster import view
from shapewright.rendering.visibility import AllRound
from shapewright.shapes import Mesh, concatenate


def all_round(mesh):
    return AllRound.of(mesh, 128, 0.88)


def table():
    top = box((1, 0.05, 0.6), at=(0, 0.3, 0))
    legs = box((0.06, 0.6, 0.06), at=(0.45, 0, 0.25)).mirror("x", keep=True).mirror("z", keep=True)
    return concatenate([top.mesh(), legs.mesh()]).normalised()


def test_points_inside_parts_are_told_from_those_between_them():
    points = np.array([(0, 0.3, 0), (0.45, 0, 0.25), (0, 0, 0), (0.45, 0, 0), (0, 0.5, 0)])
    assert all_round(table()).encloses(points - np.array([0, 0.0125, 0])).tolist() == [True, True, False, False, False]


def test_soups_with_flipped_faces_have_an_inside_too():
    mesh = cylinder((0.3, 1, 0.3)).mesh()
    flipped = Mesh(mesh.vertices, np.where(np.arange(len(mesh.faces))[:, None] % 2, mesh.faces, mesh.faces[:, ::-1]))
    assert all_round(flipped.normalised()).encloses(np.zeros((1, 3))).all()


def test_faces_inside_a_shape_are_not_shown():
    seen = all_round(concatenate([box(1).mesh(), box(0.5).mesh()]).normalised())
    outer, inner = np.array([(0.5, 0.1, 0.1), (0.1, -0.5, 0.1)]), np.array([(0.25, 0.1, 0.1), (0.1, -0.25, 0.1)])
    normals = np.array([(1.0, 0, 0), (0, -1.0, 0)])
    assert seen.shows(outer, normals).all() and not seen.shows(inner, normals).any()


@pytest.mark.parametrize("camera", [THUMBNAIL, Camera(200.0, -30.0)])
def test_a_point_is_projected_to_the_pixel_that_shows_it(camera):
    speck = np.array([0.2, 0.35, -0.1])
    mesh = Mesh(speck + 0.06 * box(1).mesh().vertices, box(1).mesh().faces)
    _, inverse = view(mesh, camera, 200)
    column, row, depth = camera.project(speck[None], 200)
    rows, columns = np.nonzero(inverse)
    assert column[0] == pytest.approx(columns.mean() + 0.5, abs=1)
    assert row[0] == pytest.approx(rows.mean() + 0.5, abs=1)
    assert depth[0] == pytest.approx(1.0 / inverse[rows, columns].mean(), abs=0.05)
