"""The judge of objects in pictures."""

import math

import pytest
import shapely

import shapewright as sw
from shapewright.judging.views.view_fidelity import ViewFidelity
from shapewright.search.views.camera_search import ViewsDifference
from stools import PLACE, stool, views


def judge(shape):
    return ViewFidelity(shape, ViewsDifference(shape))


def test_the_same_object_is_replicated_and_its_camera_is_found():
    found = judge(views(stool())).in_view(stool())
    assert found.value > 0.9 and found.iou > 0.97
    assert found.places[0] == pytest.approx(PLACE, abs=1.0)


def test_a_part_that_is_missing_or_too_much_is_found_in_the_picture():
    open_below, closed = judge(views(stool())), judge(views(stool(plinth=True)))
    surplus, missing = open_below.in_view(stool(plinth=True)), closed.in_view(stool())
    assert surplus.value < 0.35 and missing.value < 0.35
    assert surplus.surplus and missing.missing
    assert surplus.surplus[0].high[1] < 0.2  # below the seat, y up


def test_several_views_tell_more_than_one():
    other = stool(back=0.3)
    alone = judge(views(stool())).in_view(other).value
    both = judge(views(stool(), PLACE, (-60.0, 5.0, 0.3))).in_view(other)
    assert both.value <= alone + 0.05 and len(both.places) == len(both.likenesses) == 2


def test_what_is_no_mesh_cannot_be_compared():
    assert judge(views(stool())).in_view(sw.Drawing(shapely.box(0, 0, 1, 1))) is None
    assert judge(views(stool())).in_view(None) is None


def test_the_verdict_of_a_pair():
    verdict = sw.fidelity(stool(), views(stool()))
    assert verdict.grade == "replicated" and verdict.measures["iou"] > 0.97
    assert math.isnan(verdict.measures["volume_iou"])
    with pytest.raises(TypeError):
        sw.fidelity(sw.Drawing(shapely.box(0, 0, 1, 1)), views(stool()))
