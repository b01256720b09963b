import numpy as np
import pytest
import trimesh

from shapewright.comparison.surface_distance import NearSurface
from shapewright.modelling.solids import box, cylinder
from shapewright.shapes import Floats, Mesh, concatenate


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
    assert np.array_equal(found.lengths(points), np.abs(found.distances(points)))


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
