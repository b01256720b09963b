"""Unions of boxes without booleans, against manifold3d's and against counting."""

import numpy as np
import pytest

from shapewright import Mesh
from shapewright.modelling.grammar.grid_union import unite
from shapewright.modelling.solids import box, union


def made(low, high, owners=None):
    low, high = np.array(low, dtype=float), np.array(high, dtype=float)
    return unite(low, high, np.zeros(len(low), dtype=int) if owners is None else np.array(owners))


def volume(mesh):
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    return float(np.einsum("fd,fd->", a, np.cross(b, c)) / 6)


def test_random_unions_are_sound_and_have_the_volume_that_booleans_give():
    random, checked = np.random.default_rng(0), 0
    for _ in range(60):
        low = random.integers(0, 6, (random.integers(2, 10), 3)).astype(float)
        high = low + random.integers(1, 4, low.shape)
        united = made(low, high)
        if united is None:
            continue
        mesh = Mesh(united[0], united[1])
        assert mesh.soundness().sound
        boxes = [box(b - a, at=(a + b) / 2) for a, b in zip(low, high, strict=True)]
        assert volume(mesh) == pytest.approx(union(*boxes).volume)
        checked += 1
    assert checked > 20


def test_one_box_is_twelve_triangles_and_flush_boxes_are_one():
    assert len(made([(0, 0, 0)], [(1, 2, 3)])[1]) == 12
    points, faces, _ = made([(0, 0, 0), (1, 0, 0)], [(1, 1, 1), (3, 1, 1)])
    assert len(faces) == 12 and volume(Mesh(points, faces)) == pytest.approx(3)


def test_faces_know_their_box_and_the_first_takes_what_is_shared():
    points, faces, boxes = made([(0, 0, 0), (1, 0, 0)], [(2, 1, 1), (3, 1, 1)], [4, 7])
    owners = np.array([4, 7])[boxes]
    corners = points[faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert areas[owners == 4].sum() == pytest.approx(4 * 2 + 1)
    assert areas[owners == 7].sum() == pytest.approx(4 * 1 + 1)


def test_a_box_inside_another_is_gone_and_a_hollow_is_kept():
    assert len(made([(0, 0, 0), (1, 1, 1)], [(3, 3, 3), (2, 2, 2)])[1]) == 12
    walls = [((0, 0, 0), (1, 3, 3)), ((2, 0, 0), (3, 3, 3)), ((0, 0, 0), (3, 1, 3)), ((0, 2, 0), (3, 3, 3)),
             ((0, 0, 0), (3, 3, 1)), ((0, 0, 2), (3, 3, 3))]  # fmt: skip
    points, faces, _ = made(*zip(*walls, strict=True))
    state = Mesh(points, faces).soundness()
    assert state.sound and state.components == 2 and volume(Mesh(points, faces)) == pytest.approx(26)


def test_coordinates_that_are_all_but_equal_are_one():
    tiny = 1e-9
    points, faces, _ = made([(0, 0, 0), (1 + tiny, tiny, -tiny)], [(1, 1, 1), (2, 1 - tiny, 1 + tiny)])
    assert len(faces) == 12 and len(points) == 8
    gap = made([(0, 0, 0), (1.001, 0, 0)], [(1, 1, 1), (2, 1, 1)])
    assert Mesh(gap[0], gap[1]).soundness().components == 2


def test_narrow_ledges_are_divided_without_slivers():
    for ledge in np.geomspace(1e-5, 1e-2, 40):
        top, leg = ((0, 1, 0), (1, 1.06, 0.65)), (ledge, 0, ledge)
        points, faces, _ = made([top[0], leg], [top[1], (0.04, 1, 0.04)])
        mesh = Mesh(points, faces)
        assert mesh.soundness().sound, ledge
        assert volume(mesh) == pytest.approx(0.06 * 0.65 + (0.04 - ledge) ** 2, abs=1e-6)


@pytest.mark.parametrize("other", [(1, 1, 0), (1, 1, 1)])
def test_boxes_that_meet_in_an_edge_or_a_corner_only_are_left_to_booleans(other):
    assert made([(0, 0, 0), other], [(1, 1, 1), tuple(np.add(other, 1))]) is None


def test_too_many_coordinates_are_left_to_booleans():
    low = np.random.default_rng(0).uniform(0, 1, (60, 3))
    assert made(low, low + 0.01) is None
