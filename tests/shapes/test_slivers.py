"""Triangles without height: found, and removed without a change of the shape."""

import numpy as np
import pytest

from shapewright import Mesh
from shapewright.modelling.solids import box
from shapewright.shapes.slivers import SLIVER, heights, without_slivers

TETRAHEDRON = [(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2)]


def volume(vertices, faces):
    a, b, c = vertices[faces].transpose(1, 0, 2)
    return float(np.einsum("fd,fd->", a, np.cross(b, c)) / 6)


def cleaned(vertices, faces, owners=None):
    vertices, faces = np.array(vertices, dtype=float), np.array(faces)
    return without_slivers(vertices, faces, np.zeros(len(faces), int) if owners is None else np.array(owners), SLIVER)


def test_heights():
    np.testing.assert_allclose(heights(np.array([[(0, 0, 0), (2, 0, 0), (0.5, 0.1, 0)], [(0, 0, 0)] * 3])), [0.1, 0])
    assert heights(np.array([[(0, 0, 0), (3, 0, 0), (0, 4, 0)]]))[0] == pytest.approx(12 / 5)
    assert heights(np.zeros((0, 3, 3))).shape == (0,)


def test_a_mesh_without_slivers_is_left_alone():
    mesh = box(1).mesh()
    vertices, faces, owners = without_slivers(mesh.vertices, mesh.faces, np.arange(12), SLIVER)
    assert vertices is mesh.vertices and faces is mesh.faces and owners.tolist() == list(range(12))


def test_a_corner_on_the_edge_of_its_neighbour_divides_it():
    # A square pyramid's base is cut at a point that lies, but for 1e-9, on the base's diagonal.
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1), (0.5 - 1e-9, 0.5 + 1e-9, 0)]
    sides = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
    faces = [*sides, (0, 2, 1), (0, 5, 2), (0, 3, 5), (3, 2, 5)]
    assert heights(np.array(corners)[faces]).min() < SLIVER
    vertices, made, owners = cleaned(corners, faces, [0, 0, 0, 0, 1, 1, 2, 2])
    assert heights(vertices[made]).min() > 0.1 and len(made) == len(faces)
    assert volume(vertices, made) == pytest.approx(1 / 3)
    assert Mesh(vertices, made).soundness().sound
    assert sorted(owners.tolist()) == [0, 0, 0, 0, 1, 1, 2, 2]


def test_an_edge_without_length_is_closed():
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1e-8, 0, 0)]
    faces = [(0, 2, 4), (4, 2, 1), (0, 3, 2), (1, 2, 3), (0, 4, 3), (4, 1, 3)]
    vertices, made, _ = cleaned(corners, faces)
    assert len(vertices) == 4 and len(made) == 4
    assert Mesh(vertices, made).soundness().sound and volume(vertices, made) == pytest.approx(1 / 6, rel=1e-6)


def test_a_real_spike_is_not_cut_off():
    """A needle of a solid has faces without height that nothing can replace."""
    needle = np.array([(0, 0, 0), (1e-7, 0, 0), (0, 1e-7, 0), (0, 0, 1)])
    vertices, made, _ = cleaned(needle, TETRAHEDRON)
    assert len(made) == 4 and len(vertices) == 4


def test_points_on_one_line_where_two_labels_meet():
    """What booleans of flush faces with labels leave: four points all but on one line, two of them close together."""
    p, q = (0.5, 0.3554462, -0.3600950), (0.5, 0.3554422, -0.36)
    low, high, right, back = (0.5, 0.3214286, 0.4), (0.5, 0.3571429, -0.4), (0.5, 0.36, 0), (0.5, 0.3, -0.1)
    tip = (-0.5, 0.34, 0)
    ring = [high, back, low, right]
    faces = [(0, 1, 4), (1, 2, 5), (1, 5, 4), (2, 3, 5), (3, 0, 4), (3, 4, 5)]
    faces += [(b, a, 6) for a, b in ((0, 1), (1, 2), (2, 3), (3, 0))]
    corners = [*ring, p, q, tip]
    assert (heights(np.array(corners)[faces]) < 1e-5).any()
    before = Mesh(np.array(corners), np.array(faces))
    vertices, made, _ = without_slivers(before.vertices, before.faces, np.zeros(len(faces), dtype=int), 1e-5)
    assert heights(vertices[made]).min() >= 1e-5
    after = Mesh(vertices, made).soundness()
    assert after.closed and after.manifold and not after.self_intersections
    assert volume(vertices, made) == pytest.approx(volume(before.vertices, before.faces), rel=1e-3)
