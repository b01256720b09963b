"""What a trained network says about pictures, and how good that is on rows it has not seen."""

from __future__ import annotations

import math
from typing import Any, Protocol, TypeAlias

import numpy as np
import torch
from numpy.typing import NDArray
from sklearn.metrics import f1_score
from torch import Tensor, nn

from shapewright.parameters import ParameterSpace, Prediction
from shapewright.prediction.dataset import Dataset
from shapewright.prediction.heads import ScalarHead, head_of

Floats = NDArray[np.float32]
Metrics: TypeAlias = dict[str, dict[str, Any]]

_PIXELS = 2**22  # Pixels of one channel that pass the network at once, which bounds the memory it takes. By hand.


class Pictures(Protocol):
    """Images (N, C, 2, S, S), some of which can be taken at a time: an array, for instance."""

    @property
    def shape(self) -> tuple[int, ...]: ...
    def __len__(self) -> int: ...
    def __getitem__(self, rows: slice, /) -> NDArray[np.uint8]: ...


def outputs(network: nn.Module, images: Pictures, extents: Floats | None = None) -> list[Tensor]:
    """The network's answers to images (N, C, 2, S, S) and sizes (N,), in evaluation mode, on the CPU."""
    device = next(network.parameters()).device
    rows = max(1, _PIXELS // math.prod(images.shape[1:2] + images.shape[3:]))
    network.eval()
    answers = []
    with torch.inference_mode():
        for start in range(0, len(images), rows):
            part = torch.from_numpy(images[start : start + rows]).to(device).float() / 255.0
            sides = None if extents is None else torch.from_numpy(extents[start : start + rows]).to(device)
            answers.append([answer.float().cpu() for answer in network(part, sides)])
    return [torch.cat(column) for column in zip(*answers, strict=True)]


def infer(network: nn.Module, space: ParameterSpace, images: Pictures, extents: Floats | None = None) -> Prediction:
    """What is likely for images (N, C, 2, S, S), at least one, and sizes (N,)."""
    answers = list(zip(space, outputs(network, images, extents), strict=True))
    columns = tuple((out.softmax(dim=1) if p.classes else out[:, 0].clamp(0.0, 1.0)).numpy() for p, out in answers)
    spreads = tuple(None if p.classes else out[:, 1].exp().numpy() for p, out in answers)
    return Prediction(space, columns, spreads)


def calibrate(network: nn.Module, space: ParameterSpace, validation: Dataset) -> None:
    """Scale every spread so that it is right, on the mean, for rows the network has not learned from.

    A network errs less on the rows it learned from, and learns its spread there.
    """
    if not len(validation):
        return
    prediction = infer(network, space, validation.images, validation.extents)
    for column, (parameter, spread) in enumerate(zip(space, prediction.spreads, strict=True)):
        head, rows = head_of(network, parameter.name), validation.active[:, column]
        if not isinstance(head, ScalarHead) or spread is None:
            continue
        errors = np.abs(prediction.columns[column] - validation.targets[:, column])[rows]
        if errors.any():
            head.scale_spread(float(np.mean(errors / spread[rows])))


def measure(network: nn.Module, space: ParameterSpace, held_out: Dataset) -> Metrics:
    """The ``score`` of the network on these rows."""
    return score(infer(network, space, held_out.images, held_out.extents), held_out.targets, held_out.active)


def score(prediction: Prediction, targets: Floats, active: NDArray[np.bool_]) -> Metrics:
    """Per parameter over the rows where it matters, targets and active (N, P).

    Of a scalar: "mae", normalised to [0, 1], and with spreads "within50" and "within90", the shares of true values
    inside the intervals that should hold .5 and .9 of them. Of the others: "f1", the mean over the classes that occur
    (paper section 5.1), "accuracy", and "confidence", the mean probability of the class predicted, which is the
    accuracy to expect.
    """
    columns = prediction.columns
    spreads = prediction.spreads or [None] * len(columns)
    metrics: Metrics = {}
    for column, (parameter, values, spread) in enumerate(zip(prediction.space, columns, spreads, strict=True)):
        rows = active[:, column]
        truth = targets[rows, column]
        metrics[parameter.name] = {"kind": type(parameter).__name__.lower(), "rows": int(rows.sum())}
        if rows.any():
            within = None if spread is None else spread[rows]
            found = _classes(values[rows], truth) if parameter.classes else _scalar(values[rows], truth, within)
            metrics[parameter.name] |= found
    return metrics


def _classes(probabilities: Floats, truth: Floats) -> dict[str, float]:
    guess, labels = probabilities.argmax(axis=1), truth.astype(int)
    return {
        "f1": float(f1_score(labels, guess, labels=np.unique(labels), average="macro")),
        "accuracy": float((guess == labels).mean()),
        "confidence": float(probabilities.max(axis=1).mean()),
    }


def _scalar(values: Floats, truth: Floats, spread: Floats | None) -> dict[str, float]:
    errors = np.abs(values - truth)
    found = {"mae": float(errors.mean())}
    if spread is not None:
        found |= {f"within{p}": float((errors <= -spread * math.log(1.0 - p / 100)).mean()) for p in (50, 90)}
    return found
