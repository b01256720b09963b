from itertools import accumulate
from typing import Annotated

import numpy as np
import pytest
import shapely

import shapewright as sw
from shapewright import Range
from shapewright.building import Build, Workers
from shapewright.comparison.blurred import SCALES, SMALL, UNIT, BlurredDifference
from shapewright.comparison.gaps import Boundary
from shapewright.comparison.pictures import intersection_over_union, visual_information_fidelity
from shapewright.judging.drawing_target import DrawingTarget
from shapewright.judging.judge import Judge
from shapewright.judging.mesh_target import MeshTarget
from shapewright.judging.target import Measures
from shapewright.modelling.drawing import box, circle
from shapewright.modelling.solids import box as block
from shapewright.parameters import Prediction
from shapewright.rendering.ink import HALF
from shapewright.search.budgets import DRAWN, DRAWN_THOROUGH
from shapewright.search.moves import SwitchChoices
from shapewright.search.search import SearchStart, refine
from shapewright.threads import in_threads


def table(leg=0.08, height=0.7):
    side = box((leg, height), at=((1 - leg) / 2, height / 2)).mirror("x", keep=True)
    return (box((1, 0.06), at=(0, height - 0.03)) | side).drawing()


DISCS = {f"disc {i}": (circle(1) - circle(0.1 + 0.05 * i)).drawing() for i in range(2)}
REFERENCES = sw.Collection.of({"bench": table(height=0.4), "table": table(), **DISCS})


@pytest.fixture(scope="module")
def judge():
    return Judge.of(REFERENCES, sw.Settings(workers=1))


def overlaps(judge, made):
    """IoU and Chamfer distance of one build for each reference."""
    measures = judge.measures(made, judge.distances(made))
    return np.array([(each.iou, each.chamfer) for each in measures]).T


def builds(*shapes):
    return [Build({}, shape) for shape in shapes]


def test_drawings_have_targets_of_their_own(judge):
    assert all(isinstance(target, DrawingTarget) for target in judge.targets)
    meshes = Judge.of(sw.Collection.of({"a": block(1)}), sw.Settings())
    assert isinstance(meshes.targets[0], MeshTarget)


def test_distance_is_fidelity_lost(judge):
    distances = judge.distances(builds(table(height=0.4), table(), None, table(0.1)))
    assert distances[0] == pytest.approx(0.0, abs=1e-4) and np.isnan(distances[2])
    assert 0.0 < distances[3] <= judge.metric.threshold == 0.95 < distances[1]


def test_residuals_and_overlaps_are_of_areas(judge):
    same, other, mesh = judge.measure([3])([(0, table()), (0, table(0.1)), (0, block(1).mesh())])
    assert mesh is None and not same.any()
    ends = [(part.start, part.stop) for part in judge.criterion([0]).parts]
    assert [start for start, _ in ends] == [0, *(end for _, end in ends[:-1])] and ends[-1][1] == len(other)
    # Blurs keep the ink; each scale has all of it.
    ink = other.sum() / UNIT / len(SCALES) * (2 * HALF / SMALL) ** 2
    assert ink == pytest.approx(2 * 0.02 * 0.64, rel=0.1)
    iou, apart = overlaps(judge, builds(table(height=0.4), table(), None, table(0.1)))
    assert (
        iou[0] == pytest.approx(1)
        and iou[1] < 0.4
        and np.isnan(iou[2])
        and iou[3] == pytest.approx(1 - 0.0256 / 0.188, abs=0.01)
    )
    assert apart[0] < 0.001 < apart[3] < 0.01 < apart[1] and np.isnan(apart[2])


def test_misfits_are_grouped_by_outline(judge):
    groups = judge.groups(judge.grades([Measures(fidelity=value) for value in (np.nan, 0.3, 0.1, 0.49)]))
    assert {frozenset(group.members) for group in groups} >= {frozenset(DISCS)}
    assert sorted(name for group in groups for name in group.members) == sorted(REFERENCES.names)
    assert judge.groups(["replicated", "close", "replicated", "replicated"])[0].members == ("disc 0",)


def test_what_cannot_be_seen_is_never_replicated():
    thin = sw.Collection.of({"thin": shapely.box(0, 0, 1000, 0.001), "table": table()})
    judge = Judge.of(thin, sw.Settings(workers=1))
    assert np.isnan(judge.distances(builds(shapely_thin(), table()))).all()
    assert judge.groups(["replicated", "different"]) == ()


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
    judge = Judge.of(references, sw.Settings(workers=1))
    start = Prediction(desk.space, (*[np.array([0.5, 0.5])] * 3, np.full((2, 2), 0.5)))
    with Workers(desk, 1) as crew:
        found = crew.build(refine(SearchStart(start), judge.criterion([0, 1]), crew, DRAWN, seed=1))
    assert [build.parameters["bar"] for build in found] == [True, False]
    assert (overlaps(judge, found)[0] > 0.93).all()
    assert DRAWN.evaluations(3) < 250 and DRAWN.within(30, 3).evaluations(3) <= 30


@pytest.mark.parametrize("budget", [DRAWN, DRAWN_THOROUGH])
def test_whatever_else_is_tried_the_best_comes_back_by_the_finest_scale(budget):
    finest = len(SCALES) - 1
    others = [i for i, move in enumerate(budget.moves) if isinstance(move, SwitchChoices)]
    turns = (getattr(move, "scale", None) for move in budget.moves)
    scales = list(accumulate(turns, lambda before, scale: before if scale is None else scale, initial=0))[1:]
    assert others and scales[-1] == finest == max(scales)
    for start, end in zip(others, [*others[1:], len(budget.moves)], strict=True):
        assert scales[start] < finest and scales[end - 1] == finest
    assert budget.simple < budget.combinations


def test_a_drawing_measures_what_the_comparisons_measure():
    reference, replica = table(), table(0.1)
    target = DrawingTarget(reference, sw.Settings())
    measures = target.measures(replica)
    assert measures.distance == max(0.0, 1.0 - visual_information_fidelity(reference, replica))
    assert measures.iou == intersection_over_union(reference, replica)
    gaps = Boundary(reference).gaps(Boundary(replica))
    assert (measures.chamfer, measures.f1, measures.f2) == (gaps.chamfer, gaps.f_score(0.01), gaps.f_score(0.02))
    assert np.isnan([measures.volume_iou, measures.depth]).all()
    assert target.nearest(replica) == (measures.distance, 0) and target.nearest(block(1).mesh())[1] == 0
    finest = BlurredDifference(reference).residual(replica)[target.parts[-1]]
    assert target.cost(replica) == np.abs(finest).sum() > target.enough
    assert target.cost(block(1).mesh()) == np.inf


def test_a_drawing_that_cannot_be_seen_has_nothing_to_search_by():
    target = DrawingTarget(shapely_thin(), sw.Settings())
    assert not target.visible and target.objective() is None and target.cost(table()) == np.inf
    assert np.isnan(target.measures(table()).iou)


def test_any_thread_may_ask_a_drawing_first():
    replicas = [table(0.06 + 0.01 * i) for i in range(4)]
    alone = [DrawingTarget(table(), sw.Settings()).measures(replica).distance for replica in replicas]
    target = DrawingTarget(table(), sw.Settings())
    assert in_threads(lambda replica: target.measures(replica).distance, replicas, 4) == alone
