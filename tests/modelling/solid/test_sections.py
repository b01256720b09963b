import math

import numpy as np
import pytest
import shapely

from shapewright.modelling.solid.sections import area, ellipse, rectangle, section


def enclosed(made):
    corners = made.points[made.triangles()]
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    signed = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
    assert (signed >= 0).all()
    return signed.sum()


def test_rectangles():
    np.testing.assert_allclose(rectangle(2, 1), [(1, -0.5), (1, 0.5), (-1, 0.5), (-1, -0.5)])
    round_ = rectangle(2, 1, radius=0.25, segments=64)
    assert area(round_) == pytest.approx(2 - (4 - math.pi) * 0.25**2, rel=1e-4)
    assert np.abs(round_).max(axis=0).tolist() == [1, 0.5]
    full = rectangle(2, 1, radius=0.5, segments=8)
    assert len(full) == 34 and area(full) > 0
    with pytest.raises(ValueError, match=r"radius=0\.6"):
        rectangle(2, 1, radius=0.6)


def test_ellipses():
    made = ellipse(2, 1, segments=200)
    assert area(made) == pytest.approx(math.pi / 2, rel=1e-3)
    np.testing.assert_array_equal(made[0], (1, 0))


@pytest.mark.parametrize(
    ("polygon", "expected"),
    [
        (rectangle(2, 1), 2),
        (rectangle(2, 1)[::-1], 2),
        ([*rectangle(2, 1), rectangle(2, 1)[0]], 2),  # closed by its first point
        ([(0, 0), (1, 0), (2, 0), (2, 1), (0, 1)], 2),  # a corner that does not turn
        ([(0, 0), (2, 0), (2, 2), (1, 0.5), (0, 2)], 2.5),  # not convex
        ([rectangle(2, 2), rectangle(1, 1)], 3),
        ([rectangle(1, 1), rectangle(2, 2)[::-1]], 3),
        ([rectangle(1, 1), rectangle(1, 1) + 3], 2),
        ([(0, 0), (1, 1), (1, 0), (0, 1)], 0.5),  # a bow tie
        (shapely.box(0, 0, 2, 1).difference(shapely.box(0.5, 0.25, 1, 0.75)), 1.75),
        (shapely.MultiPolygon([shapely.box(0, 0, 1, 1), shapely.box(2, 0, 3, 1)]), 2),
    ],
)
def test_any_polygon_becomes_rings_with_the_area_to_their_left(polygon, expected):
    made = section("plan", polygon)
    assert sum(area(ring) for ring in made.rings) == pytest.approx(expected)
    assert enclosed(made) == pytest.approx(expected)
    a, b = made.points[made.edges].transpose(1, 0, 2)
    assert ((a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]) / 2).sum() == pytest.approx(expected)


def test_double_precision_is_kept():
    third = 1 / 3
    for polygon in ([(0, 0), (third, 0), (0, third)], [(0, 0), (third, 0), (third, third), (0.1, 0.01), (0, third)]):
        assert (section("plan", polygon).points == third).any()


LINE, GAP = [(0, 0), (1, 1), (2, 2)], [(0, 0), (1, 0), (0, math.nan)]


@pytest.mark.parametrize("bad", [[], [(0, 0), (1, 1)], LINE, GAP, [1, 2]])
def test_what_is_no_polygon_is_refused(bad):
    with pytest.raises(ValueError, match=r"^plan: (a polygon is at least three|the polygon has no area)"):
        section("plan", bad)
