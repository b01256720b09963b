from typing import Annotated

import numpy as np
import pytest
import shapely

import shapewright as sw
from shapewright import Range
from shapewright.building import Build, Workers
from shapewright.judging.judge import Judge, judge_of
from shapewright.judging.picture_judge import SCALES, SMALL, UNIT, PictureJudge
from shapewright.modelling.drawing import box, circle
from shapewright.modelling.solids import box as block
from shapewright.rendering.ink import HALF
from shapewright.search.drawing_budgets import DRAWN, DRAWN_THOROUGH
from shapewright.search.search import refine


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
    same, other, mesh = judge.measure([3])([(0, table()), (0, table(0.1)), (0, block(1).mesh())])
    assert mesh is None and not same.any()
    ends = [(part.start, part.stop) for part in judge.search_parts]
    assert [start for start, _ in ends] == [0, *(end for _, end in ends[:-1])] and ends[-1][1] == len(other)
    # Blurs keep the ink; each scale has all of it.
    ink = other.sum() / UNIT / len(SCALES) * (2 * HALF / SMALL) ** 2
    assert ink == pytest.approx(2 * 0.02 * 0.64, rel=0.1)
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


@sw.procedure
def desk(
    height: Annotated[float, Range(0.3, 1.0)] = 0.6,
    leg: Annotated[float, Range(0.02, 0.15)] = 0.1,
    inset: Annotated[float, Range(0.0, 0.25)] = 0.0,
    bar: bool = False,
):
    side = box((leg, height), at=(0.5 - inset - leg / 2, height / 2)).mirror("x", keep=True)
    shape = box((1, 0.06), at=(0, height - 0.03)) | side
    return shape | box((1 - 2 * inset - leg, 0.05), at=(0, height / 3)) if bar else shape


def test_a_search_finds_thin_legs_that_nothing_overlaps_at_first():
    truth = [
        {"height": 0.85, "leg": 0.03, "inset": 0.05, "bar": True},
        {"height": 0.45, "leg": 0.05, "inset": 0.2, "bar": False},
    ]
    references = sw.Collection.of({str(i): desk(**values) for i, values in enumerate(truth)})
    judge = judge_of(references, sw.Settings(workers=1))
    start = [np.array([0.5, 0.5]), np.array([0.5, 0.5]), np.array([0.5, 0.5]), np.full((2, 2), 0.5)]
    with Workers(desk, 1) as crew:
        found = crew.build(
            refine(desk.space, start, crew, judge.measure([0, 1]), DRAWN, seed=1, parts=judge.search_parts)
        )
    assert [build.parameters["bar"] for build in found] == [True, False]
    assert (judge.overlaps(found)[0] > 0.93).all()
    assert DRAWN.evaluations(3) < 250 and DRAWN.within(30, 3).evaluations(3) <= 30


@pytest.mark.parametrize("budget", [DRAWN, DRAWN_THOROUGH])
def test_whatever_else_is_tried_the_best_comes_back_by_the_finest_scale(budget):
    finest = len(SCALES) - 1
    others = [i for i, turn in enumerate(budget.rounds) if turn.other]
    assert others and budget.rounds[-1].part == finest == max(turn.part for turn in budget.rounds)
    for start, end in zip(others, [*others[1:], len(budget.rounds)], strict=True):
        assert budget.rounds[start].part < finest and budget.rounds[end - 1].part == finest
    assert budget.simple < budget.rounds[0].combinations
