import pytest

from shapewright.progress import Progress, Stages


def test_every_stage_is_told_from_its_start_to_its_end():
    told = []
    stages = Stages(told.append)
    stages.begin("sample", 3)
    stages.begin("train", 2)
    for epoch in (1, 2):
        stages.step(epoch, 2, f"epoch {epoch}")
    stages.end()
    assert [(event.stage, event.done, event.total) for event in told if event.done in (0, event.total)] == [
        ("sample", 0, 3),
        ("sample", 3, 3),
        ("train", 0, 2),
        ("train", 2, 2),
    ]
    assert list(stages.seconds) == ["sample", "train"] and str(told[-1]) == "train 2/2 epoch 2"


def test_steps_in_quick_succession_are_told_once():
    told = []
    stages = Stages(told.append)
    stages.begin("sample", 1000)
    for done in range(1, 1000):
        stages.step(done, 1000)
    assert len(told) < 10


def test_a_stage_that_comes_again_adds_up_and_an_answer_is_never_held_back():
    told = []
    stages = Stages(told.append)
    for _ in range(2):
        stages.begin("train", 1)
        stages.answer({"a": {"height": 1.0}}, "predicted")
    stages.end()
    assert list(stages.seconds) == ["train"]
    answers = [event for event in told if event.answer]
    assert len(answers) == 2 and answers[0] == Progress(
        "train", 1, 1, "predicted", {"a": {"height": 1.0}}, answer_kind="predicted"
    )
    assert stages.first_answer is not None and stages.first_answer >= 0.0


def test_what_is_left_goes_by_the_shares_of_the_stages(monkeypatch):
    told, clock = [], iter([1.0, 1.0, 1.0, 11.0, 11.0, 11.0, 11.0, 16.0])
    monkeypatch.setattr("time.perf_counter", lambda: next(clock))
    stages = Stages(told.append, {"causes": 0.5, "trials": 0.5})
    stages.begin("causes", 1)
    stages.begin("trials", 2)
    stages.step(1, 2)
    assert [event.left for event in told] == [None, 10.0, 10.0, pytest.approx(5.0)]


def test_without_shares_nobody_knows_what_is_left():
    told = []
    stages = Stages(told.append)
    stages.begin("causes", 2)
    stages.step(2, 2)
    assert told[-1].left is None


def test_without_a_listener_seconds_are_kept():
    stages = Stages(None)
    stages.begin("sample", 1)
    stages.answer({}, "predicted")
    stages.end()
    assert stages.seconds["sample"] >= 0.0
