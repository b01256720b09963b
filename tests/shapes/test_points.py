import numpy as np
import pytest

import shapewright as sw
from shapewright.shapes import Points, shape_digest

CORNERS = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]])
UP = np.tile([0.0, 1.0, 0.0], (4, 1))
QUARTER = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])


def test_bounds_and_the_normalised_points_are_those_of_a_mesh_with_these_vertices():
    points, mesh = Points(CORNERS), sw.Mesh(CORNERS, np.array([[0, 1, 2], [0, 2, 3]]))
    assert (points.bounds == mesh.bounds).all()
    assert (points.extent == [4.0, 2.0, 1.0]).all()
    assert (points.normalised().positions == mesh.normalised().vertices).all()
    assert points.normalisation() == mesh.normalisation()


def test_normals_are_of_length_one_and_stay_unknown_where_they_are_zero():
    normals = Points(CORNERS, [[0, 0, 3], [0, 0, 0], [1, 1, 0], [-2, 0, 0]]).normals
    assert np.allclose(np.linalg.norm(normals, axis=1), [1, 0, 1, 1])
    assert (normals[0] == [0, 0, 1]).all()


def test_one_place_of_the_sensor_stands_for_all_points_and_moves_with_them():
    points = Points(CORNERS, seen_from=[8.0, 0.0, 0.0])
    assert (points.seen_from == [[8.0, 0.0, 0.0]] * 4).all()
    assert (points.transformed(QUARTER).seen_from == [[0.0, 0.0, -8.0]] * 4).all()
    assert (points.normalised().seen_from == [[1.5, -0.25, -0.125]] * 4).all()


def test_normals_stay_at_right_angles_to_the_surface_where_points_are_stretched():
    slope = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]])
    stretched = Points(slope, [[-1.0, 1.0, 0.0]] * 2).transformed(np.diag([3.0, 1.0, 1.0]))
    assert (stretched.positions[1] == [3.0, 1.0, 0.0]).all()
    assert np.allclose(stretched.normals, np.array([-1.0, 3.0, 0.0]) / np.sqrt(10.0))


def test_a_matrix_of_four_rows_moves_positions_and_sensors_but_no_normals():
    matrix = np.eye(4)
    matrix[:3, 3] = [1.0, 2.0, 3.0]
    moved = Points(CORNERS, UP, [0.0, 0.0, 9.0]).transformed(matrix)
    assert (moved.positions == CORNERS + np.array([1.0, 2.0, 3.0])).all()
    assert (moved.normals == UP).all()
    assert (moved.seen_from[0] == [1.0, 2.0, 12.0]).all()


def test_chosen_points_keep_what_is_known_of_them():
    points = Points(CORNERS, np.eye(4, 3), [0.0, 0.0, 9.0]).chosen(CORNERS[:, 0] == 0.0)
    assert len(points) == 3
    assert (points.positions == CORNERS[[0, 2, 3]]).all()
    assert (points.normals == np.eye(4, 3)[[0, 2, 3]]).all()
    assert points.seen_from.shape == (3, 3)


def test_the_digest_tells_positions_normals_and_sensors_apart():
    some = [Points(CORNERS), Points(CORNERS + 1.0), Points(CORNERS, UP), Points(CORNERS, seen_from=UP)]
    assert len({shape_digest(each) for each in some}) == 4
    assert shape_digest(Points(CORNERS, UP)) == shape_digest(Points(CORNERS.copy(), 2.0 * UP))


@pytest.mark.parametrize(
    ("positions", "normals", "says"),
    [
        (np.empty((0, 3)), None, "there are no points"),
        (CORNERS[:, :2], None, r"positions have the form \(4, 2\), not \(N, 3\)"),
        (CORNERS, UP[:3], r"normals have the form \(3, 3\), not \(4, 3\)"),
        (CORNERS * np.nan, None, "some positions are not finite"),
    ],
)
def test_arrays_of_another_form_are_refused(positions, normals, says):
    with pytest.raises(ValueError, match=says):
        Points(positions, normals)


def test_points_of_no_size_cannot_be_normalised():
    with pytest.raises(ValueError, match="no size"):
        Points(CORNERS[:1]).normalised()
