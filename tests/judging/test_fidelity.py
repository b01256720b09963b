"""The judge of how a person sees a replica: one value, a grade, and where the two differ."""

import math

import pytest

import shapewright as sw
from shapewright.judging.fidelity import Fidelity
from shapewright.judging.judge import target_of
from shapewright.modelling.drawing import box as area
from shapewright.modelling.solids import box
from shapewright.threads import in_threads

TOP = box((1, 0.06, 0.8), at=(0, 0.7, 0))
LEG = box((0.08, 0.7, 0.08), at=(0.4, 0.35, 0.3))
TABLE = (TOP | LEG.mirror("x", keep=True).mirror("z", keep=True)).mesh()
THREE_LEGS = (TOP | LEG | LEG.mirror("x") | LEG.mirror("z")).mesh()
PLATE, RING = area((1, 1)).drawing(), (area((1, 1)) - area((0.5, 0.5))).drawing()


@pytest.mark.parametrize("shape", [TABLE, PLATE], ids=["mesh", "drawing"])
def test_a_shape_is_replicated_by_itself_of_any_size_and_differs_from_another(shape):
    verdict = sw.fidelity(shape, shape)
    assert verdict.grade == "replicated" and verdict.value > 0.9 and verdict.missing == verdict.surplus == ()
    assert verdict.measures["fidelity"] == verdict.value and verdict.measures["iou"] == pytest.approx(1.0)
    other = box((1, 0.2, 0.2)).mesh() if isinstance(shape, sw.Mesh) else area((1, 0.2)).drawing()
    assert sw.fidelity(other, shape).grade == "different"


@pytest.mark.parametrize(("whole", "less"), [(TABLE, THREE_LEGS), (PLATE, RING)], ids=["mesh", "drawing"])
def test_what_is_missing_one_way_is_surplus_the_other(whole, less):
    lacking, too_much = sw.fidelity(less, whole), sw.fidelity(whole, less)
    assert lacking.value < 1.0 and lacking.missing and too_much.surplus
    for region in (*lacking.missing, *lacking.surplus, *too_much.missing, *too_much.surplus):
        sides = [high - low for low, high in zip(region.low, region.high, strict=True)]
        assert region.size == pytest.approx(max(sides)) and min(sides) >= 0.0 and 0.0 < region.share <= 1.0
    sizes = [region.size for region in lacking.missing]
    assert sizes == sorted(sizes, reverse=True)


def test_the_region_is_where_the_leg_is():
    region = sw.fidelity(THREE_LEGS, TABLE).missing[0]
    middle = [(low + high) / 2 for low, high in zip(region.low, region.high, strict=True)]
    assert middle == pytest.approx([-0.4, -0.03, -0.3], abs=0.06) and 0.5 < region.size < 0.75


def test_settings_move_the_cuts():
    value = sw.fidelity(THREE_LEGS, TABLE).value
    strict, lax = sw.Settings(replicated=0.999, close=0.998), sw.Settings(replicated=value / 2, close=value / 4)
    assert sw.fidelity(THREE_LEGS, TABLE, strict).grade == "different"
    assert sw.fidelity(THREE_LEGS, TABLE, lax).grade == "replicated"
    paper = sw.Settings(judge="paper", threshold=10.0)
    assert sw.fidelity(box(1).mesh(), TABLE, paper).grade == "replicated"


def test_what_cannot_be_compared_is_refused():
    with pytest.raises(TypeError, match="a mesh and a drawing"):
        sw.fidelity(PLATE, TABLE)
    assert math.isnan(Fidelity(TABLE).evidence(None).value) and math.isnan(Fidelity(TABLE).evidence(PLATE).value)


def test_any_thread_may_ask_for_evidence_first():
    judge, replicas = Fidelity(TABLE), [TABLE, THREE_LEGS, TABLE, THREE_LEGS]
    assert in_threads(judge.evidence, replicas, 4) == [Fidelity(TABLE).evidence(replica) for replica in replicas]


@pytest.mark.parametrize(("whole", "less"), [(TABLE, THREE_LEGS), (PLATE, RING)], ids=["mesh", "drawing"])
def test_the_fidelity_alone_is_that_of_the_evidence(whole, less):
    target = target_of(whole, sw.Settings())
    assert target.fidelity(less) == target.evidence(less).value
    assert math.isnan(target.fidelity(None))
