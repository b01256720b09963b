import numpy as np
import pytest

from shapewright.modelling.solids import box, sphere
from shapewright.prediction.scanning import Scanner, side_cameras
from shapewright.rendering.cameras import THREE_VIEWS
from shapewright.rendering.point_pictures import radii, view
from shapewright.rendering.raster import render
from shapewright.shapes import Points

ALL_ROUND = side_cameras((0.0, 90.0, 180.0, 270.0, 0.0), (30.0, 30.0, 30.0, 30.0, -89.0))


@pytest.mark.parametrize("solid", [box((1.0, 0.4, 0.7)), sphere(0.5)], ids=["box", "ball"])
def test_points_without_normals_look_like_the_surface(solid):
    mesh = solid.mesh().normalised()
    points = Scanner(ALL_ROUND, noise=0.003).scan(mesh, np.random.default_rng(0))
    of_mesh, of_points = render([mesh, Points(points.positions)], THREE_VIEWS, 64) / 255.0
    inside = (of_mesh[:, 1] > 0.0) & (of_points[:, 1] > 0.0)
    assert inside.sum() > 0.97 * (of_mesh[:, 1] > 0.0).sum()
    depth, shade = np.abs(of_mesh - of_points)[:, 1][inside], np.abs(of_mesh - of_points)[:, 0][inside]
    assert np.median(depth) < 0.01
    assert np.median(shade) < 0.06


def test_normals_change_nothing():
    positions = np.random.default_rng(0).uniform(-0.5, 0.5, (500, 3))
    turned = Points(positions, np.tile([0.0, 1.0, 0.0], (500, 1)))
    assert (render([Points(positions)]) == render([turned])).all()


def test_discs_are_wider_where_points_are_fewer():
    rng = np.random.default_rng(0)
    flat = np.stack([rng.random(4000), np.zeros(4000), rng.random(4000)], axis=1)
    kept = flat[(flat[:, 0] < 0.5) | (rng.random(4000) < 0.2)]
    wide = radii(kept)
    assert np.median(wide[kept[:, 0] > 0.6]) > 1.5 * np.median(wide[kept[:, 0] < 0.4])
    assert np.allclose(radii(kept * 3.0), 3.0 * wide)


def test_the_nearer_of_two_points_is_seen():
    camera = THREE_VIEWS[1]
    inverse = view(Points([[0.0, 0.0, -0.4], [0.0, 0.0, 0.4]]), camera, 65)
    assert inverse.max() == pytest.approx(1.0 / (camera.distance - 0.4 * camera.frame()[2, 2]), rel=1e-6)
