import math

import numpy as np
import pytest

from shapewright.modelling.curves import bernstein, bezier, knots, smooth, spline


def furthest(points, curve):
    """The largest distance of points (on a curve) from the chords between others."""
    a, b = curve[:-1], curve[1:]
    along = np.clip(((points[:, None] - a) * (b - a)).sum(-1) / ((b - a) ** 2).sum(-1), 0, 1)
    return np.linalg.norm(points[:, None] - a - along[..., None] * (b - a), axis=-1).min(axis=1).max()


def test_bernstein_is_the_bezier_curve():
    t = np.linspace(0, 1, 7)
    control = np.array([(0, 0), (1, 2), (3, -1), (4, 1)])
    by_hand = [sum(math.comb(3, k) * s**k * (1 - s) ** (3 - k) * control[k] for k in range(4)) for s in t]
    np.testing.assert_allclose(bernstein(control, t), by_hand, atol=1e-12)
    np.testing.assert_array_equal(bernstein(control, np.zeros(1))[0], control[0])
    np.testing.assert_allclose(bernstein([(2,)], t), 2)


@pytest.mark.parametrize("tolerance", [0.05, 0.01, 0.001])
def test_chords_stay_within_the_tolerance_and_are_no_more_than_needed(tolerance):
    control = [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 1)]
    curve = bezier(*control, tolerance=tolerance)
    fine = bernstein(control, np.linspace(0, 1, 400))
    assert furthest(fine, curve) <= 1.1 * tolerance
    even = bernstein(control, np.linspace(0, 1, max(len(curve) // 2, 2)))
    assert furthest(fine, even) > tolerance
    np.testing.assert_allclose(curve[[0, -1]], [control[0], control[-1]])


def test_knots_lie_where_it_bends():
    assert knots(np.linspace(0, 1, 33)[:, None, None] * np.ones(3), 1e-6) == []
    t = np.linspace(0, 1, 129)
    hook = np.stack([t, np.where(t < 0.75, 0, (t - 0.75) ** 2 * 16), 0 * t], axis=1)[:, None]
    assert min(knots(hook, 1e-3)) > 0.7
    quarter = np.stack([np.cos(t * math.pi / 2), np.sin(t * math.pi / 2), 0 * t], axis=1)[:, None]
    found = np.array([0, *knots(quarter, 1e-3), 1])
    np.testing.assert_allclose(np.diff(found), 1 / (len(found) - 1), atol=1e-3)
    assert 1 - math.cos(math.pi / 4 / (len(found) - 1)) <= 1e-3


def test_a_spline_runs_through_its_points():
    points = [(0, 0), (1, 2), (3, 1), (3.5, 4)]
    curve = spline(*points)
    for point in points:
        assert np.linalg.norm(curve - point, axis=1).min() < 1e-12
    np.testing.assert_allclose(spline((0, 0, 0), (1, 2, 3)), [(0, 0, 0), (1, 2, 3)])
    ring = spline((1, 0), (0, 1), (-1, 0), (0, -1), closed=True)
    np.testing.assert_array_equal(ring[0], ring[-1])
    np.testing.assert_allclose(ring, ring[::-1] * (1, -1), atol=1e-9)
    assert np.linalg.norm(ring, axis=1).min() > 0.85 and len(ring) > 12


def test_smooth_runs_through_the_copies_of_a_ring():
    stack = np.array([[(1, 0, 0), (0, 0, 1)], [(2, 1, 0), (0, 1, 2)], [(1, 3, 0), (0, 3, 1)]], dtype=float)
    made = smooth(stack, 0.01)
    assert len(made) > 5
    for copy in stack:
        assert np.abs(made - copy).max(axis=(1, 2)).min() < 1e-12
    assert (np.diff(made[:, 0, 1]) > 0).all()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: bezier((0, 0)), "bezier: it takes at least 2"),
        (lambda: bezier((0, 0), (1, float("nan"))), "finite"),
        (lambda: spline((1, 1), (1, 1)), "all its points are one"),
        (lambda: spline((0, 0), (0, 0), (1, 1)), "two points in succession are equal"),
        (lambda: spline((0, 0), (1, 1), closed=True), "at least 3"),
        (lambda: bezier((0, 0), (1, 1), tolerance=0), "tolerance"),
    ],
)
def test_bad_points_are_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()
