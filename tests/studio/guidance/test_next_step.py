"""What a run leaves to do, as facts."""

from __future__ import annotations

from typing import Any

from shapewright.studio.guidance.next_step import next_step
from shapewright.studio.session.board import Board, ReferenceState
from shapewright.studio.wire.collection import Group
from shapewright.studio.wire.detail import BestChange
from shapewright.studio.wire.judgement import Grade, Piece


def one(slug: str, grade: Grade, *missing: float, replica: str | None = "/api/pictures/1.png") -> ReferenceState:
    box = (0.0, 0.0, 0.0)
    pieces = [Piece(size=size, low=box, high=box, share=0.1) for size in missing]
    return ReferenceState(slug, slug, grade=grade, replica=replica, missing=pieces)


def board(*states: ReferenceState, groups: tuple[Group, ...] = ()) -> Board:
    return Board({state.slug: state for state in states}, groups)


MISFITS = board(
    one("a", "replicated"),
    one("b", "different", 0.3, 0.1),
    one("c", "close", 0.9),
    one("d", "different", 0.2),
    groups=(Group(representative="c", members=["c", "a"]), Group(representative="b", members=["b", "d"])),
)


def test_the_largest_group_is_of_those_that_are_not_replicated_by_now() -> None:
    found = next_step(MISFITS, {})
    assert (found.group, found.members, found.lacks) == ("b", 2, 0.3)
    assert (found.longest, found.length, found.best) == ("c", 0.9, None)


def test_nothing_is_left_where_all_are_replicated() -> None:
    found = next_step(board(one("a", "replicated"), one("b", "replicated", 0.5)), {})
    assert (found.group, found.members, found.longest, found.length) == (None, 0, None, None)


def test_a_representative_that_is_replicated_by_another_cut_gives_way() -> None:
    found = next_step(
        board(one("a", "replicated"), one("b", "close", 0.2), groups=(Group(representative="a", members=["a", "b"]),)),
        {},
    )
    assert (found.group, found.members) == ("b", 1)


def test_references_without_replicas_are_no_misfits_yet() -> None:
    assert next_step(board(one("a", "different", replica=None)), {}).group is None


def test_the_best_change_is_the_first_suggestion_or_the_nearest_trial() -> None:
    suggestions: list[dict[str, Any]] = [{"title": "Add a shelf", "gain": 3, "tried": {"nearer": 2}}, {"title": "x"}]
    found = next_step(MISFITS, {"suggestions": suggestions}).best
    assert found == BestChange(title="Add a shelf", gain=3, nearer=5, suggestion=0)
    tried = [
        {"title": "far", "nearer": 9, "best": 3.0},
        {"title": "near", "nearer": 1, "best": 1.2},
        {"title": "none", "nearer": 0, "best": None},
    ]
    found = next_step(MISFITS, {"suggestions": [], "tried": tried}).best
    assert found == BestChange(title="near", gain=0, nearer=1, suggestion=None)
    assert next_step(MISFITS, {"tried": [tried[2]]}).best is None
