"""Of very many references some are explained."""

from types import SimpleNamespace

import shapewright as sw
from shapewright.comparison.grouping import Group
from shapewright.feedback.record import sample_record
from shapewright.feedback.sample import sample_of
from shapewright.judging.paper import light_field_metric


def iteration(count, sizes, good):
    """Results without shapes: of each group so many, and replicated ones."""
    names = [f"{i:05d}" for i in range(count)]
    groups, start = [], 0
    for size in sizes:
        members = names[start : start + size]
        groups.append(Group(members[-1], tuple(members)))
        start += size
    results = tuple(
        SimpleNamespace(name=name, grade="replicated" if i >= count - good else "different", follows=None)
        for i, name in enumerate(names)
    )
    return sw.Iteration(results, light_field_metric(0.18), tuple(groups), sw.Settings(), {}, {}, "", {}, {}, {}, "")


def test_a_small_iteration_is_explained_whole():
    whole = iteration(50, [30, 5], 10)
    assert sample_of(whole, 50) is whole


def test_every_group_has_its_representative_and_its_share():
    whole = iteration(1000, [500, 20, 3, 1], 400)
    some = sample_of(whole, 40)
    names = [result.name for result in some.results]
    assert len(names) == 40 and names == sorted(names)
    assert {group.representative for group in whole.groups} <= set(names)
    of = [sum(name in group.members for name in names) for group in whole.groups]
    assert of == [13, 13, 3, 1] and sum(result.grade == "replicated" for result in some.results) == 10
    assert names == [result.name for result in sample_of(whole, 40).results]
    assert names != [result.name for result in sample_of(whole, 40, seed=1).results]


def test_of_more_groups_than_places_the_largest_are_there():
    whole = iteration(300, [1] * 100 + [50] * 4, 0)
    names = {result.name for result in sample_of(whole, 10).results}
    assert len(names) == 10 and {group.representative for group in whole.groups[100:]} <= names


def test_the_sample_is_told():
    told = sample_record(600, 100_000)
    assert told["text"].startswith("Explained on a sample: 600 of 100,000 references, some of each group.")
