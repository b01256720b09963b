import pytest

import shapewright as sw
from shapewright.building import Workers
from shapewright.feedback.case import Replica
from shapewright.feedback.trials.attempt import (
    BRIEF,
    LONG,
    OTHER_CHOICES,
    builds_the_same,
    nearest_starts,
    outcome_of,
    turned_to,
    with_borrowed_choices,
)
from shapewright.feedback.trials.outcome import Outcome
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
def crew(post):
    with Workers(post, 1) as workers:
        yield workers


@pytest.fixture
def judge():
    shapes = {"low": box((0.5, 0.5, 0.1)).mesh(), "tall": box((0.5, 3.0, 0.1)).mesh()}
    return Judge.of(sw.Collection.of(shapes), sw.Settings(workers=1, judge="paper"))


START = {"height": 0.8, "wide": False}


def distances(outcome):
    return {row: outcome.apart(row) for row in outcome.counted}


def test_a_trial_searches_each_reference_and_judges_it(judge, crew):
    first = outcome_of(crew, {0: START, 1: START}, judge, LONG)
    again = outcome_of(crew, {0: START, 1: START}, judge, LONG)
    only = outcome_of(crew, {1: START}, judge, None)
    assert first.parameters == again.parameters and distances(first) == distances(again)
    assert first.replicated == (0,) and first.apart(1) < only.apart(1)
    assert only.parameters == {1: START} and first.parameters[1]["height"] > 0.95
    assert distances(only.joined(first)) == distances(first)


def test_a_search_may_leave_some_scalars_as_they_are(judge, crew):
    start = {"height": 0.3, "wide": True}
    source = POST.replace("0.1))", "depth))").replace(
        "False)", "False, depth: Annotated[float, Range(0.05, 1.0)] = 0.3)"
    )
    with turned_to(source, crew):
        found = outcome_of(crew, {0: start}, judge, LONG, only=["height"])
        both = outcome_of(crew, {0: start}, judge, LONG)
    assert found.parameters[0]["depth"] == pytest.approx(0.3) and found.parameters[0]["height"] > 0.35
    assert both.apart(0) <= found.apart(0)


def test_a_search_keeps_a_choice_that_it_is_sure_of(crew):
    deep = Judge.of(sw.Collection.of({"deep": box((0.5, 0.5, 0.2)).mesh()}), sw.Settings(workers=1, judge="paper"))
    free = outcome_of(crew, {0: START}, deep, OTHER_CHOICES)
    sure = outcome_of(crew, {0: START}, deep, OTHER_CHOICES, sure="wide")
    assert free.parameters[0]["wide"] is True and sure.parameters[0]["wide"] is False
    assert free.apart(0) < sure.apart(0)
    assert distances(free.using(lambda values: not values["wide"])) == {}
    assert distances(sure.using(lambda values: not values["wide"])) == distances(sure)


def test_the_nearest_candidate_is_where_a_search_begins(post, judge, crew):
    candidates = {0: [START, {**START, "height": 0.5}], 1: [{**START, "height": 9.0}]}
    starts = nearest_starts(crew, candidates, judge, dict.fromkeys(candidates, 1))
    assert starts.parameters[0]["height"] == 0.5 and starts.parameters[1]["height"] == 1.0
    assert starts.apart(0) < 1.0 < starts.apart(1)
    (cost,) = judge.search_costs([(1, starts.replicas[1].mesh)])
    assert starts.replicated == (0,) and starts.apart(1) == cost / judge.goal
    assert with_borrowed_choices(post.space, starts, {0: START, 1: {**START, "wide": True}}) == {
        1: [{"height": 0.5, "wide": False}, {"height": 0.8, "wide": False}]
    }


def test_a_changed_procedure_finds_what_lies_beside_the_author_s_file(crew, post):
    beside = post.path.parent
    (beside / "tables").mkdir()
    (beside / "tables" / "depth.txt").write_text("0.3")
    reading = "float((__import__('pathlib').Path(__file__).parent / 'tables' / 'depth.txt').read_text())"
    for _ in range(2):  # the second trial follows one whose folder is gone
        with turned_to(POST.replace("0.2 if wide else 0.1", reading), crew):
            (build,) = crew.build([START])
        assert build.shape.extent == pytest.approx([0.5, 0.8, 0.3]) and (beside / "tables" / "depth.txt").exists()


