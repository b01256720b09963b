import numpy as np
import pytest
import shapely

import shapewright as sw
from shapewright.building import Build
from shapewright.judge import Judge, judge_of
from shapewright.modelling.drawing import box, circle
from shapewright.modelling.solids import box as block
from shapewright.picture_judge import SMALL, UNIT, PictureJudge
from shapewright.rendering.ink import HALF


def table(leg=0.08, height=0.7):
    side = box((leg, height), at=((1 - leg) / 2, height / 2)).mirror("x", keep=True)
    return (box((1, 0.06), at=(0, height - 0.03)) | side).drawing()


DISCS = {f"disc {i}": (circle(1) - circle(0.1 + 0.05 * i)).drawing() for i in range(2)}
REFERENCES = sw.Collection.of({"bench": table(height=0.4), "table": table(), **DISCS})


@pytest.fixture(scope="module")
def judge():
    return judge_of(REFERENCES, sw.Settings(workers=1))


def builds(*shapes):
    return [Build({}, shape) for shape in shapes]


def test_drawings_have_a_judge_of_their_own():
    assert isinstance(judge_of(REFERENCES, sw.Settings()), PictureJudge)
    assert isinstance(judge_of(sw.Collection.of({"a": block(1)}), sw.Settings()), Judge)


def test_distance_is_fidelity_lost(judge):
    distances = judge.distances(builds(table(height=0.4), table(), None, table(0.1)))
    assert distances[0] == pytest.approx(0.0, abs=1e-4) and np.isnan(distances[2])
    assert 0.0 < distances[3] <= judge.metric.threshold == 0.95 < distances[1]


def test_residuals_and_overlaps_are_of_areas(judge):
    same, other, mesh = judge.search_residuals([(3, table()), (3, table(0.1)), (3, block(1).mesh())])
    assert mesh is None and not same.any()
    pixels = np.abs(other).sum() / UNIT * (2 * HALF / SMALL) ** 2
    assert pixels == pytest.approx(2 * 0.02 * 0.64, rel=0.06)
    iou, surface = judge.overlaps(builds(table(height=0.4), table(), None, table(0.1)))
    assert (
        iou[0] == pytest.approx(1)
        and iou[1] < 0.4
        and np.isnan(iou[2])
        and iou[3] == pytest.approx(1 - 0.0256 / 0.188, abs=0.01)
    )
    assert np.isnan(surface).all()


def test_misfits_are_grouped_by_outline(judge):
    nothing = (np.full(4, np.nan), judge.depths([None] * 4))
    groups = judge.groups(judge.compatible(np.array([np.nan, 0.99, 0.99, 0.99]), *nothing))
    assert {frozenset(group.members) for group in groups} >= {frozenset(DISCS)}
    assert sorted(name for group in groups for name in group.members) == sorted(REFERENCES.names)
    assert judge.groups(judge.compatible(np.array([0.1, 0.99, 0.3, 0.2]), *nothing))[0].members == ("disc 0",)


def test_what_cannot_be_seen_is_never_replicated():
    thin = sw.Collection.of({"thin": shapely.box(0, 0, 1000, 0.001), "table": table()})
    judge = judge_of(thin, sw.Settings(workers=1))
    assert np.isnan(judge.distances(builds(shapely_thin(), table()))).all()
    assert judge.groups(np.array([True, False])) == ()


def shapely_thin():
    return sw.Drawing(shapely.box(0, 0, 1000, 0.001))
