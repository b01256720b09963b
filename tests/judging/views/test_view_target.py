"""An object in pictures as a target."""

import math

import numpy as np

from shapewright.judging.views.view_target import ViewTarget
from shapewright.settings import Settings
from stools import stool, views

SETTINGS = Settings(workers=1)


def test_a_target_measures_in_view_alone():
    target = ViewTarget(views(stool()), SETTINGS)
    measures = target.measures(stool())
    assert measures.distance == 1.0 - measures.iou < 0.03 and target.compatible(measures)
    assert math.isnan(measures.depth) and target.grade(measures) == "replicated"
    assert target.measures(None).by_name().keys() == measures.by_name().keys() and math.isnan(target.measures(None).iou)
    assert target.metric.criterion == "IoU of the silhouettes at least 0.9"


def test_costs_are_of_the_finest_scale():
    target = ViewTarget(views(stool()), SETTINGS)
    residual = target.objective().residual(stool(back=0.6))
    assert target.cost(stool(back=0.6)) == np.abs(residual[target.parts[-1]]).sum() > target.cost(stool())


def test_the_paper_s_judge_goes_by_the_overlap():
    target = ViewTarget(views(stool()), Settings(judge="paper", workers=1))
    assert target.grade(target.measures(stool())) == "replicated"
    assert target.grade(target.measures(stool(plinth=True, back=0.1))) == "different"


def test_groups_are_of_pictures_that_look_alike():
    shapes = {"a": stool(), "b": stool(back=0.48), "c": stool(plinth=True, back=0.1)}
    targets = [ViewTarget(views(shape), SETTINGS) for shape in shapes.values()]
    groups = ViewTarget.groups(tuple(shapes), targets, SETTINGS)
    assert {frozenset(group.members) for group in groups} == {frozenset("ab"), frozenset("c")}
