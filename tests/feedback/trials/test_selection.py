"""Which proposals are shown: those that bring something, with the Ranges that references need."""

import numpy as np
import pytest

import shapewright as sw
from shapewright.building import Workers
from shapewright.feedback.case import Replica
from shapewright.feedback.ideas.proposal import Misfit, Proposal
from shapewright.feedback.trials.change import Trials, _beyond, change_of
from shapewright.feedback.trials.outcome import Outcome
from shapewright.feedback.trials.random_shapes import RandomShapes
from shapewright.feedback.trials.selection import selected
from shapewright.feedback.writing.change import FileChange, NewLimits
from shapewright.judging.judge import Judge
from shapewright.modelling.solids import box

POST = """from typing import Annotated
from shapewright import Range, procedure
from shapewright.modelling.solids import box

@procedure
def post(height: Annotated[float, Range(0.2, 1.0)] = 0.6, depth: Annotated[float, Range(0.1, 0.3)] = 0.1):
    return box((0.5, height, depth))
"""


@pytest.fixture
def post(tmp_path):
    path = tmp_path / "post.py"
    path.write_text(POST)
    return sw.load_procedure(path)


def longer(name, high, rows):
    """A longer Range, proposed for some misfits."""
    ranges = {name: (0.1, high, 0.3)}
    return Proposal(
        "range",
        f"A wider Range of {name}",
        POST,
        lambda chosen: FileChange("post", (NewLimits(name, None, f"{chosen[name][1]:g}", None),)),
        ranges,
        {row: {} for row in rows},
        1.0,
        ends=((name, "high"),),
    )


def tall(post, heights):
    judge = Judge.of(
        sw.Collection.of({f"{h}": box((0.5, h, 0.1)).mesh() for h in heights}), sw.Settings(workers=1, judge="paper")
    )
    start = {"height": 1.0, "depth": 0.1}
    with Workers(post, 1) as crew:
        before = judge.distances(crew.build([start] * len(heights)))
    replicas = [
        Replica(row, start, post(**start), distance, apart=distance / 0.18) for row, distance in enumerate(before)
    ]
    return [Misfit(replica, replica, replica, goal=judge.goal) for replica in replicas], judge


def test_what_brings_something_is_shown_with_the_ranges_that_are_needed(post):
    misfits, judge = tall(post, (2.8, 3.2))
    assert all(15_000 * misfit.nearest.distance > judge.goal for misfit in misfits)
    ideas = [longer("depth", 0.9, (0, 1)), longer("height", 4.0, (0,))]
    known = [misfits[0].nearest]
    shown, tried = selected(post, ideas, misfits, judge, known, 400, 3)
    assert [each.proposal.title for each in shown] == ["A wider Range of height"]
    assert {one.title for one in tried} == {"A wider Range of height"} and tried[0].nearer == 2 and tried[0].best <= 1.0
    (height,) = shown
    assert height.outcome.replicated == (0, 1) and 2.0 < height.ranges["height"][1] < 4.0
    assert height.source == height.proposal.write(height.ranges)
    again, _ = selected(post, ideas, misfits, judge, known, 400, 3)
    assert again[0].outcome.parameters == height.outcome.parameters and again[0].source == height.source


def test_parameters_known_with_longer_ranges_need_no_search(post):
    misfits, judge = tall(post, (3.0,))
    (plain,) = misfits
    outside = Replica(0, {"height": 3.0, "depth": 0.1}, box((0.5, 3.0, 0.1)).mesh(), 0.0, apart=0.0)
    known = Misfit(plain.covering, plain.nearest, outside, goal=judge.goal)
    (shown,), _ = selected(post, [longer("height", 4.0, (0,))], [known], judge, [], 1, 3)
    assert shown.outcome.parameters[0] == {"height": 3.0, "depth": 0.1} and shown.outcome.apart(0) < 0.1
    assert selected(post, [longer("height", 4.0, (0,))], misfits, judge, [], 1, 3)[0] == []


def test_a_change_of_what_was_there_is_not_shown(post):
    misfits, judge = tall(post, (3.0,))
    known = [Replica(0, {"height": 0.5, "depth": 0.1}, box((0.5, 0.7, 0.1)).mesh(), 0.2)]
    assert selected(post, [longer("height", 4.0, (0,))], misfits, judge, known, 400, 3)[0] == []
    assert selected(post, [longer("breadth", 3.0, (0,))], misfits, judge, [], 400, 3)[0] == []


def test_the_way_to_a_replicated_shape():
    near, far = (Replica(0, {}, box(1.0).mesh(), 0.3, apart=apart) for apart in (1.5, np.inf))
    misfit = Misfit(near, near, near)
    assert [misfit.way(apart) for apart in (1.6, 1.5, 1.25, 1.0, 0.4)] == [0.0, 0.0, 0.5, 1.0, 1.0]
    assert Misfit(far, far, far).way(1.5) == 0.5


@pytest.mark.parametrize(
    ("aparts", "helped", "value"),
    [
        ([2.0] * 4 + [1.8] * 4, (4, 5, 6, 7), 0.8),  # half of them come a fifth of the way
        ([2.0] * 7 + [1.3], (7,), 0.7),  # one comes near
        ([1.8] * 3 + [2.0] * 5, None, 0.0),  # three come a little nearer: by chance
        ([2.0] * 4 + [1.97] * 4, None, 0.0),  # so little that it says nothing
        ([1.8] * 4 + [2.0] * 16, None, 0.0),  # few of many
        ([1.9] * 4 + [2.0] * 4, None, 0.0),  # a tenth of the way for half: too little to be read
    ],
)
def test_a_step_that_carries_nobody_all_the_way_is_worth_showing_where_many_come_nearer(post, aparts, helped, value):
    changes = changed(trials_of(post, len(aparts)), aparts)
    assert [change.helped for change in changes] == ([] if helped is None else [helped])
    assert [change.value for change in changes] == ([] if helped is None else [pytest.approx(value)])


@pytest.mark.parametrize(
    ("first", "second", "more"),
    [
        ([1.0, 1.0, 2.0], [1.0, 1.0, 2.0], 0.0),  # the same
        ([1.0, 1.3, 2.0], [1.1, 1.0, 2.0], 0.3),  # one comes nearer, the other less near
        ([1.0, 2.0, 2.0], [2.0, 1.0, 1.5], 1.5),  # others
        ([1.5, 1.8, 1.5], [2.0, 1.0, 2.0], 1.0),  # what the first does not help, by its count
    ],
)
def test_a_second_suggestion_brings_what_the_first_does_not(post, first, second, more):
    trials = trials_of(post, 3)
    (one,), (other,) = changed(trials, first), changed(trials, second)
    assert _beyond(trials, other, [one]) == pytest.approx(more)
    assert _beyond(trials, other, [one, other]) == pytest.approx(0.0)


def trials_of(post, count):
    start = {"height": 1.0, "depth": 0.1}
    before = [Replica(row, start, box(1.0).mesh(), 0.3, apart=2.0) for row in range(count)]
    _, judge = tall(post, (3.0,))
    with Workers(post, 1) as crew:
        misfits = [Misfit(replica, replica, replica) for replica in before]
        return Trials(post.space, crew, misfits, judge, RandomShapes.of(crew, 0))


def changed(trials, aparts):
    """A longer Range with which the references lie so far apart."""
    later = {"height": 2.0, "depth": 0.1}
    outcome = Outcome.of(Replica(row, later, box(1.0).mesh(), 0.3, apart=apart) for row, apart in enumerate(aparts))
    return list(change_of(trials, longer("height", 4.0, range(len(aparts))), outcome))
