"""Training the network on sampled shapes, and measuring it on rows it has not seen."""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeAlias

import numpy as np
import torch
from numpy.typing import NDArray
from sklearn.metrics import f1_score
from torch import Tensor

from shapewright.building import cores
from shapewright.parameters import ParameterSpace
from shapewright.prediction.dataset import Dataset
from shapewright.prediction.network import CompactNetwork, loss

SHARDS = 2

Metrics: TypeAlias = dict[str, dict[str, Any]]


@dataclass(frozen=True)
class Epoch:
    """One pass over the training rows, and the mean loss on them and on the validation rows."""

    epoch: int
    train: float
    validation: float


@dataclass(frozen=True)
class Schedule:
    """How to train: AdamW, learning rate up over the first tenth of the steps and down along a cosine."""

    epochs: int = 30
    batch: int = 64
    learning_rate: float = 2e-3
    weight_decay: float = 1e-2
    seed: int = 0


def train_network(
    space: ParameterSpace,
    training: Dataset,
    validation: Dataset,
    schedule: Schedule,
    progress: Callable[[Epoch], None] | None = None,
    threads: int | None = None,
) -> tuple[CompactNetwork, list[Epoch]]:
    """A trained network in evaluation mode, and its curve.

    Every batch is computed as two fixed shards, each on its own thread, whose gradients are averaged: on few cores that
    is faster than torch's own threads, far more so when other programs are busy, and the result does not depend on
    whether the shards ran side by side. The same seed, threads and machine give the same weights.
    """
    curve: list[Epoch] = []
    threads = threads or cores()
    batches = math.ceil(len(training) / schedule.batch)
    rng = np.random.default_rng(schedule.seed)
    with torch_threads(max(1, threads // SHARDS)), torch.random.fork_rng(devices=[]):
        torch.manual_seed(schedule.seed)
        network = CompactNetwork(space, training.images.shape[1], training.images.shape[-1])
        shards = [network, *(_sharing_weights(network) for _ in range(SHARDS - 1))]
        optimiser = torch.optim.AdamW(
            network.parameters(), lr=schedule.learning_rate, weight_decay=schedule.weight_decay
        )
        rates = torch.optim.lr_scheduler.OneCycleLR(
            optimiser, schedule.learning_rate, total_steps=schedule.epochs * batches, pct_start=0.1
        )

        def backward(shard: CompactNetwork, rows: NDArray[np.int64]) -> float:
            images, targets, active = _tensors(training, rows)
            with torch.autocast("cpu", torch.bfloat16, enabled=_fast_bfloat16()):
                outputs = shard(images)
            value = loss(space, outputs, targets, active)
            shard.zero_grad()
            value.backward()  # type: ignore[no-untyped-call]
            return value.item()

        limit = partial(torch.set_num_threads, max(1, threads // SHARDS))
        with ThreadPoolExecutor(min(threads, SHARDS), initializer=limit) as pool:
            for epoch in range(1, schedule.epochs + 1):
                network.train()
                losses: list[float] = []
                for rows in np.array_split(rng.permutation(len(training)), batches):
                    losses += pool.map(backward, shards, np.array_split(rows, SHARDS))
                    _average_gradients(shards)
                    optimiser.step()
                    rates.step()
                curve.append(Epoch(epoch, float(np.mean(losses)), _validation_loss(space, network, validation)))
                if progress:
                    progress(curve[-1])
    return network.eval(), curve


def _sharing_weights(network: CompactNetwork) -> CompactNetwork:
    twin = copy.deepcopy(network)
    for mine, theirs in zip(twin.parameters(), network.parameters(), strict=True):
        mine.data = theirs.data
    return twin


def _average_gradients(shards: list[CompactNetwork]) -> None:
    """Leave the mean of the shards' gradients with the first."""
    for first, *others in zip(*(shard.parameters() for shard in shards), strict=True):
        assert first.grad is not None
        for other in others:
            first.grad += other.grad
        first.grad /= len(shards)


def infer(network: CompactNetwork, space: ParameterSpace, images: NDArray[np.uint8]) -> list[NDArray[np.float32]]:
    """For each parameter (N,) encoded values of a scalar, or (N, classes) probabilities. images: (N, C, 2, S, S)."""
    network.eval()
    columns: list[list[Tensor]] = [[] for _ in space]
    with torch.inference_mode():
        for start in range(0, len(images), 256):
            outputs = network(torch.from_numpy(images[start : start + 256]).float() / 255.0)
            for column, parameter, output in zip(columns, space, outputs, strict=True):
                column.append(output.softmax(dim=1) if parameter.classes else output[:, 0].clamp(0.0, 1.0))
    return [torch.cat(column).numpy() for column in columns]


def measure(network: CompactNetwork, space: ParameterSpace, held_out: Dataset) -> Metrics:
    """Per parameter over the rows where it matters: MAE of a scalar (normalised to [0, 1]), else F1 and accuracy.

    F1 is the mean over the classes that occur (paper section 5.1).
    """
    return score(space, infer(network, space, held_out.images), held_out.targets, held_out.active)


def score(
    space: ParameterSpace,
    predicted: list[NDArray[np.float32]],
    targets: NDArray[np.float32],
    active: NDArray[np.bool_],
) -> Metrics:
    """The metrics of ``measure`` for given predictions; targets and active are (N, P)."""
    metrics: Metrics = {}
    for column, (parameter, values) in enumerate(zip(space, predicted, strict=True)):
        rows = active[:, column]
        truth, kind = targets[rows, column], type(parameter).__name__.lower()
        if not rows.any():
            metrics[parameter.name] = {"kind": kind, "rows": 0}
        elif parameter.classes:
            guess = values[rows].argmax(axis=1)
            f1 = f1_score(truth.astype(int), guess, labels=np.unique(truth.astype(int)), average="macro")
            accuracy = float((guess == truth).mean())
            metrics[parameter.name] = {"kind": kind, "rows": int(rows.sum()), "f1": float(f1), "accuracy": accuracy}
        else:
            mae = float(np.abs(values[rows] - truth).mean())
            metrics[parameter.name] = {"kind": kind, "rows": int(rows.sum()), "mae": mae}
    return metrics


@contextmanager
def torch_threads(threads: int | None) -> Iterator[None]:
    """Run torch on this many threads (all cores by default), and put the number back afterwards."""
    before = torch.get_num_threads()
    torch.set_num_threads(threads or cores())
    try:
        yield
    finally:
        torch.set_num_threads(before)


def _tensors(data: Dataset, rows: NDArray[np.int64]) -> tuple[Tensor, Tensor, Tensor]:
    images = torch.from_numpy(data.images[rows]).float() / 255.0
    return images, torch.from_numpy(data.targets[rows]), torch.from_numpy(data.active[rows])


def _validation_loss(space: ParameterSpace, network: CompactNetwork, validation: Dataset) -> float:
    if not len(validation):
        return math.nan
    network.eval()
    with torch.inference_mode():
        images, targets, active = _tensors(validation, np.arange(len(validation)))
        return float(loss(space, network(images), targets, active))


def _fast_bfloat16() -> bool:
    """Whether this CPU multiplies bfloat16 in hardware; where it does not, autocast would slow training down."""
    supported = getattr(torch.cpu, "_is_avx512_bf16_supported", lambda: False)
    return bool(supported())
