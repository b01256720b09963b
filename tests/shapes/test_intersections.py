"""Pairs of triangles that cross, against an independent test, and where they only touch."""

import itertools

import numpy as np
import pytest

from shapewright.modelling.solids import box, cylinder, sphere
from shapewright.shapes import concatenate
from shapewright.shapes.intersections import crossing_pairs

FLAT = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]


def pairs(*triangles):
    return [tuple(pair) for pair in crossing_pairs(np.array(triangles, dtype=float))]


def edge_pierces(edge, triangle):
    """Whether a segment passes through the inside of a triangle, by the signs of tetrahedra."""
    p, q = edge
    a, b, c = triangle
    volume = lambda *corners: np.linalg.det(np.array(corners[1:]) - corners[0])  # noqa: E731
    if volume(p, a, b, c) * volume(q, a, b, c) >= 0:
        return False
    signs = [volume(p, q, s, t) for s, t in ((a, b), (b, c), (c, a))]
    return all(sign > 0 for sign in signs) or all(sign < 0 for sign in signs)


def test_triangles_in_general_position_cross_when_an_edge_of_one_pierces_the_other():
    triangles = np.random.default_rng(0).uniform(-0.5, 0.5, (60, 3, 3))
    edges = lambda t: [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]  # noqa: E731
    expected = [
        (i, j)
        for i, j in itertools.combinations(range(len(triangles)), 2)
        if any(edge_pierces(e, triangles[j]) for e in edges(triangles[i]))
        or any(edge_pierces(e, triangles[i]) for e in edges(triangles[j]))
    ]
    assert len(expected) > 50
    assert pairs(*triangles) == expected


@pytest.mark.parametrize(
    ("other", "crosses"),
    [
        ([(0.2, 0.2, -1), (0.2, 0.2, 1), (0.9, 0.9, 0.5)], True),
        ([(0.2, 0.2, 0), (0.2, 0.2, 1), (0.9, 0.9, 0.5)], False),  # a corner touches the inside
        ([(0.2, 0.2, 0), (0.4, 0.2, 0), (0.3, 0.2, 1)], True),  # an edge lies on the inside
        ([(0, 0, 0), (1, 0, 0), (0, 0, 1)], False),  # they share an edge
        ([(0, 0, 0), (1, 0, 0), (0, -1, 0)], False),  # and lie in one plane beside each other
        ([(0, 0, 0), (1, 0, 0), (0.2, 0.5, 0)], True),  # or on one another: folded
        ([(0, 0, 0), (0.3, 0.3, 1), (0.3, 0.3, -1)], True),  # they share a corner, and cross from there on
        ([(0, 0, 0), (-1, 0, 1), (-1, 0, -1)], False),  # they share a corner
        ([(0, 0, 0), (-1, 0, 0), (0, -1, 0)], False),  # and lie in one plane
        (FLAT, True),  # the same triangle
        (FLAT[::-1], True),  # and its back
        ([(0.25, 0, 0), (0.75, 0, 0), (0.5, -1, 0)], False),  # beside it, along a part of its edge
        ([(0.25, 0, 0), (0.75, 0, 0), (0.5, -1, 1)], False),  # the same at an angle
        ([(0.25, 0.1, 0), (0.75, 0.1, 0), (0.5, -1, 0)], True),  # over its edge, in its plane
        ([(0.1, 0.1, 0), (0.3, 0.1, 0), (0.1, 0.3, 0)], True),  # inside it
        ([(0.5, -0.5, -1), (0.5, 0.5, 1), (0.5, -0.5, 1)], False),  # touches its edge from outside in one point
        ([(2, 2, -1), (2, 2, 1), (3, 2, 0)], False),  # its plane is crossed elsewhere
        ([(0, 0, 2), (1, 0, 2), (0, 1, 2)], False),  # parallel
    ],
)
def test_touching_is_no_crossing(other, crosses):
    for turn in range(3):
        assert pairs(FLAT, np.roll(other, turn, axis=0)) == ([(0, 1)] if crosses else [])
        assert pairs(np.roll(other, turn, axis=0)[::-1], FLAT) == ([(0, 1)] if crosses else [])


def test_a_crossing_along_the_edges_of_a_surface_is_found():
    sheet = [[(0.2, 0.1, 0), (0.5, 0.1, 0), (0.3, 0.1, 1)], [(0.2, 0.1, 0), (0.5, 0.1, 0), (0.3, 0.1, -1)]]
    assert pairs(FLAT, *sheet) == [(0, 1), (0, 2)]


@pytest.mark.parametrize(("depth", "crosses"), [(1e-3, True), (1e-7, True), (-1e-7, False), (-1e-3, False)])
def test_crossings_deeper_than_rounding_count(depth, crosses):
    spike = [(0.3, 0.3, -depth), (0.2, 0.2, 1), (0.4, 0.3, 1)]
    wide = [(0.1, 0.2, -depth), (0.4, 0.2, -depth), (0.3, 0.3, 1)]
    assert pairs(FLAT, wide) == ([(0, 1)] if crosses else [])
    assert pairs(FLAT, spike) == ([(0, 1)] if depth >= 1e-3 else [])  # a length of a millionth is needed


def test_triangles_without_height_have_no_plane():
    assert pairs(FLAT, [(0.2, 0.2, -1), (0.2, 0.2, 0), (0.2, 0.2, 1)]) == []
    assert pairs(FLAT, [(0.2, 0.2, 0)] * 3) == []
    assert len(crossing_pairs(np.zeros((0, 3, 3)))) == 0


def test_parts_that_overlap_or_lie_against_each_other_cross_and_united_ones_do_not():
    for other in (box(1, at=(0.5, 0.4, 0.3)), box(1, at=(1, 0, 0)), box(1, at=(0.5, 0, 0)), cylinder((0.5, 3, 0.5))):
        assert len(crossing_pairs(concatenate([box(1).mesh(), other.mesh()]).triangles)) > 0
        assert len(crossing_pairs((box(1) | other).mesh().triangles)) == 0


def test_the_order_of_triangles_changes_their_numbers_only():
    parts = [sphere(1).mesh(), sphere(1, at=(0.4, 0.3, 0.2)).mesh()]
    triangles = concatenate(parts).triangles / 1.4
    found = {tuple(pair) for pair in crossing_pairs(triangles)}
    order = np.random.default_rng(1).permutation(len(triangles))
    shuffled = {tuple(sorted(order[pair])) for pair in crossing_pairs(triangles[order])}
    assert found == shuffled and len(found) > 100
    assert all(i < len(parts[0].faces) <= j for i, j in found)
