"""Surfaces of polygons: cutting without cracks, and triangles of polygons."""

import numpy as np
import pytest

from shapewright import Mesh
from shapewright.modelling import verbs
from shapewright.modelling.deformation import Domain, Turn
from shapewright.modelling.facets import Surface, deformed
from shapewright.modelling.solids import sphere

CUBE = Surface(
    np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float),
    np.array([0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]),
    np.arange(0, 25, 4),
    np.arange(6),
)


def mesh(surface):
    faces, owners = surface.triangles()
    return Mesh(surface.points, faces), owners


def areas(made, owners):
    corners = made.triangles
    size = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    return np.bincount(owners, weights=size)


def test_a_cut_makes_no_crack_and_keeps_owners():
    cut = CUBE.cut(0, [0.25, 0.5]).cut(2, [0.3])
    made, owners = mesh(cut)
    assert made.soundness().sound
    np.testing.assert_allclose(areas(made, owners), 1)
    assert np.bincount(cut.owners).tolist() == [2, 2, 6, 6, 3, 3]
    assert {0.25, 0.5} <= set(cut.points[:, 0]) and 0.3 in cut.points[:, 2]


def test_a_cut_through_corners_and_edges_adds_none():
    for at in (0.0, 1.0, -1.0, 2.0):
        cut = CUBE.cut(1, [at])
        np.testing.assert_array_equal(cut.corners, CUBE.corners)
        np.testing.assert_array_equal(cut.starts, CUBE.starts)
    twice = CUBE.cut(1, [0.5]).cut(1, [0.5])
    assert len(twice.points) == len(CUBE.cut(1, [0.5]).points) == 12


def test_any_closed_surface_stays_closed_under_cuts():
    ball = sphere(2, segments=20).mesh()
    surface = Surface.of_triangles(ball.vertices, ball.faces, np.zeros(len(ball.faces), dtype=int))
    for axis, places in ((0, [-0.5, 0.1]), (1, [0.0, 0.33]), (2, [-0.9, 0.9])):
        surface = surface.cut(axis, places)
    made, owners = mesh(surface)
    assert made.soundness().sound and len(made.faces) > 2 * len(ball.faces)
    assert areas(made, owners) == pytest.approx(areas(ball, np.zeros(len(ball.faces), dtype=int)))


def test_triangles_of_a_polygon_cover_it_and_the_shorter_diagonal_is_taken():
    turn = np.linspace(0, 2 * np.pi, 13)[:-1]
    disc = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    faces, _ = Surface(disc, np.arange(12), np.array([0, 12]), np.zeros(1, dtype=int)).triangles()
    assert len(faces) == 10
    normals = np.cross(disc[faces[:, 1]] - disc[faces[:, 0]], disc[faces[:, 2]] - disc[faces[:, 0]])[:, 2] / 2
    assert (normals > 0).all() and normals.sum() == pytest.approx(6 * np.sin(np.pi / 6))
    kite = np.array([(0, 0, 0), (2, -0.1, 0), (4, 0, 0), (2, 0.1, 0)])
    for start in range(4):
        faces, _ = Surface(np.roll(kite, start, axis=0), np.arange(4), np.array([0, 4]), np.zeros(1, int)).triangles()
        shared = set(faces[0]) & set(faces[1])
        assert {tuple(np.roll(kite, start, axis=0)[i]) for i in shared} == {(2, -0.1, 0), (2, 0.1, 0)}


def test_cuts_are_made_where_the_deformation_curves_only():
    domain = Domain((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    straight = deformed(CUBE, [verbs.taper(domain, 0.5, "y")], 1e-4)
    assert len(straight.owners) == 6
    arched = deformed(CUBE, [verbs.path(domain, (0, 0, 0), (0.3, 0, 0), (0, 0, 0), axis="y")], 1e-2)
    heights = np.unique(arched.points[:, 1])
    assert 3 <= len(heights) <= 6 and len(arched.points) == 4 * len(heights)
    sideways = verbs.path(domain, (0, 0, 0), (0, 0.3, 0), (0, 0, 0), axis="x")
    both = deformed(CUBE, [verbs.twist(domain, 90, "x"), sideways], 1e-2)
    assert mesh(both)[0].soundness().sound
    turned = deformed(CUBE, [Turn(2, 30.0, (0.5, 0.5, 0.5))], 1e-4)
    assert len(turned.owners) == 6


def test_a_cut_near_points_that_are_there_is_made_through_them():
    """Else a strip as thin as rounding would arise."""
    domain = Domain((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    arch = [verbs.path(domain, (0, 0, 0), (0.5, 0, 0), (0, 0, 0), axis="y")]
    plain = sorted(set(deformed(CUBE, arch, 1e-2).points[:, 1]))
    near = plain[1] + 0.01
    again = sorted(set(deformed(CUBE.cut(1, [near]), arch, 1e-2).points[:, 1]))
    assert near in again and plain[1] not in again and len(again) == len(plain)


def test_beyond_its_domain_a_deformation_goes_on_as_at_its_end():
    half = Domain((0.0, 0.0, 0.0), (1.0, 0.5, 1.0))
    tapered = deformed(CUBE, [verbs.taper(half, 0.5, "y")], 1e-3)
    widths = {y: np.ptp(tapered.points[tapered.points[:, 1] == y][:, 0]) for y in (0.0, 0.5, 1.0)}
    assert widths == {0.0: pytest.approx(1), 0.5: pytest.approx(0.5), 1.0: pytest.approx(0.5)}
    bent = deformed(CUBE, [verbs.bend(Domain((0.4, 0, 0.4), (0.6, 0.5, 0.6)), 40, "y", "x", 0.0)], 1e-3)
    assert mesh(bent)[0].soundness().sound
