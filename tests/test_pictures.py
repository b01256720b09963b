import pytest
import shapely

from shapewright.comparison.pictures import VIF_THRESHOLD, intersection_over_union, visual_information_fidelity
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
    assert fidelities[0] > VIF_THRESHOLD > fidelities[-1]
    assert overlaps[0] == pytest.approx((0.06 + 0.2 * 0.64 * 0.8) / (0.06 + 0.2 * 0.64), abs=0.08)
