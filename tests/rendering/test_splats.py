import numpy as np
import pytest

from shapewright.modelling.solids import box, sphere
from shapewright.rendering.cameras import THREE_VIEWS, Camera
from shapewright.rendering.raster import render
from shapewright.rendering.splats import discs, radii, view
from shapewright.rendering.thumbnails import thumbnail
from shapewright.shapes import Mesh, Points

FRONT = Camera(0.0, 0.0)


def scanned(mesh: Mesh, count: int = 6000, normals: bool = True) -> Points:
    """Points all over a mesh, as many on any area as on another of the same size."""
    rng = np.random.default_rng(0)
    a, b, c = np.moveaxis(mesh.triangles, 1, 0)
    across = np.cross(b - a, c - a)
    areas = np.linalg.norm(across, axis=1)
    face = rng.choice(len(areas), count, p=areas / areas.sum())
    u, v = np.sort(rng.random((2, count)), axis=0)[:, :, None]
    places = a[face] * u + b[face] * (v - u) + c[face] * (1.0 - v)
    return Points(places, (across / areas[:, None])[face] if normals else None)


@pytest.mark.parametrize("solid", [box((1.0, 0.4, 0.7)), sphere(0.5)], ids=["box", "ball"])
def test_points_of_a_surface_look_like_the_surface(solid):
    mesh = solid.mesh().normalised()
    of_mesh, of_points = (picture / 255.0 for picture in render([mesh, scanned(mesh)], THREE_VIEWS, 64, supersample=1))
    covered, covered_by_points = of_mesh[:, 1] > 0.0, of_points[:, 1] > 0.0
    assert (covered & covered_by_points).sum() > 0.99 * covered.sum()
    assert covered_by_points.sum() < 1.12 * covered.sum()
    depth, shade = np.abs(of_mesh - of_points)[:, 1][covered], np.abs(of_mesh - of_points)[:, 0][covered]
    assert np.median(depth) < 0.004
    assert shade.mean() < 0.05


def test_a_point_without_a_normal_is_a_disc_turned_to_the_camera():
    shade, inverse = view(Points([[0.0, 0.0, 0.3]]), FRONT, 201, np.array([0.2]))
    assert set(np.unique(shade)) == {0.0, np.float32(0.625)}
    assert inverse.max() == pytest.approx(1.0 / 2.3)
    side = 201 / 2.0 * FRONT.focal_length / 2.3
    assert (shade > 0.0).sum() == pytest.approx(np.pi * (0.2 * side) ** 2, rel=0.02)


def test_a_disc_lies_in_its_surface():
    seen = [
        (view(Points([[0.0, 0.0, 0.0]], [[0.0, y, z]]), FRONT, 201, np.array([0.2]))[0] > 0.0).sum()
        for y, z in ((0.0, 1.0), (0.0, -1.0), (np.sqrt(0.75), 0.5))
    ]
    assert seen[0] == seen[1]
    assert seen[2] == pytest.approx(0.5 * seen[0], rel=0.05)


def test_the_nearer_of_two_points_hides_the_other_in_any_order():
    places = np.array([[0.0, 0.0, -0.4], [0.0, 0.0, 0.4]])
    pictures = [view(Points(rows), FRONT, 64, np.array([0.1, 0.1]))[1] for rows in (places, places[::-1])]
    assert (pictures[0] == pictures[1]).all()
    assert pictures[0][32, 32] == pytest.approx(1.0 / 2.2)


def test_every_point_in_the_picture_leaves_a_trace():
    rng = np.random.default_rng(1)
    positions = rng.uniform(-0.5, 0.5, (50, 3))
    seen = sum((view(Points([place]), FRONT, 64, np.array([1e-6]))[1] > 0.0).sum() for place in positions)
    assert seen == 50


def test_radii_follow_the_density_and_no_lonely_point_is_a_large_disc():
    fine, coarse = (
        np.stack([*np.meshgrid(*[np.arange(0, 1, step)] * 2), np.zeros((n, n))], -1).reshape(-1, 3)
        for step, n in ((0.02, 50), (0.1, 10))
    )
    assert np.median(radii(Points(fine))) < 0.3 * np.median(radii(Points(coarse)))
    assert radii(Points(np.vstack([coarse, [[50.0, 0.0, 0.0]]]))).max() < 1.0
    assert (radii(Points([[0.0, 0.0, 0.0]])) == 0.0).all()


def test_discs_as_triangles_cover_what_the_discs_do():
    points = scanned(sphere(0.5).mesh(), 3000)
    mesh = discs(points)
    assert len(mesh.faces) == 2 * len(points)
    facing = np.cross(*(np.diff(mesh.triangles, axis=1)[:, i] for i in (0, 1)))
    assert (np.einsum("fd,fd->f", facing, np.repeat(points.normals, 2, axis=0)) > 0.0).all()
    assert (render([mesh], [FRONT], 64)[0, 0, 1] > 0).sum() > 0.95 * (view(points, FRONT, 64)[1] > 0.0).sum()


def test_a_thumbnail_of_points_is_a_picture_of_them_whatever_their_size():
    small, large = scanned(box(1).mesh(), 500), scanned(box(1).mesh(), 500).transformed(np.eye(3) * 1000.0)
    assert thumbnail(small, 64)[:4] == b"\x89PNG"
    assert thumbnail(small, 64) == thumbnail(large, 64)
