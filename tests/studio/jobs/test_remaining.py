"""How long work takes still, by what its stages took the last time."""

from __future__ import annotations

import pytest

from shapewright.studio.jobs.remaining import left
from shapewright.studio.jobs.sweeps import Sweeps
from shapewright.studio.project.timings import Timings, Took
from shapewright.studio.project.workspace import Project
from shapewright.studio.wire.work import JobStage, Sweep
from studio_client import PROCEDURE

USUAL = {"open": Took(4.0, 3), "sample": Took(10.0, 200), "train": Took(20.0, 10), "save": Took(1.0, 1)}


def stage(name: str, done: int, total: int, seconds: float) -> JobStage:
    return JobStage(name=name, done=done, total=total, remark="", seconds=seconds)


def test_nothing_is_said_without_an_earlier_time() -> None:
    assert left([stage("open", 1, 3, 2.0)], {}) is None


def test_before_anything_is_done_it_is_the_time_of_before() -> None:
    assert left([], USUAL) == left([stage("open", 0, 3, 0.0)], USUAL) == 35.0


def test_what_is_done_is_done() -> None:
    stages = [stage("open", 3, 3, 4.0), stage("sample", 100, 200, 5.0)]
    assert left(stages, USUAL) == pytest.approx(5.0 + 20.0 + 1.0)
    assert left([*stages, stage("save", 1, 1, 1.0)], USUAL) == 0.0


def test_a_stage_of_more_steps_takes_longer() -> None:
    begun = [stage("open", 3, 3, 4.0), stage("sample", 0, 1000, 0.0)]
    assert left(begun, USUAL) == pytest.approx(50.0 + 20.0 + 1.0)


def test_a_slow_machine_is_slow_in_what_follows_too() -> None:
    stages = [stage("open", 3, 3, 8.0), stage("sample", 200, 200, 20.0), stage("train", 0, 10, 0.0)]
    assert left(stages, USUAL) == pytest.approx(2.0 * 21.0)


def test_a_stage_that_nobody_knows_adds_nothing_and_takes_nothing_away() -> None:
    assert left([stage("axes", 1, 2, 3.0)], USUAL) == pytest.approx(3.0 + 35.0)


def test_it_is_never_less_than_nothing() -> None:
    late = [stage("open", 3, 3, 4.0), stage("sample", 1, 200, 500.0)]
    assert (left(late, USUAL) or 0.0) >= 21.0


def test_a_sweep_is_counted_twice_over_and_the_next_one_knows_how_long_it_takes(tmp_path) -> None:  # type: ignore[no-untyped-def]
    (tmp_path / "procedure.py").write_text(PROCEDURE)
    told: list[Sweep | None] = []
    timings = Timings(Project.of(tmp_path))
    sweeps = Sweeps(timings, told.append)
    sweeps.begin(7, 3)
    assert told == [sweeps.sweep()] or told[0] is not None
    for number in (6, 7, 7, 7):
        sweeps.step(number, measured=False)
    shown = sweeps.sweep()
    assert shown and (shown.done, shown.total, shown.left) == (3, 6, None)
    for _ in range(5):
        sweeps.step(7, measured=True)
    shown = sweeps.sweep()
    assert shown and shown.done == 6
    sweeps.end(6)
    assert sweeps.sweep()
    sweeps.end(7)
    assert sweeps.sweep() is None and told[-1] is None
    assert [took.total for took in timings.of("sweep").values()] == [3, 3]
    sweeps.begin(8, 3)
    shown = sweeps.sweep()
    assert shown and shown.left is not None
    sweeps.begin(9, 0)
    assert sweeps.sweep() is None
