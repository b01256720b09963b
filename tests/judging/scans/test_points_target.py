import math

import numpy as np
import pytest

import shapewright as sw
from shapewright.judging.judge import Judge, fidelity, target_of
from shapewright.judging.scans.points_target import PointsTarget
from shapewright.modelling.drawing import circle
from shapewright.modelling.solids import box
from shapewright.prediction.scanning import Scanner, side_cameras
from shapewright.shapes import Points

SETTINGS = sw.Settings(workers=1)
SIDES = side_cameras((-75.0, 0.0, 75.0), (20.0, 30.0, 20.0))


def table(height=0.7, leg=0.08, shelf=0.0):
    post = box((leg, height, leg), at=(0.4, 0, 0.3))
    whole = box((1, 0.06, 0.8), at=(0, height / 2, 0)) | post.mirror("x", keep=True).mirror("z", keep=True)
    return (whole | box((0.8, 0.05, 0.6), at=(0, -0.1, 0)) if shelf else whole).mesh()


def scan(mesh, seed=0):
    return Points(Scanner(SIDES).scan(mesh, np.random.default_rng(seed)).positions).normalised()


def test_the_mesh_that_was_scanned_is_replicated_though_half_of_it_was_hidden():
    verdict = fidelity(table(), scan(table()))
    assert verdict.grade == "replicated"
    assert not verdict.missing and not verdict.surplus


@pytest.mark.parametrize("other", [table(0.5), table(leg=0.3), table(shelf=1.0)], ids=["lower", "thicker", "a shelf"])
def test_another_shape_is_not(other):
    assert fidelity(other, scan(table())).grade != "replicated"


def test_regions_say_what_is_missing_and_what_is_surplus():
    more, less = fidelity(table(shelf=1.0), scan(table())), fidelity(table(), scan(table(shelf=1.0)))
    assert more.surplus and not more.missing
    assert less.missing and not less.surplus
    low, high = np.array(more.surplus[0].low), np.array(more.surplus[0].high)
    assert (low[1] < -0.05) and (high[1] < 0.05)


def test_measures_are_of_the_points_alone():
    measures = target_of(scan(table()), SETTINGS).measures(table())
    assert measures.chamfer < 0.005
    assert measures.f2 > measures.f1 > 0.9
    assert math.isnan(measures.iou) and math.isnan(measures.depth) and math.isnan(measures.volume_iou)
    assert measures.distance < target_of(scan(table()), SETTINGS).measures(table(0.5)).distance


def test_its_metric_says_what_was_measured():
    target = target_of(scan(table()), sw.Settings(judge="paper", workers=1))
    assert target.metric.name == "distance of the points"
    assert target.grade(target.measures(table())) == "replicated"
    assert target.grade(target.measures(table(0.4))) == "different"


def test_what_cannot_be_compared_has_no_measures():
    for points, replica in ((scan(table()), circle(1.0)), (Points(np.eye(3)), table()), (scan(table()), None)):
        target = PointsTarget(points, SETTINGS)
        assert math.isnan(target.measures(replica).distance)
        assert math.isnan(target.evidence(replica).value)
    assert not PointsTarget(Points(np.eye(3)), SETTINGS).visible


def test_meshes_and_scans_are_judged_and_grouped_in_one_collection():
    shapes = {"a": table(), "b": scan(table()), "c": scan(table(), 1), "d": box((1, 1, 1)).mesh()}
    judge = Judge.of(sw.Collection.of(shapes), SETTINGS)
    groups = judge.groups(["different"] * 4, [None] * 4)
    assert sorted(name for group in groups for name in group.members) == ["a", "b", "c", "d"]
    assert any({"b", "c"} <= set(group.members) for group in groups)
