import numpy as np
import pytest

from shapewright.comparison.grouping import group


def between(points):
    points = np.asarray(points, dtype=float)
    return np.abs(points[:, None] - points[None, :])


def test_groups_are_merged_up_to_a_share_of_the_largest_distance():
    names = ["a", "b", "c", "d", "e", "f"]
    groups = group(names, between([0.0, 0.3, 0.35, 1.0, 1.1, 2.0]))
    assert [set(g.members) for g in groups] == [{"a", "b", "c"}, {"d", "e"}, {"f"}]
    assert [g.representative for g in groups] == ["b", "d", "f"]
    assert groups[0].members[0] == "b" and len(groups[0]) == 3


def test_complete_linkage_bounds_the_diameter_of_a_group():
    points = np.random.default_rng(0).random(60)
    distances = between(points)
    for found in group([str(i) for i in range(60)], distances):
        rows = [int(name) for name in found.members]
        assert distances[np.ix_(rows, rows)].max() <= 0.4 * distances.max()


def test_the_cut_can_be_absolute():
    names = ["a", "b", "c"]
    assert len(group(names, between([0, 1, 10]), cut=1.0, absolute=True)) == 2
    assert len(group(names, between([0, 1, 10]), cut=0.99, absolute=True)) == 3


@pytest.mark.parametrize("count", [0, 1])
def test_too_few_to_group(count):
    groups = group(["only"][:count], np.zeros((count, count)))
    assert [g.members for g in groups] == [("only",)][:count]


def test_equal_shapes_are_one_group():
    groups = group(["b", "a"], np.zeros((2, 2)))
    assert len(groups) == 1 and set(groups[0].members) == {"a", "b"}
