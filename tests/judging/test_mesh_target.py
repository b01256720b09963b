import math
from dataclasses import replace

import numpy as np
import pytest

import shapewright as sw
from shapewright.building import Build
from shapewright.comparison import light_field, volumes
from shapewright.comparison.gaps import Surface
from shapewright.comparison.light_field.aligned import AlignedCost
from shapewright.comparison.posed import PosedDifference
from shapewright.comparison.views import depth_difference, intersection_over_union
from shapewright.judging.fidelity import Fidelity
from shapewright.judging.judge import Judge, target_of
from shapewright.judging.mesh_target import MeshTarget
from shapewright.judging.target import Measures
from shapewright.modelling.drawing import circle
from shapewright.modelling.solids import box
from shapewright.shapes import Mesh, concatenate
from shapewright.threads import in_threads

NEEDLE = Mesh(np.array([[0.0, 0, 0], [1e-9, 1, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))
SETTINGS = sw.Settings(workers=1)


def table(height=0.7, leg=0.08):
    post = box((leg, height, leg), at=(0.4, 0, 0.3))
    return (box((1, 0.06, 0.8), at=(0, height / 2, 0)) | post.mirror("x", keep=True).mirror("z", keep=True)).mesh()


def is_nothing(measures):
    return all(math.isnan(value) for value in vars(measures).values())


def test_it_measures_what_the_comparisons_measure():
    reference, replica = table(), table(0.5)
    measures = target_of(reference, sw.Settings(seed=3, align="upright")).measures(replica)
    gaps = Surface(reference, 3).gaps(Surface(replica, 3))
    assert measures == Measures(
        distance=light_field.distance(reference, replica, "upright"),
        iou=intersection_over_union(reference, replica),
        chamfer=gaps.chamfer,
        depth=depth_difference(reference, replica),
        fidelity=Fidelity(reference).evidence(replica).value,
        volume_iou=volumes.intersection_over_union(volumes.Volume.of(reference), volumes.Volume.of(replica)),
        f1=gaps.f_score(0.01),
        f2=gaps.f_score(0.02),
    )
    assert measures.chamfer != target_of(reference, SETTINGS).measures(replica).chamfer


def test_what_is_known_is_not_measured_again():
    target = MeshTarget(table(), SETTINGS)
    measures = target.measures(table(0.5), 0.25, 0.125)
    assert (measures.distance, measures.fidelity) == (0.25, 0.125)
    assert is_nothing(target.measures(table(0.5), math.nan))


def test_what_cannot_be_compared_has_no_measures():
    target = MeshTarget(table(), SETTINGS)
    for replica in (None, NEEDLE, circle(1).drawing()):
        assert is_nothing(target.measures(replica)) and math.isnan(target.nearest(replica)[0])
    assert target.cost(circle(1).drawing()) == math.inf
    assert target.objective().residual(circle(1).drawing()) is None


@pytest.mark.parametrize(("judge", "objective"), [("paper", AlignedCost), ("fidelity", PosedDifference)])
def test_a_search_goes_by_what_its_judge_sees_and_by_the_light_field_that_is_asked_for(judge, objective):
    target, replica = MeshTarget(table(), sw.Settings(workers=1, judge=judge)), table(0.5)
    for field in (0, 4):
        assert np.array_equal(target.objective(field).residual(replica), objective(table(), field).residual(replica))
    assert target.objective(4) is target.objective(4)
    assert target.cost(replica) == AlignedCost(table())(replica)


def test_a_judge_says_up_to_which_cost_a_replica_surely_counts_as_the_same():
    paper, fidelity = (MeshTarget(table(), sw.Settings(judge=judge)) for judge in ("paper", "fidelity"))
    assert paper.goal == 0.18 * light_field.RAW_SCALE
    assert fidelity.objective()(table(0.69)) < fidelity.goal < fidelity.objective()(table(0.5))


def test_nothing_replicates_what_no_view_shows():
    judge = Judge.of(sw.Collection.of({"needle": NEEDLE, "table": table()}), SETTINGS)
    builds = [Build({}, NEEDLE), Build({}, table())]
    needle = judge.targets[0]
    assert not needle.visible and needle.objective() is None and needle.cost(table()) == math.inf
    distances, fields = judge.nearest(builds)
    assert math.isnan(distances[0]) and distances[1] == 0.0 and fields[0] == 0
    measures = judge.measures(builds, distances)
    assert is_nothing(measures[0]) and judge.compatible(measures).tolist() == [False, True]
    assert judge.measure([0, 1])([(0, table()), (1, table(0.5))])[0] is None
    assert judge.groups(judge.grades(measures)) == ()
    assert judge.search_costs([(0, table()), (1, table())]) == [math.inf, 0.0]


def test_rows_say_which_references_the_builds_are_for():
    judge = Judge.of(sw.Collection.of({"first": table(0.4), "second": table(1.0)}), SETTINGS)
    assert judge.distances([Build({}, table(1.0))], [1]).tolist() == [0.0]
    low, high = judge.measure([1, 1, 0])([(2, table(0.4)), (0, table(0.4))])
    assert not low.any() and high.any()


def test_a_metric_that_was_learned_decides_in_place_of_the_threshold():
    by_iou = MeshTarget(table(), sw.Settings(metric=(-0.5, 0.0, 1.0, 0.0)))
    assert by_iou.compatible(Measures(0.9, 0.6, 0.0, 0.0)) and not by_iou.compatible(Measures(0.1, 0.4, 0.0, 0.0))
    assert not MeshTarget(table(), SETTINGS).compatible(Measures())


@pytest.mark.parametrize("asked", ["measures", "cost"])
def test_any_thread_may_ask_first(asked, tmp_path):
    target, replicas = MeshTarget(table(), SETTINGS, tmp_path), [table(0.4 + 0.1 * i) for i in range(4)]
    alone = [getattr(MeshTarget(table(), SETTINGS), asked)(replica) for replica in replicas]
    assert in_threads(getattr(target, asked), replicas, 4) == alone
    assert len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize("large", [1000, 1])
def test_misfits_are_grouped_by_what_they_lack_but_not_where_the_paper_judges(large, monkeypatch):
    monkeypatch.setattr("shapewright.judging.mesh_target.LARGE", large)
    shelf, back = box((0.8, 0.06, 0.6)).mesh(), box((1, 0.4, 0.04), at=(0, 0.1, -0.38)).mesh()
    plain = {f"{height}": table(height) for height in (0.6, 0.7, 1.3, 1.4)}
    whole = {name: concatenate([mesh, shelf if name in ("0.6", "1.4") else back]) for name, mesh in plain.items()}
    replicas, grades = [plain[name] for name in sorted(plain)], ["different"] * 4
    judge = Judge.of(sw.Collection.of(whole), replace(SETTINGS, cut=0.3))
    assert {frozenset(found.members) for found in judge.groups(grades, replicas)} == {
        frozenset({"0.6", "1.4"}),
        frozenset({"0.7", "1.3"}),
    }
    papers = Judge.of(judge.references, replace(SETTINGS, judge="paper"))
    assert papers.groups(grades, replicas) == papers.groups(grades)
