import numpy as np
import pytest

from shapewright.shapes.conversion.tables import mesh_of

ARROW = [(0, 0, 0), (2, 2, 0), (4, 0, 0), (2, 6, 0)]  # a quad with a corner that points inwards
STAR = [(np.cos(a) * r, np.sin(a) * r, 1.0) for a, r in zip(np.arange(10) * np.pi / 5, [2, 0.7] * 5, strict=True)]


def area(mesh):
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    return np.cross(b - a, c - a).sum(axis=0) / 2.0, np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2.0


@pytest.mark.parametrize(
    ("points", "faces", "triangles"),
    [
        (ARROW, [[0, 1, 2, 3]], 2),
        (ARROW, [[1, 2, 3, 0]], 2),
        (STAR, [list(range(10))], 8),
        (STAR, [list(range(10))[::-1]], 8),
        (STAR, [[0, 1, 9], [1, 2, 3], [3, 4, 5], [5, 6, 7], [7, 8, 9], [1, 3, 5, 7, 9]], 8),
    ],
)
def test_faces_of_many_corners_are_cut_inside_and_keep_their_side(points, faces, triangles):
    mesh = mesh_of(points, faces)
    signed, whole = area(mesh)
    assert len(mesh.faces) == triangles
    assert np.abs(signed).max() == pytest.approx(whole)  # no triangle is turned over, none lies outside
    outline = np.array(points)[faces[0]]
    if len(faces) == 1:
        shoelace = np.cross(outline, np.roll(outline, -1, axis=0)).sum(axis=0) / 2.0
        assert signed[2] == pytest.approx(shoelace[2])


def test_flat_quads_are_cut_as_they_always_were():
    square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    assert mesh_of(square, [[0, 1, 2, 3]]).faces.tolist() == [[0, 1, 2], [0, 2, 3]]