def test_a_changed_procedure_lives_as_long_as_the_trial(judge, crew):
    with turned_to(POST.replace("1.0)]", "4.0)]"), crew):
        path = crew.procedure.path
        found = outcome_of(crew, {1: START}, judge, LONG)
        assert found.replicated == (1,) and found.parameters[1]["height"] > 1.5 and path.exists()
    assert not path.exists()
    with pytest.raises(ProcedureError), turned_to("nothing here", crew):
        pass


def test_what_was_built_before_stays_as_it_was(post, crew):
    known = [Replica(0, START, post(**START), 0.1)]
    assert builds_the_same(crew, known)
    with turned_to(POST.replace("0.1))", "0.15))"), crew):
        assert not builds_the_same(crew, known)
    with turned_to(POST.replace("return box", "return box((0.1, height / 2, 0.05)) | box"), crew):
        assert builds_the_same(crew, known)
    with turned_to(POST.replace("return box", "raise ValueError; return box"), crew):
        assert not builds_the_same(crew, known)


CHOICE = POST.replace("wide: bool = False", "wide: bool = False, round: bool = False").replace(
    "return box", "return cylinder((0.5, height, 0.5)) if round else box"
)


def test_references_lend_each_other_their_choices(crew):
    shapes = {f"column{height}": cylinder((0.5, height, 0.5)).mesh() for height in (0.4, 0.9)}
    judge = Judge.of(sw.Collection.of(shapes), sw.Settings(workers=1, judge="paper"))
    with turned_to(CHOICE.replace("import box", "import box, cylinder"), crew):
        starts = {0: {**START, "round": True}, 1: {**START, "round": False}}
        alone = outcome_of(crew, starts, judge, BRIEF)
        far = Replica(1, alone.parameters[1], alone.replicas[1].mesh, 0.5)
        alone = Outcome.of([alone.replicas[0], far])
        begin = nearest_starts(crew, with_borrowed_choices(crew.procedure.space, alone, starts), judge, {1: 1})
        assert begin.counted == (1,) and begin.parameters[1]["round"]
        together = alone.joined(outcome_of(crew, begin.parameters, judge, LONG))
        assert with_borrowed_choices(crew.procedure.space, Outcome.of([]), starts) == {}
    assert alone.replicated == (0,) and together.replicated == (0, 1)
    assert together.parameters[1]["round"] and together.parameters[0] == alone.parameters[0]


def test_a_candidate_that_falls_apart_gives_way_to_one_that_stands(judge, crew):
    source = POST.replace("return box", "lower = box((0.5, 0.2, 0.1), at=(0, -3, 0))\n    return lower | box").replace(
        "0.2 if wide else 0.1))", "0.1), at=(0, 0, 0) if wide else (0, -2.9 + height / 2, 0))"
    )
    apart, whole = {"height": 0.8, "wide": True}, {"height": 0.4, "wide": False}
    with turned_to(source, crew):
        several = nearest_starts(crew, {1: [apart, whole]}, judge, {1: 1})
        cheapest = nearest_starts(crew, {1: [apart]}, judge, {1: 1})
        falling = nearest_starts(crew, {1: [apart, whole]}, judge, {1: 2})
    assert several.parameters[1] == whole and falling.parameters[1] == apart
    assert several.apart(1) > cheapest.apart(1)


def test_replicas_that_fall_apart_do_not_count():
    whole, apart = box(1.0).mesh(), box(1.0).array(2, (3, 0, 0)).mesh()
    outcome = Outcome.of(Replica(row, {}, mesh, 0.1, apart=0.5) for row, mesh in enumerate((whole, apart, apart)))
    assert outcome.whole({0: 1, 1: 1, 2: 2}).replicated == (0, 2)
