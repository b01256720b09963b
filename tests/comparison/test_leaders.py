import numpy as np
import pytest

from shapewright.comparison.grouping import group
from shapewright.comparison.leaders import group_by_leaders


def clouds(seed, count=8, size=30, spread=0.02):
    rng = np.random.default_rng(seed)
    middles = np.stack(np.meshgrid(*[np.linspace(0.0, 1.0, 3)] * 2), axis=-1).reshape(-1, 2)[:count]
    points = np.repeat(middles, size, axis=0) + spread * rng.standard_normal((count * size, 2))
    return points[rng.permutation(len(points))]


def measured(points):
    taken = []

    def between(some, others):
        taken.append(len(some) * len(others))
        return np.linalg.norm(points[list(some)][:, None] - points[list(others)][None], axis=2)

    return between, taken


def as_sets(groups):
    return {frozenset(each.members) for each in groups}


@pytest.mark.parametrize("absolute", [False, True])
def test_separate_groups_are_found_as_with_all_distances(absolute):
    points = clouds(0)
    names = [f"{i:03d}" for i in range(len(points))]
    between, _ = measured(points)
    everything = list(range(len(points)))
    cut = 0.3 if absolute else 0.2
    whole = group(names, between(everything, everything), cut, absolute)
    quick = group_by_leaders(names, between, cut, absolute)
    assert len(quick) == 8 and as_sets(quick) == as_sets(whole)
    middles = {each.representative for each in whole}
    assert sum(each.representative in middles for each in quick) >= 6


def test_it_takes_few_of_all_distances():
    points = clouds(1, size=400)
    between, taken = measured(points)
    groups = group_by_leaders([str(i) for i in range(len(points))], between, 0.3, absolute=True, most=12)
    assert len(groups) == 8 and sum(taken) < 0.1 * len(points) ** 2


@pytest.mark.parametrize("absolute", [False, True])
def test_a_continuum_is_grouped_as_with_all_distances(absolute):
    points = np.random.default_rng(3).random((200, 3))
    between, _ = measured(points)
    names = [f"{i:03d}" for i in range(len(points))]
    everything = list(range(len(points)))
    whole = group(names, between(everything, everything), 0.3, absolute)
    quick = group_by_leaders(names, between, 0.3, absolute, most=20)
    assert len(whole) > 3 and as_sets(quick) == as_sets(whole)
    assert [each.representative for each in quick] == [each.representative for each in whole]


def test_one_shape_and_none():
    between, _ = measured(np.zeros((1, 2)))
    assert group_by_leaders([], between) == ()
    assert group_by_leaders(["a"], between)[0].members == ("a",)


def test_many_shapes_are_grouped_without_the_distances_of_all_pairs():
    points = clouds(2, size=250)
    between, taken = measured(points)
    names = [f"{i:04d}" for i in range(len(points))]
    few = group_by_leaders(names, between, 0.3, absolute=True, most=12, many=200)
    assert sum(taken) < 0.06 * len(points) ** 2
    assert as_sets(few) == as_sets(group_by_leaders(names, between, 0.3, absolute=True, most=12))
    assert few == group_by_leaders(names, between, 0.3, absolute=True, most=12, many=200)


def test_what_joins_no_group_of_the_first_is_grouped_as_well():
    points = np.concatenate([clouds(4, size=100), [[5.0, 5.0], [5.01, 5.0], [9.0, 9.0]]])
    between, _ = measured(points)
    names = [f"{i:03d}" for i in range(len(points))]
    groups = group_by_leaders(names, between, 0.3, absolute=True, most=12, many=60)
    assert sorted(name for each in groups for name in each.members) == names
    assert {"800", "801"} in as_sets(groups) and {"802"} in as_sets(groups)
    assert max(len(each) for each in groups) == 100
