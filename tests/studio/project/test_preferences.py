import msgspec
import pytest

from shapewright.settings import Settings, described
from shapewright.studio.project.preferences import SHAPE_SECONDS, Preferences


def test_the_page_gets_its_own_entries_and_some_settings():
    record = msgspec.to_builtins(Preferences().message())
    assert list(record)[:4] == ["auto_fit", "fresh", "scale", "preset"] and record["shape_seconds"] == SHAPE_SECONDS
    assert set(record) == set(Preferences.described()) and record["samples"] == Settings.samples
    assert all(Preferences.described()[name] == described()[name] for name in record if name in described())


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"refine": "much"}, "refine='much' must be off, quick or thorough"),
        ({"samples": 3}, "samples=3 must be a whole number, at least 20"),
        ({"auto_fit": 1}, "auto_fit=1 must be True or False"),
        ({"preset": "papr"}, "preset='papr' must be fast or paper; did you mean paper?"),
        ({"rfine": "off"}, "there is no setting 'rfine'; did you mean refine?"),
        ({"workers": 2}, "there is no setting 'workers'"),
        ({"judge": "eye"}, "judge='eye' must be fidelity or paper"),
        ({"replicated": 1.0}, "replicated=1.0 must be a finite number, greater than 0 and less than 1"),
        ({"vif": 0}, "vif=0 must be a finite number, greater than 0 and less than 1"),
        ({"replicated": 0.1}, "close=0.35 must be at most replicated=0.1"),
    ],
)
def test_what_a_setting_does_not_allow_is_refused(given, message):
    with pytest.raises(ValueError) as error:
        Preferences().changed(given)
    assert str(error.value) == message


def test_what_is_left_out_and_dropped_is_chosen_in_the_page_and_stays_with_another_preset():
    chosen = Preferences().changed({"leave_out": "a, b*", "drop": "nothing"})
    assert (chosen.settings.patterns, chosen.settings.dropped) == (("a", "b*"), ())
    assert chosen.changed({"preset": "paper"}).message().leave_out == "a, b*"


def test_another_preset_keeps_what_no_preset_says():
    before = Preferences(settings=Settings(workers=2)).changed({"threshold": 0.2, "seed": 3, "epochs": 4, "rounds": 2})
    paper = before.changed({"preset": "paper", "samples": 500})
    assert (paper.preset, paper.settings.network, paper.settings.samples) == ("paper", "vgg19", 500)
    assert (paper.settings.threshold, paper.settings.seed, paper.settings.workers) == (0.2, 3, 2)
    assert (paper.settings.epochs, paper.settings.rounds) == (50, 0)
    assert (before.settings.judge, paper.settings.judge) == ("fidelity", "paper")
    assert paper.changed({"preset": "fast"}).settings.judge == "fidelity"
    assert before.changed({"preset": "fast", "fresh": True}).settings == before.settings


def test_what_was_chosen_in_the_page_is_taken_up_and_the_command_line_goes_before_it():
    kept = Preferences().changed({"epochs": 7, "replicated": 0.2, "close": 0.1}).changed({"auto_fit": False}).chosen
    assert kept == {"epochs": 7, "replicated": 0.2, "close": 0.1, "auto_fit": False}
    opened = Preferences.at_start(kept, {"epochs": 9, "workers": 2})
    assert (opened.settings.epochs, opened.settings.workers, opened.auto_fit) == (9, 2, False)
    assert (opened.settings.replicated, opened.settings.close) == (0.2, 0.1)
    assert opened.settings.shape_seconds == SHAPE_SECONDS
    assert Preferences.at_start({}, {"auto_fit": False}).auto_fit is False


def test_what_cannot_be_any_more_is_passed_over():
    opened = Preferences.at_start({"epochs": 7, "colour": "red", "samples": "many"}, {})
    assert opened.settings.epochs == 7 and opened.settings.samples == Settings.samples


def test_a_preset_of_the_command_line_brings_its_own_settings():
    kept = Preferences().changed({"preset": "paper", "epochs": 7, "seed": 4}).chosen
    assert Preferences.at_start(kept, {}).settings.epochs == 7 and Preferences.at_start(kept, {}).preset == "paper"
    fast = Preferences.at_start(kept, {"preset": "fast"})
    assert (fast.preset, fast.settings.epochs, fast.settings.seed) == ("fast", Settings.epochs, 4)
