import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.polygons import MOST_CORNERS, Polygons, triangulate


def polygons(vertices, loops) -> Polygons:
    flat = [corner for loop in loops for corner in loop]
    return Polygons(np.array(vertices, float), np.array(flat, dtype=np.int64), np.array([len(loop) for loop in loops]))


def area_vectors(vertices, faces) -> np.ndarray:
    a, b, c = np.asarray(vertices, float)[faces].transpose(1, 0, 2)
    return np.cross(b - a, c - a) / 2


ARROW = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (2, 1, 0), (0, 4, 0)]


def test_triangles_and_convex_polygons_keep_their_order_as_fans():
    vertices = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    faces = triangulate(polygons(vertices, [[0, 1, 2, 3], [3, 2, 1], [1, 2, 3, 0]]))
    assert faces.tolist() == [[0, 1, 2], [0, 2, 3], [3, 2, 1], [1, 2, 3], [1, 3, 0]]


@pytest.mark.parametrize("plane", [(0, 1, 2), (1, 2, 0), (2, 0, 1), (1, 0, 2), (0, 2, 1), (2, 1, 0)])
def test_a_concave_polygon_is_filled_without_overlap_whatever_its_plane_and_sense(plane):
    vertices = np.array(ARROW, float)[:, plane]
    areas = area_vectors(vertices, triangulate(polygons(vertices, [[0, 1, 2, 3, 4]])))
    assert np.linalg.norm(areas, axis=1).sum() == pytest.approx(10.0)
    assert np.linalg.norm(areas.sum(axis=0)) == pytest.approx(10.0)


def test_a_polygon_with_a_hole_bridged_to_its_rim_keeps_the_hole():
    vertices = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (1, 1, 0), (1, 3, 0), (3, 3, 0), (3, 1, 0)]
    faces = triangulate(polygons(vertices, [[0, 1, 2, 3, 0, 4, 5, 6, 7, 4]]))
    assert np.linalg.norm(area_vectors(vertices, faces), axis=1).sum() == pytest.approx(12.0)


def test_points_and_lines_give_no_triangles():
    assert triangulate(polygons(ARROW, [[0], [0, 1], [], [0, 1, 2]])).tolist() == [[0, 1, 2]]
    assert triangulate(polygons(ARROW, [[0, 1]])).shape == (0, 3)


def test_a_polygon_of_no_area_or_with_a_corner_that_is_not_finite_still_gives_its_triangles():
    vertices = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0), (np.nan, np.inf, 0)]
    assert len(triangulate(polygons(vertices, [[0, 1, 2, 3], [0, 0, 0, 0], [0, 1, 2, 4]]))) == 6


@pytest.mark.parametrize("loop", [[0, 1, 5], [-1, 0, 1]])
def test_a_corner_without_a_vertex_is_an_error(loop):
    with pytest.raises(UnreadableError, match="point outside its 5 vertices"):
        triangulate(polygons(ARROW, [loop]))


@given(st.lists(st.floats(0.2, 1.0), min_size=4, max_size=12))
def test_star_shaped_polygons_are_filled_exactly(radii):
    angles = np.linspace(0, 2 * np.pi, len(radii), endpoint=False)
    x, y = np.array(radii) * np.cos(angles), np.array(radii) * np.sin(angles)
    faces = triangulate(polygons(np.stack([x, y, x + 2 * y], axis=1), [range(len(radii))]))
    flat = area_vectors(np.stack([x, y, 0 * x], axis=1), faces)[:, 2]
    assert len(faces) == len(radii) - 2
    assert np.abs(flat).sum() == pytest.approx((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2, rel=1e-5)


def test_a_polygon_that_would_take_minutes_to_be_cut_is_refused_and_a_convex_one_is_not():
    turns = np.linspace(0.0, 2.0 * np.pi, MOST_CORNERS + 1, endpoint=False)
    circle = np.stack([np.cos(turns), np.sin(turns), 0.0 * turns], axis=-1)
    loops = [list(range(len(turns)))]
    assert len(triangulate(polygons(circle, loops))) == len(turns) - 2
    star = circle * np.where(np.arange(len(turns)) % 2, 1.0, 0.5)[:, None]
    with pytest.raises(UnreadableError, match="a polygon of 10,001 corners that is not convex"):
        triangulate(polygons(star, loops))
