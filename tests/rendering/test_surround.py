"""Pictures from fourteen sides."""

import numpy as np
import pytest

from shapewright.rendering.surround import AXES, EMPTY, ORDERS, PIXELS, POSES, SIZE, Surround, pose_matrix
from shapewright.shapes import Mesh


@pytest.fixture(scope="module")
def soup() -> Mesh:
    rng = np.random.default_rng(0)
    return Mesh(rng.random((9, 3)), rng.integers(0, 9, (8, 3))).normalised()


def test_each_pose_has_the_same_pictures_in_another_order(soup):
    pictures = Surround.of(soup).nearness
    index = np.arange(SIZE)
    for pose, sources, turns in zip(POSES, *ORDERS, strict=True):
        posed = Surround.of(Mesh(soup.vertices @ pose_matrix(*pose).T, soup.faces)).nearness
        right, up = np.meshgrid(2 * index - SIZE + 1, SIZE - 1 - 2 * index)
        for view, (source, (a, b, c, d)) in enumerate(zip(sources, turns, strict=True)):
            x, y = a * right + c * up, b * right + d * up
            assert pictures[source, (SIZE - 1 - y) // 2, (x + SIZE - 1) // 2] == pytest.approx(posed[view], abs=1e-4)


def test_nearness_is_where_the_surface_lies(soup):
    seen = Surround.of(soup)
    view, row, column = np.nonzero(seen.nearness > EMPTY)
    right, up = (column + 0.5 - SIZE / 2) * PIXELS[view], (SIZE / 2 - row - 0.5) * PIXELS[view]
    flat = np.stack([right, up, seen.nearness[view, row, column]], axis=1)
    places = np.einsum("na,nax->nx", flat, AXES[view])
    assert (places >= soup.bounds[0] - 1e-5).all() and (places <= soup.bounds[1] + 1e-5).all()


def test_a_cube_shows_six_unit_faces():
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = np.array([triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))])
    seen = Surround.of(Mesh(corners, faces))
    assert seen.area[:6].sum(axis=(1, 2)) == pytest.approx(1.0, abs=0.05)
    assert seen.area[6:].sum(axis=(1, 2)) == pytest.approx(3.0, abs=0.15)


def test_views_that_are_drawn_alone_are_those_of_all(soup):
    whole, some = Surround.of(soup), Surround.of(soup, slice(4, 7))
    assert (some.nearness == whole.nearness[4:7]).all() and (some.area == whole.area[4:7]).all()
    assert (some.nearness > EMPTY).any()
