import json
import math
import pickle
from dataclasses import replace

import numpy as np
import pytest

import shapewright as sw
from shapewright.settings import described, groups


def test_the_paper_to_the_number():
    paper = sw.Settings.preset("paper")
    assert (paper.network, paper.cameras, paper.views, paper.image_size) == ("vgg19", "learned", 3, 256)
    assert (paper.optimiser, paper.learning_rate, paper.weight_decay) == ("adam", 1e-5, 1e-8)
    assert (paper.camera_rate, paper.epochs, paper.batch, paper.samples) == (5e-4, 50, 32, 3000)
    assert (paper.threshold, paper.cut, paper.refine, paper.judge) == (0.18, 0.4, "off", "paper")


def test_presets_take_changes_and_are_recorded():
    assert sw.Settings.preset("fast") == sw.Settings()
    changed = sw.Settings.preset("paper", epochs=2, device="cpu")
    assert changed.epochs == 2 and changed.network == "vgg19"
    assert sw.Settings.from_record(json.loads(json.dumps(changed.record()))) == changed
    with pytest.raises(ValueError, match="preset='slow': there is fast and paper"):
        sw.Settings.preset("slow")


@pytest.mark.parametrize(
    "wrong",
    [
        {"batch": 4},
        {"views": 0},
        {"camera_distance": 1.0},
        {"camera_rate": 0.0},
        {"weight_decay": -1.0},
        {"image_size": 16, "network": "vgg19"},
    ],
)
def test_settings_of_the_predictor_are_checked(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        sw.Settings(**wrong)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"refine": "quik"}, "refine='quik' must be off, quick or thorough; did you mean quick?"),
        ({"network": "vgg"}, "network='vgg' must be compact or vgg19; did you mean vgg19?"),
        ({"rounds": -3}, "rounds=-3 must be a whole number, at least 0"),
        ({"align": "sideways"}, "align='sideways' must be free or upright"),
        ({"views": 33}, "views=33 must be a whole number, at least 1 and at most 32"),
        ({"image_size": 50}, "image_size=50 must be a whole number, at least 16 and a multiple of 16"),
        ({"samples": 30.5}, "samples=30.5 must be a whole number, at least 20"),
        ({"samples": True}, "samples=True must be a whole number, at least 20"),
        ({"augment": 1}, "augment=1 must be True or False"),
        ({"learning_rate": math.inf}, "learning_rate=inf must be a finite number, greater than 0"),
        ({"threshold": math.nan}, "threshold=nan must be a finite number, greater than 0"),
        ({"vif": 1.0}, "vif=1.0 must be a finite number, greater than 0 and less than 1"),
        ({"judge": "papers"}, "judge='papers' must be fidelity or paper; did you mean paper?"),
        ({"close": 0.7}, "close=0.7 must be at most replicated=0.65"),
        ({"metric": (1.0, 2.0, 3.0)}, "metric=(1.0, 2.0, 3.0) must be 4 finite numbers, or None"),
        ({"workers": 0}, "workers=0 must be a whole number, at least 1, or None"),
        ({"weights": 3}, "weights=3 must be a text, or None"),
        ({"cut": 2.0}, "cut=2.0 must be at most 1, or a distance together with cut_absolute=True"),
    ],
)
def test_a_wrong_value_is_refused_with_what_is_allowed(wrong, message):
    for make in (sw.Settings, lambda **given: replace(sw.Settings(), **given)):
        with pytest.raises(ValueError) as error:
            make(**wrong)
        assert str(error.value) == message


def test_an_unknown_name_is_refused_with_the_one_that_was_meant():
    with pytest.raises(TypeError, match="there is no setting 'refin'; did you mean refine\\?"):
        sw.Settings(refin="off")
    with pytest.raises(TypeError, match="there is no setting 'epoch'; did you mean epochs\\?"):
        sw.Settings.preset("paper", epoch=3)


def test_flat_names_read_write_copy_and_have_defaults_on_the_class():
    settings = sw.Settings(seed=np.int64(1), refine="off", shape_seconds=3)
    assert (settings.seed, settings.refine, settings.shape_seconds) == (1, "off", 3.0)
    assert type(settings.seed) is int and type(settings.shape_seconds) is float
    assert replace(settings, refine="thorough", epochs=2).refine == "thorough"
    assert pickle.loads(pickle.dumps(settings)) == settings
    assert (sw.Settings.epochs, sw.Settings.threshold) == (15, 0.18)


def test_every_setting_has_a_group_and_one_line_of_help():
    grouped = [name for names in groups().values() for name in names]
    assert list(groups()) == ["preparing", "building", "learning", "searching", "judging"]
    assert sorted([*grouped, "seed", "workers"]) == sorted(described()) == sorted(sw.Settings().record())
    assert all(field.help.endswith(".") and "\n" not in field.help for field in described().values())


def test_a_record_of_before_the_fidelity_judge_is_the_papers():
    old = {name: value for name, value in sw.Settings().record().items() if name not in groups()["judging"]}
    assert sw.Settings.from_record({**old, "fidelity": 0.2}) == sw.Settings(judge="paper", vif=0.2)
    assert sw.Settings.from_record(sw.Settings().record()) == sw.Settings()


def test_records_of_older_versions_load_and_what_they_took_for_the_default_is_the_default():
    old = {**sw.Settings(epochs=7).record(), "refine": "quik", "rounds": -3, "workers": 0, "metric": [1, 2, 3, 4]}
    assert sw.Settings.from_record(old) == sw.Settings(epochs=7, metric=(1, 2, 3, 4))
