import numpy as np
import pytest

from shapewright.judging.calibration import calibrate, fit_cut, fit_threshold, is_same
from shapewright.settings import Settings


def pairs(rng, count, noise):
    """Distances that say little, IoU that says much."""
    same = rng.random(count) < 0.5
    distance = 0.18 + 0.08 * rng.standard_normal(count) - 0.03 * same
    iou = 0.6 + 0.25 * same + noise * rng.standard_normal(count)
    depth = 0.2 + 0.05 * rng.standard_normal(count)
    return [{"distance": d, "iou": i, "depth": z} for d, i, z in zip(distance, iou, depth, strict=True)], list(same)


def test_without_marks_the_threshold_is_the_default():
    found = calibrate([], [])
    assert found.threshold == 0.18 and found.metric is None and found.accuracy is None and found.marks == 0


@pytest.mark.parametrize(
    ("distances", "same", "expected"),
    [
        ([0.10, 0.15, 0.22, 0.30], [True, True, False, False], 0.18),  # the default separates them
        ([0.10, 0.22, 0.26, 0.40], [True, True, False, False], 0.24),
        ([0.10, 0.14, 0.16, 0.40], [True, False, False, False], 0.12),
        ([0.22, 0.24], [True, True], 0.252),  # beyond all that are the same
        ([0.10, 0.12], [False, False], 0.05),
    ],
)
def test_threshold_lies_between_the_two_kinds_and_nearest_to_the_default(distances, same, expected):
    assert fit_threshold(np.array(distances), np.array(same)) == pytest.approx(expected)


def test_the_cut_of_the_fidelity_goes_by_the_same_rule():
    assert fit_cut(np.array([]), np.array([], dtype=bool)) == Settings.replicated
    assert fit_cut(np.array([0.2, 0.6, 0.7, 0.9]), np.array([False, False, True, True])) == pytest.approx(0.65)
    assert fit_cut(np.array([0.2, 0.9]), np.array([False, True])) == Settings.replicated
    assert 0.0 < fit_cut(np.array([0.001]), np.array([True])) < fit_cut(np.array([0.999]), np.array([False])) < 1.0


def test_marks_move_the_cut_of_the_fidelity_and_the_threshold_apart():
    pairs = [{"distance": 0.1, "fidelity": f} for f in (0.4, 0.7, 0.8, 0.9)]
    found = calibrate([*pairs, {"distance": 0.12}], [False, False, True, True, True])
    assert found.replicated == pytest.approx(0.75) and found.marks == 5
    assert found.default_fidelity_accuracy == 0.75 and found.default_accuracy == 0.6


def test_one_stray_mark_does_not_move_the_threshold():
    distances = np.array([0.05, 0.1, 0.12, 0.15, 0.2, 0.25, 0.3, 0.06])
    same = np.array([True, True, True, True, False, False, False, False])
    assert fit_threshold(distances, same) == 0.18


def test_metric_is_learned_only_from_enough_marks_and_only_when_it_is_better():
    measures, same = pairs(np.random.default_rng(1), 60, 0.05)
    found = calibrate(measures, same)
    assert found.metric is not None and found.metric_accuracy > 0.9 > found.accuracy
    right = [
        is_same(found.metric, m["distance"], m["iou"], m["depth"]) == s for m, s in zip(measures, same, strict=True)
    ]
    assert np.mean(right) > 0.95
    assert calibrate(measures[:12], same[:12]).metric is None
    by_distance = [{**m, "distance": 0.1 if s else 0.3} for m, s in zip(measures, same, strict=True)]
    assert calibrate(by_distance, same).metric is None and calibrate(by_distance, same).accuracy == 1.0


def test_marks_without_all_measures_count_for_the_threshold_alone():
    measures, same = pairs(np.random.default_rng(2), 40, 0.05)
    found = calibrate([{"distance": m["distance"]} for m in measures], same)
    assert found.marks == 40 and found.accuracy is not None and found.metric_accuracy is None


def test_accuracy_is_cross_validated_and_so_lower_than_on_the_marks_themselves():
    rng = np.random.default_rng(3)
    measures = [{"distance": float(d)} for d in rng.random(30)]
    found = calibrate(measures, list(rng.random(30) < 0.5))
    assert found.accuracy < 0.75


def test_an_unknown_measure_is_never_the_same():
    assert not is_same((10.0, 0.0, 0.0, 0.0), float("nan"), 1.0, 0.0)
