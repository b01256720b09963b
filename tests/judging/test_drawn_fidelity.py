"""The judge of drawings: one value, and where the two differ."""

import math

import shapewright as sw
from shapewright.judging.drawn_fidelity import DrawnFidelity
from shapewright.modelling import solids
from shapewright.modelling.drawing import box
from shapewright.threads import in_threads

TOP, LEG = box((1, 0.06), at=(0, 0.57)), box((0.06, 0.6), at=(0.45, 0.3))
TABLE, ONE_LEG = (TOP | LEG.mirror("x", keep=True)).drawing(), (TOP | LEG).drawing()


def test_the_region_is_where_the_leg_is():
    region = sw.fidelity(ONE_LEG, TABLE).missing[0]
    assert region.low[0] < -0.45 and region.high[0] < -0.35 and 0.5 < region.size < 0.6


def test_a_mesh_is_no_evidence():
    judge = DrawnFidelity(TABLE)
    assert math.isnan(judge.evidence(None).value) and math.isnan(judge.evidence(solids.box(1).mesh()).value)


def test_any_thread_may_ask_of_a_drawing_first():
    judge, replicas = DrawnFidelity(TABLE), [TABLE, ONE_LEG, TABLE, ONE_LEG]
    assert in_threads(judge.evidence, replicas, 4) == [DrawnFidelity(TABLE).evidence(replica) for replica in replicas]
