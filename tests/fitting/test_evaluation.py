from typing import Annotated, Literal

import numpy as np
import pytest
import torch

import shapewright as sw
from shapewright import Range
from shapewright.fitting.evaluation import evaluate, variants
from shapewright.modelling.solids import box
from shapewright.parameters import ParameterSpace, Prediction, Scalar
from shapewright.prediction.dataset import make_dataset
from shapewright.prediction.heads import head_of
from shapewright.prediction.inference import calibrate, infer, measure, outputs, score
from shapewright.prediction.network import CompactNetwork
from shapewright.rendering.cameras import THREE_VIEWS


@sw.procedure
def slab(s: Annotated[float, Range(0.2, 1.0)] = 0.5, c: Literal["a", "b"] = "a"):
    return box((1, s, 1))


SPACE = slab.space


def dataset(count):
    rows = SPACE.sample(count, seed=0)
    meshes = [slab(**values).normalised() for values in rows]
    return make_dataset(SPACE, rows, meshes, THREE_VIEWS[:1], 16, threads=1)


def test_intervals_of_a_laplace_distribution_hold_their_share():
    rng = np.random.default_rng(0)
    spread = rng.uniform(0.01, 0.3, 20_000).astype(np.float32)
    truth = np.zeros((20_000, 1), dtype=np.float32)
    space, active = ParameterSpace((Scalar("s", 0, 1, 0),)), np.ones((20_000, 1), dtype=bool)
    predicted = rng.laplace(0.0, spread).astype(np.float32)
    found = score(Prediction(space, (predicted,), (spread,)), truth, active)["s"]
    assert found["within50"] == pytest.approx(0.5, abs=0.02) and found["within90"] == pytest.approx(0.9, abs=0.02)
    narrow = score(Prediction(space, (predicted,), (spread / 4,)), truth, active)["s"]
    assert narrow["within50"] < 0.3 and narrow["within90"] < 0.6
    assert "within50" not in score(Prediction(space, (predicted,)), truth, active)["s"]


def test_variants_are_all_combinations_of_what_is_compared():
    settings = sw.Settings(seed=3)
    assert variants(settings, None) == [settings]
    assert [v.cameras for v in variants(settings, "cameras")] == ["fixed", "learned"]
    both = variants(settings, "both")
    assert [(v.views, v.cameras) for v in both][:3] == [(1, "fixed"), (1, "learned"), (2, "fixed")]
    assert len(both) == 8 and all(v.seed == 3 for v in both)


def test_refinement_is_measured_on_as_many_held_out_samples_as_asked_for():
    settings = sw.Settings(samples=60, epochs=1, image_size=16, workers=1)
    (trial,) = evaluate(slab, settings, refined=4)
    assert trial.refined["s"]["rows"] == trial.refined["c"]["rows"] == 4 < trial.metrics["s"]["rows"]
    assert trial.refined["s"]["mae"] < trial.metrics["s"]["mae"]
    assert len(trial.measured) == len(trial.grades) == 4 and all(measures.iou > 0.5 for measures in trial.measured)


def test_calibration_makes_the_mean_spread_right_and_leaves_values_alone():
    torch.manual_seed(0)
    network, data = CompactNetwork(SPACE, views=1, size=16), dataset(60)
    head_of(network, "s").scale_spread(1e-3)
    before = infer(network, SPACE, data.images)
    calibrate(network, SPACE, data)
    after = infer(network, SPACE, data.images)
    errors = np.abs(after.columns[0] - data.targets[:, 0])
    assert np.mean(errors / before.spreads[0]) > 10
    assert np.mean(errors / after.spreads[0]) == pytest.approx(1.0, rel=1e-4)
    assert after.spreads[1] is None and np.array_equal(before.columns[0], after.columns[0])
    assert set(measure(network, SPACE, data)["s"]) == {"kind", "rows", "mae", "within50", "within90"}
    assert set(measure(network, SPACE, data)["c"]) == {"kind", "rows", "f1", "accuracy", "confidence"}


def test_many_pictures_are_answered_in_parts_as_in_one():
    torch.manual_seed(0)
    network = CompactNetwork(SPACE, views=1, size=256).eval()
    images = np.random.default_rng(0).integers(0, 256, (70, 1, 2, 256, 256), dtype=np.uint8)
    whole = outputs(network, images)
    each = [outputs(network, images[i : i + 1]) for i in (0, 63, 64, 69)]
    for k, i in enumerate((0, 63, 64, 69)):
        assert torch.allclose(whole[0][i], each[k][0][0], atol=1e-5)
