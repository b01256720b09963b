import json

import pytest

import shapewright as sw


def test_the_paper_to_the_number():
    paper = sw.Settings.preset("paper")
    assert (paper.network, paper.cameras, paper.views, paper.image_size) == ("vgg19", "learned", 3, 256)
    assert (paper.optimiser, paper.learning_rate, paper.weight_decay) == ("adam", 1e-5, 1e-8)
    assert (paper.camera_rate, paper.epochs, paper.batch, paper.samples) == (5e-4, 50, 32, 3000)
    assert (paper.threshold, paper.cut, paper.refine) == (0.18, 0.4, "off")


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
