"""Distances to a surface, and the meshes that show them."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from shapewright.modelling.solids import box, cylinder
from shapewright.shapes import Floats, Mesh, concatenate
from shapewright.studio.bench.residual_colours import LIMIT, refined, residual, scale
from shapewright.studio.bench.surface_distance import NearSurface


def to_triangles(points: Floats, mesh: Mesh) -> Floats:
    """The distance to every triangle by trimesh, one triangle at a time; the least of each point."""
    least = np.full(len(points), np.inf)
    for triangle in mesh.triangles:
        nearest = trimesh.triangles.closest_point(np.broadcast_to(triangle, (len(points), 3, 3)), points)
        least = np.minimum(least, np.linalg.norm(points - nearest, axis=1))
    return least


@pytest.mark.parametrize("open", [False, True])
def test_distances_are_those_to_the_nearest_triangle(open: bool) -> None:
    mesh = (box((1, 0.2, 0.6)) | cylinder((0.3, 0.9, 0.3), at=(0.1, 0.3, 0))).mesh()
    if open:
        mesh = Mesh(mesh.vertices, mesh.faces[5:])
    points = np.random.default_rng(1).uniform(-1, 1, (400, 3))
    found = NearSurface(mesh)
    assert found.closed != open
    assert np.allclose(np.abs(found.distances(points)), to_triangles(points, mesh), atol=1e-12)


def test_sign_tells_inside_from_outside() -> None:
    solid = (box((1, 1, 1)) - box((0.4, 0.4, 2))).mesh()
    points = np.random.default_rng(2).uniform(-0.7, 0.7, (3000, 3))
    inside = (np.abs(points).max(axis=1) < 0.5) & (np.abs(points[:, :2]).max(axis=1) > 0.2)
    distances = NearSurface(solid).distances(points)
    assert ((distances < 0) == inside).all()
    assert (NearSurface(Mesh(solid.vertices, solid.faces[1:])).distances(points) >= 0).all()


def test_surface_without_area_is_refused() -> None:
    flat = Mesh(np.zeros((3, 3)), np.array([[0, 1, 2]]))
    with pytest.raises(ValueError, match="no area"):
        NearSurface(flat)
    whole = box((1, 1, 1)).mesh()
    assert np.allclose(NearSurface(concatenate([whole, flat])).distances(np.array([[2.0, 0, 0]])), 1.5)


def test_refined_is_the_same_surface_in_smaller_triangles() -> None:
    mesh = box((1, 0.5, 0.02)).mesh()
    fine = refined(mesh, 0.05)
    edges = fine.triangles - np.roll(fine.triangles, -1, axis=1)
    assert np.linalg.norm(edges, axis=2).max() <= 0.05
    assert np.abs(NearSurface(mesh).distances(fine.vertices)).max() < 1e-12
    assert trimesh.Trimesh(fine.vertices, fine.faces, process=False).area == pytest.approx(2 * (0.5 + 0.02 + 0.01))


def test_of_many_triangles_the_largest_are_cut_first() -> None:
    many = trimesh.creation.icosphere(6, radius=0.1)
    ball = Mesh(np.asarray(many.vertices), np.asarray(many.faces))
    fine = refined(concatenate([ball, box((1, 1, 1)).mesh()]), 0.05)
    lengths = np.linalg.norm(fine.triangles - np.roll(fine.triangles, -1, axis=1), axis=2).max(axis=1)
    assert lengths.max() < 0.06 and len(fine.faces) <= 1.25 * len(ball.faces) + 20


def test_colours() -> None:
    low, none, high, beyond = scale(np.array([-LIMIT, 0.0, LIMIT, 5.0]))
    assert np.ptp(none) < 0.05
    assert high[0] > 2 * high[2] and low[2] > 2 * low[0] and (high == beyond).all()


def test_residual_of_a_shifted_box() -> None:
    found = residual(refined(box((1, 1, 1), at=(0, 0.05, 0)).mesh()), NearSurface(box((1, 1, 1)).mesh()))
    top = found.vertices[:, 1] > 0.5499
    assert found.signed and np.allclose(found.distances[top], 0.05)
    bottom = (found.vertices[:, 1] < -0.4499) & (np.abs(found.vertices[:, [0, 2]]).max(axis=1) < 0.4)
    assert np.allclose(found.distances[bottom], -0.05)
    assert found.colours.shape == found.vertices.shape and found.colours.min() >= 0 and found.colours.max() <= 1
