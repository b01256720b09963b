import numpy as np
import pytest

from scanned import sampled, seen
from shapewright.modelling.solids import box, cylinder, sphere
from shapewright.references.scans.normals import with_normals
from shapewright.shapes import Points

TABLE = box((1.0, 0.08, 0.6)) | cylinder((0.2, 0.7, 0.2), at=(0.0, -0.35, 0.0)) | box((0.5, 0.08, 0.5), at=(0, -0.7, 0))


@pytest.mark.parametrize("solid", [sphere(0.5), box((1.0, 0.5, 0.7)), TABLE], ids=["ball", "box", "table"])
def test_normals_are_those_of_the_surface_and_point_out_of_it(solid):
    points = sampled(solid.mesh(), 8000)
    cosine = np.einsum("nd,nd->n", with_normals(Points(points.positions)).normals, points.normals)
    assert np.median(np.abs(cosine)) > 0.98
    assert (cosine > 0.0).mean() > 0.97


def test_where_the_sensor_is_known_normals_look_to_it():
    scan = seen(TABLE.mesh(), 8000)
    found = with_normals(scan)
    towards = np.einsum("nd,nd->n", scan.seen_from - scan.positions, found.normals)
    assert (towards > 0.0).all()
    assert (found.seen_from == scan.seen_from).all()


def test_known_normals_stay():
    points = sampled(sphere(0.5).mesh(), 2000)
    assert with_normals(points) is points
    some = points.normals.copy()
    some[::2] = 0.0
    found = with_normals(Points(points.positions, some))
    assert np.allclose(found.normals[1::2], points.normals[1::2])
    assert (np.einsum("nd,nd->n", found.normals, points.normals)[::2] > 0.9).all()


def test_every_point_gets_a_normal_of_length_one_wherever_it_lies():
    rng = np.random.default_rng(0)
    found = with_normals(Points(np.vstack([rng.normal(size=(300, 3)), np.zeros((40, 3))])))
    assert np.allclose(np.linalg.norm(found.normals, axis=1), 1.0)


@pytest.mark.parametrize("far", [1e3, 1e9, 1e200])
def test_a_point_far_away_takes_neither_all_memory_nor_the_normals_of_the_others(far):
    points = sampled(box((1.0, 0.5, 0.7)).mesh(), 2000)
    with_far = np.vstack([points.positions, [far, far, far]])
    cosine = np.einsum("nd,nd->n", with_normals(Points(with_far)).normals[:-1], points.normals)
    assert (cosine > 0.0).mean() > 0.97
