import pytest
import shapely

from shapewright.comparison.pictures import intersection_over_union, visual_information_fidelity
from shapewright.rendering.ink import HALF, coverage, picture
from shapewright.settings import Settings
from shapewright.shapes import Drawing


def front_of_a_table(leg=0.08, height=0.7):
    top = shapely.box(0, height - 0.06, 1, height)
    legs = [shapely.box(x, 0, x + leg, height) for x in (0, 1 - leg)]
    return Drawing(shapely.union_all([top, *legs]))


def test_the_same_drawing_is_kept_whole_at_any_size_and_place():
    table = front_of_a_table()
    moved = Drawing(shapely.affinity.translate(shapely.affinity.scale(table.geometry, 5, 5), 40, -7))
    for measure in (intersection_over_union, visual_information_fidelity):
        assert measure(table, moved) == pytest.approx(1.0, abs=0.02)


def test_measures_fall_with_the_difference():
    table = front_of_a_table()
    others = [front_of_a_table(leg=0.1), front_of_a_table(leg=0.2), Drawing(shapely.Point(0, 0).buffer(1))]
    overlaps = [intersection_over_union(table, other) for other in others]
    fidelities = [visual_information_fidelity(table, other) for other in others]
    assert overlaps == sorted(overlaps, reverse=True) and fidelities == sorted(fidelities, reverse=True)
    assert fidelities[0] > Settings.vif > fidelities[-1]
    assert overlaps[0] == pytest.approx((0.06 + 0.2 * 0.64 * 0.8) / (0.06 + 0.2 * 0.64), abs=0.08)


def test_coverage_is_exact_and_changes_with_the_least_movement():
    ring = shapely.Point(0, 0).buffer(0.5).difference(shapely.Point(0.1, 0).buffer(0.2))
    lines = shapely.union_all([shapely.LineString([(0, y), (1, y / 3)]).buffer(0.001) for y in (0.1, 0.5, 0.9)])
    for geometry in (ring, shapely.reverse(ring), lines, shapely.box(-0.5, 0, 0.5, 0.003)):
        drawing = Drawing(geometry).normalised()
        image = coverage(drawing, 64)
        assert image.min() > -1e-12 and image.max() < 1 + 1e-12
        assert image.sum() * (2 * HALF / 64) ** 2 == pytest.approx(drawing.geometry.area, rel=1e-9)
        assert image == pytest.approx(picture(drawing, 64, 16)[0] / 255, abs=0.1)
    thin, thinner = (coverage(front_of_a_table(leg), 64) for leg in (0.03, 0.0299))
    assert (thin - thinner).sum() * (2 * HALF / 64) ** 2 == pytest.approx(2 * 0.0001 * 0.64)
