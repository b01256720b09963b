"""What an author's marks say: the least fidelity that is the same to the author, and as much of the paper's measure.

Of that a threshold, and with enough marks a metric of several measures.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shapewright.settings import Settings, Weights
from shapewright.shapes import Floats

MEASURES = ("distance", "iou", "depth")  # what a metric is learned from, in the order of its weights
NOTED = (*MEASURES, "fidelity")  # what is kept of a marked pair
ENOUGH, OF_EACH = 20, 6
"""Marks that a metric is learned from at least, in all and of either kind: five for each of its four numbers."""
_LEAST = 0.01  # distance of the cut of the fidelity to 0 and to 1: either end would judge all pairs alike
_FOLDS = 5  # of a cross-validation, the usual number
Classifier = Callable[[Floats, NDArray[np.bool_], Floats], NDArray[np.bool_]]
"""Learns from measures (N, K) and what is the same (N,) which of other measures (M, K) are the same (M,)."""


@dataclass(frozen=True)
class Calibration:
    """What marks say; accuracies are shares of marks judged right, None where there are too few to measure them."""

    replicated: float  # the least fidelity of a replicated reference
    fidelity_accuracy: float | None  # of such cuts fitted to other marks (cross-validation)
    threshold: float  # of the light-field distance
    accuracy: float | None  # of thresholds fitted to other marks (cross-validation); it takes 2 marks of either kind
    metric: Weights | None  # of all measures; None for too few marks, or where it is no better than the threshold
    metric_accuracy: float | None  # of such metrics, cross-validated as well
    marks: int  # how many there are
    default_accuracy: float | None  # of the default threshold
    default_fidelity_accuracy: float | None  # of the default cut of the fidelity


def calibrate(measures: Sequence[Mapping[str, float]], same: Sequence[bool], seed: int = 0) -> Calibration:
    """Fit a cut of the fidelity, a threshold, and a metric where there is enough to learn from.

    measures: of each pair, "distance" and perhaps "fidelity", "iou" and "depth". A pair without a fidelity does not
    count for the cut. Of the thresholds that get most marks right, the one nearest to the default is taken: without
    marks, the default itself. The cut is found in the same way. The metric is a logistic regression. It needs 20 marks
    with all measures, 6 of either kind, and a better cross-validated accuracy than the threshold.
    """
    distances, truth = np.array([pair["distance"] for pair in measures], dtype=float), np.array(same, dtype=bool)
    threshold = fit_threshold(distances, truth)
    default = float(((distances <= Settings.threshold) == truth).mean()) if len(truth) else None
    accuracy = _cross_validated(distances[:, None], truth, _by_threshold, seed)
    judged = [i for i, pair in enumerate(measures) if "fidelity" in pair]
    fidelity, alike = np.array([measures[i]["fidelity"] for i in judged], dtype=float), truth[judged]
    whole = [i for i, pair in enumerate(measures) if all(name in pair for name in MEASURES)]
    table = np.array([[measures[i][name] for name in MEASURES] for i in whole]).reshape(-1, len(MEASURES))
    known = truth[whole]
    metric, metric_accuracy = None, None
    if len(known) >= ENOUGH and min(known.sum(), (~known).sum()) >= OF_EACH:
        metric_accuracy = _cross_validated(table, known, _by_metric, seed)
        by_threshold = _cross_validated(table[:, :1], known, _by_threshold, seed)
        if metric_accuracy is not None and by_threshold is not None and metric_accuracy > by_threshold:
            metric = fit_metric(table, known)
    return Calibration(
        replicated=fit_cut(fidelity, alike),
        fidelity_accuracy=_cross_validated(fidelity[:, None], alike, _by_cut, seed),
        threshold=threshold,
        accuracy=accuracy,
        metric=metric,
        metric_accuracy=metric_accuracy,
        marks=len(truth),
        default_accuracy=default,
        default_fidelity_accuracy=float(((fidelity >= Settings.replicated) == alike).mean()) if len(alike) else None,
    )


def fit_threshold(distances: Floats, same: NDArray[np.bool_], default: float = Settings.threshold) -> float:
    """The threshold that gets most pairs right; of several the nearest to the default.

    Between two distances the middle counts, so that no pair lies on the threshold.
    """
    if not len(distances):
        return default
    order = np.unique(distances)
    cuts = np.concatenate([[order[0] / 2.0], (order[1:] + order[:-1]) / 2.0, [order[-1] * 1.05], [default]])
    right = ((distances[:, None] <= cuts) == same[:, None]).sum(axis=0)
    best = cuts[right == right.max()]
    return float(best[np.abs(best - default).argmin()])


def fit_cut(fidelities: Floats, same: NDArray[np.bool_], default: float = Settings.replicated) -> float:
    """The least fidelity of what is the same, by the rule of ``fit_threshold``; inside (0, 1)."""
    return min(max(1.0 - fit_threshold(1.0 - fidelities, same, 1.0 - default), _LEAST), 1.0 - _LEAST)


def fit_metric(table: Floats, same: NDArray[np.bool_]) -> Weights:
    """Logistic regression on standardised measures (N, 3), given back in their own units."""
    from sklearn.linear_model import LogisticRegression  # slow to import, and a judge does not need it

    middle, spread = table.mean(axis=0), np.maximum(table.std(axis=0), 1e-6)
    model = LogisticRegression(class_weight="balanced").fit((table - middle) / spread, same)
    weights = model.coef_[0] / spread
    bias = float(model.intercept_[0] - weights @ middle)
    return (bias, *(float(weight) for weight in weights))  # type: ignore[return-value]


def is_same(metric: Weights, distance: float, iou: float, depth: float) -> bool:
    """Whether a metric takes a pair for the same: bias + weights . measures is at least 0, and no measure is NaN."""
    bias, *weights = metric
    return bool(bias + float(np.dot(weights, [distance, iou, depth])) >= 0.0)


def _by_threshold(table: Floats, same: NDArray[np.bool_], others: Floats) -> NDArray[np.bool_]:
    return np.asarray(others[:, 0] <= fit_threshold(table[:, 0], same))


def _by_cut(table: Floats, same: NDArray[np.bool_], others: Floats) -> NDArray[np.bool_]:
    return np.asarray(others[:, 0] >= fit_cut(table[:, 0], same))


def _by_metric(table: Floats, same: NDArray[np.bool_], others: Floats) -> NDArray[np.bool_]:
    metric = fit_metric(table, same)
    return np.array([is_same(metric, *row) for row in others], dtype=bool)


def _cross_validated(table: Floats, same: NDArray[np.bool_], classifier: Classifier, seed: int) -> float | None:
    """Share of pairs that a classifier fitted to other pairs gets right."""
    from sklearn.model_selection import StratifiedKFold

    folds = min(_FOLDS, int(same.sum()), int((~same).sum()))
    if folds < 2:
        return None
    right = np.zeros(len(same), dtype=bool)
    for fitted, held in StratifiedKFold(folds, shuffle=True, random_state=seed).split(table, same):
        right[held] = classifier(table[fitted], same[fitted], table[held]) == same[held]
    return float(right.mean())
