import pytest

import shapewright as sw
from shapewright.building import Workers
from shapewright.feedback.trials.trial import GLANCE, LOOK, SEARCH, Trial, begun, changed, mixtures, tried, unchanged
from shapewright.judging.judge import Judge
from shapewright.modelling.solids import box, cylinder
from shapewright.procedures import ProcedureError

POST = """from typing import Annotated
from shapewright import Range, procedure
from shapewright.modelling.solids import box

@procedure
def post(height: Annotated[float, Range(0.2, 1.0)] = 0.6, wide: bool = False):
    return box((0.5, height, 0.2 if wide else 0.1))
"""


@pytest.fixture
def post(tmp_path):
    path = tmp_path / "post.py"
    path.write_text(POST)
    return sw.load_procedure(path)


@pytest.fixture
def judge():
    shapes = {"low": box((0.5, 0.5, 0.1)).mesh(), "tall": box((0.5, 3.0, 0.1)).mesh()}
    return Judge.of(sw.Collection.of(shapes), sw.Settings(workers=1))


START = {"height": 0.8, "wide": False}


def test_a_trial_searches_each_reference_and_judges_it(post, judge):
    with Workers(post, 1) as crew:
        first = tried(crew, {0: START, 1: START}, judge, SEARCH)
        again = tried(crew, {0: START, 1: START}, judge, SEARCH)
        only = tried(crew, {1: START}, judge, None)
    assert first.parameters == again.parameters and first.distances == again.distances
    assert first.compatible == (0,) and first.distances[1] < only.distances[1]
    assert only.parameters == {1: START} and first.parameters[1]["height"] > 0.95
    assert only.joined(first).distances == first.distances


def test_a_search_may_leave_some_scalars_as_they_are(post, judge):
    start = {"height": 0.3, "wide": True}
    with changed(
        POST.replace("0.1))", "depth))").replace("False)", "False, depth: Annotated[float, Range(0.05, 1.0)] = 0.3)"),
        post,
        judge,
    ) as crew:
        found = tried(crew, {0: start}, judge, SEARCH, only=["height"])
        both = tried(crew, {0: start}, judge, SEARCH)
    assert found.parameters[0]["depth"] == pytest.approx(0.3) and found.parameters[0]["height"] > 0.35
    assert both.distances[0] <= found.distances[0]


def test_a_search_keeps_a_choice_that_it_is_sure_of(post):
    deep = Judge.of(sw.Collection.of({"deep": box((0.5, 0.5, 0.2)).mesh()}), sw.Settings(workers=1))
    with Workers(post, 1) as crew:
        free = tried(crew, {0: START}, deep, LOOK)
        sure = tried(crew, {0: START}, deep, LOOK, sure="wide")
    assert free.parameters[0]["wide"] is True and sure.parameters[0]["wide"] is False
    assert free.distances[0] < sure.distances[0]
    assert free.where(lambda values: not values["wide"]).distances == {}
    assert sure.where(lambda values: not values["wide"]).distances == sure.distances


def test_the_nearest_candidate_is_where_a_search_begins(post, judge):
    with Workers(post, 1) as crew:
        candidates = {0: [START, {**START, "height": 0.5}], 1: [{**START, "height": 9.0}]}
        starts = begun(crew, candidates, judge, dict.fromkeys(candidates, 1))
    assert starts[0].parameters["height"] == 0.5 and starts[1].parameters["height"] == 1.0
    assert starts[0].cost < 0.18 * 15_000 < starts[1].cost
    trial = Trial.of(starts, 0.18)
    assert trial.compatible == (0,) and trial.distances[1] == starts[1].cost / 15_000
    assert mixtures(post.space, trial, {0: START, 1: {**START, "wide": True}}) == {
        1: [{"height": 0.5, "wide": False}, {"height": 0.8, "wide": False}]
    }


def test_a_changed_procedure_lives_as_long_as_the_trial(post, judge):
    with changed(POST.replace("1.0)]", "4.0)]"), post, judge) as crew:
        path = crew.procedure.path
        found = tried(crew, {1: START}, judge, SEARCH)
        assert found.compatible == (1,) and found.parameters[1]["height"] > 1.5 and path.exists()
    assert not path.exists()
    with pytest.raises(ProcedureError), changed("nothing here", post, judge):
        pass


def test_what_was_built_before_stays_as_it_was(post, judge):
    known = [(START, post(**START))]
    with Workers(post, 1) as crew:
        assert unchanged(crew, known)
    with changed(POST.replace("0.1))", "0.15))"), post, judge) as crew:
        assert not unchanged(crew, known)
    with changed(POST.replace("return box", "return box((0.1, height / 2, 0.05)) | box"), post, judge) as crew:
        assert unchanged(crew, known)
    with changed(POST.replace("return box", "raise ValueError; return box"), post, judge) as crew:
        assert not unchanged(crew, known)


CHOICE = POST.replace("wide: bool = False", "wide: bool = False, round: bool = False").replace(
    "return box", "return cylinder((0.5, height, 0.5)) if round else box"
)


def test_references_lend_each_other_their_choices(post):
    shapes = {f"column{height}": cylinder((0.5, height, 0.5)).mesh() for height in (0.4, 0.9)}
    judge = Judge.of(sw.Collection.of(shapes), sw.Settings(workers=1))
    with changed(CHOICE.replace("import box", "import box, cylinder"), post, judge) as crew:
        starts = {0: {**START, "round": True}, 1: {**START, "round": False}}
        alone = tried(crew, starts, judge, GLANCE)
        alone = Trial(alone.parameters, alone.replicas, {**alone.distances, 1: 0.5}, alone.threshold)
        begin = begun(crew, mixtures(crew.procedure.space, alone, starts), judge, {1: 1})
        assert list(begin) == [1] and begin[1].parameters["round"]
        together = alone.joined(tried(crew, {1: begin[1].parameters}, judge, SEARCH))
        assert mixtures(crew.procedure.space, Trial({}, {}, {}, 0.18), starts) == {}
    assert alone.compatible == (0,) and together.compatible == (0, 1)
    assert together.parameters[1]["round"] and together.parameters[0] == alone.parameters[0]


def test_a_candidate_that_falls_apart_gives_way_to_one_that_stands(post, judge):
    source = POST.replace("return box", "lower = box((0.5, 0.2, 0.1), at=(0, -3, 0))\n    return lower | box").replace(
        "0.2 if wide else 0.1))", "0.1), at=(0, 0, 0) if wide else (0, -2.9 + height / 2, 0))"
    )
    apart, whole = {"height": 0.8, "wide": True}, {"height": 0.4, "wide": False}
    with changed(source, post, judge) as crew:
        several = begun(crew, {1: [apart, whole]}, judge, {1: 1})
        (cheapest,) = begun(crew, {1: [apart]}, judge, {1: 1}).values()
        falling = begun(crew, {1: [apart, whole]}, judge, {1: 2})
    assert several[1].parameters == whole and falling[1].parameters == apart and several[1].cost > cheapest.cost


def test_replicas_that_fall_apart_do_not_count():
    whole, apart = box(1.0).mesh(), box(1.0).array(2, (3, 0, 0)).mesh()
    trial = Trial({0: {}, 1: {}, 2: {}}, {0: whole, 1: apart, 2: apart}, {0: 0.1, 1: 0.1, 2: 0.1}, 0.18)
    assert trial.standing({0: 1, 1: 1, 2: 2}).compatible == (0, 2)
