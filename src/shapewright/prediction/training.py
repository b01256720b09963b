"""Training the network on sampled shapes, and the cameras it looks through where they are learned."""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from torch import nn
from torch.optim import Adam, AdamW, Optimizer
from torch.optim.lr_scheduler import ConstantLR, LRScheduler, OneCycleLR

from shapewright.parameters import ParameterSpace
from shapewright.prediction.camera_learning import LearnedCameras, camera_gradient
from shapewright.prediction.dataset import Dataset
from shapewright.prediction.devices import autocast, pick, torch_threads
from shapewright.prediction.heads import SizeInput
from shapewright.prediction.inference import calibrate, outputs
from shapewright.prediction.network import loss, make_network, spread_loss
from shapewright.rendering.cameras import Camera
from shapewright.rendering.raster import render
from shapewright.settings import Device, Network, Optimiser
from shapewright.shapes import Ints
from shapewright.threads import cores

_SHARDS = 2  # parts of a batch on a CPU, each on a thread of its own (docs/architecture.md, Threads)
_CAMERA_ROWS = 8
"""Rows of a shard from which the gradient by the cameras is estimated: six renders each. By trial on tables."""
_CAMERA_SHARE = 0.5  # Of the epochs in which learned cameras move: the network settles in the rest. By trial on tables.


@dataclass(frozen=True)
class Epoch:
    """One pass over the training rows."""

    epoch: int  # its number, from 1
    train: float  # mean loss on the training rows
    validation: float  # mean loss on the validation rows, NaN where there are none


@dataclass(frozen=True)
class Schedule:
    """What to train, and how.

    The learning rate of "adamw" rises over the first tenth of the steps and falls along a cosine; learned cameras move
    in the first half of the epochs, and the network settles in the rest. With "adam", the paper's, the rate is constant
    and the cameras always move.
    """

    epochs: int = 30  # passes over the training rows
    batch: int = 64  # rows for each step
    learning_rate: float = 2e-3  # of the network; with "adamw" the greatest
    weight_decay: float = 1e-2  # of both optimisers
    optimiser: Optimiser = "adamw"
    camera_rate: float = 0.0  # learning rate of the cameras in radians and units of distance, 0 where they are fixed
    network: Network = "compact"
    weights: Path | None = None  # a file of VGG19's, see vgg.VGG19Network
    device: Device = "cpu"  # on which torch computes
    seed: int = 0  # of the first weights and the order of the rows


@dataclass(frozen=True, eq=False)
class Trained:
    """What training gives."""

    network: nn.Module  # in evaluation mode
    cameras: tuple[Camera, ...]  # those that it has learned to look through
    curve: list[Epoch]  # loss by epoch


def train_network(
    space: ParameterSpace,
    training: Dataset,
    validation: Dataset,
    schedule: Schedule,
    progress: Callable[[Epoch], None] | None = None,
    threads: int | None = None,
    initial: nn.Module | None = None,
    redraw: Callable[[Dataset, int], Dataset] | None = None,
) -> Trained:
    """Train a network on shapes as the dataset's cameras see them, and where they are learned, these cameras too.

    initial: a network to start from, where its layers match by name and shape; the others start fresh. redraw: gives
    the training rows other pictures before each epoch but the first, by the epoch's number.

    On a CPU every batch is computed as two fixed shards, each on its own thread, whose gradients are averaged: on few
    cores that is faster than torch's own threads, far more so when other programs are busy, and the result does not
    depend on whether the shards ran side by side. The same seed, threads and machine give the same weights.
    """
    curve: list[Epoch] = []
    device = pick(schedule.device)
    threads = threads or cores()
    count = _SHARDS if device.type == "cpu" else 1
    each = max(1, threads // count)
    batches = math.ceil(len(training) / schedule.batch)
    moving = _epochs_of_cameras(schedule)
    cameras = LearnedCameras(training.cameras, schedule.camera_rate, moving * batches, schedule.optimiser == "adam")
    rng = np.random.default_rng(schedule.seed)
    exact = torch.backends.cudnn.flags(enabled=True, benchmark=False, deterministic=True)
    with torch_threads(each), torch.random.fork_rng(devices=[]), exact:
        torch.default_generator.manual_seed(schedule.seed)
        views, size = training.images.shape[1], training.size
        network = make_network(schedule.network, space, views, size, schedule.weights, training.extents is not None)
        if training.extents is not None and isinstance(network.size, SizeInput):
            network.size.learn(torch.from_numpy(training.extents))
        if initial is not None:
            _inherit(network, initial)
        network.to(device)
        shards = [network, *(_sharing_weights(network) for _ in range(count - 1))]
        optimiser, rates = _optimiser(network, schedule, schedule.epochs * batches)
        with ThreadPoolExecutor(min(threads, count), initializer=partial(torch.set_num_threads, each)) as pool:
            for epoch in range(1, schedule.epochs + 1):
                network.train()
                if redraw and epoch > 1:
                    training = redraw(training, epoch)
                losses: list[float] = []
                for rows in np.array_split(rng.permutation(len(training)), batches):
                    through = cameras.cameras if epoch <= moving else None
                    backward = partial(_backward, space, training, through, each)
                    results = list(pool.map(backward, shards, np.array_split(rows, count)))
                    _average_gradients(shards)
                    optimiser.step()
                    rates.step()
                    losses += [value for value, _ in results]
                    gradients = [gradient for _, gradient in results if gradient is not None]
                    if gradients:
                        cameras.step(np.mean(gradients, axis=0))
                validation = validation.seen_by(cameras.cameras, threads)
                if epoch == moving:
                    training = training.seen_by(cameras.cameras, threads)
                curve.append(Epoch(epoch, float(np.mean(losses)), _validation_loss(space, network, validation)))
                if progress:
                    progress(curve[-1])
        calibrate(network, space, validation)
    return Trained(network.eval(), cameras.cameras, curve)


def _epochs_of_cameras(schedule: Schedule) -> int:
    if not schedule.camera_rate:
        return 0
    return schedule.epochs if schedule.optimiser == "adam" else math.ceil(schedule.epochs * _CAMERA_SHARE)


def _optimiser(network: nn.Module, schedule: Schedule, steps: int) -> tuple[Optimizer, LRScheduler]:
    fused = next(network.parameters()).device.type != "mps"  # not in every torch that we run with
    kind = Adam if schedule.optimiser == "adam" else AdamW
    optimiser = kind(network.parameters(), lr=schedule.learning_rate, weight_decay=schedule.weight_decay, fused=fused)
    if schedule.optimiser == "adam":
        return optimiser, ConstantLR(optimiser, factor=1.0)
    return optimiser, OneCycleLR(optimiser, schedule.learning_rate, total_steps=steps, pct_start=0.1)


def _inherit(network: nn.Module, initial: nn.Module) -> None:
    """Take over what the two networks share by name and shape."""
    mine, theirs = network.state_dict(), initial.state_dict()
    shared = {name: theirs[name] for name in mine if name in theirs and mine[name].shape == theirs[name].shape}
    network.load_state_dict(mine | shared)


def _sharing_weights(network: nn.Module) -> nn.Module:
    twin = copy.deepcopy(network)
    for mine, theirs in zip(twin.parameters(), network.parameters(), strict=True):
        mine.data = theirs.data
    return twin


def _backward(
    space: ParameterSpace, data: Dataset, cameras: tuple[Camera, ...] | None, threads: int, shard: nn.Module, rows: Ints
) -> tuple[float, NDArray[np.float64] | None]:
    """Leave the gradient of the loss on these rows with the shard; returns the loss.

    cameras: where they are learned, their present places, from which the shapes are then seen; the gradient of the
    loss by their positions comes back too, estimated on the first rows.
    """
    device = next(shard.parameters()).device
    some = rows[:_CAMERA_ROWS]
    images = data.images[rows]
    if cameras is not None:
        images = render([data.shapes[i] for i in rows], cameras, data.size, threads=threads)
    pictures = torch.from_numpy(images).to(device).flatten(1, 2).contiguous(memory_format=torch.channels_last)
    pictures = pictures.float().div_(255.0).reshape(images.shape)
    pictures.requires_grad_(cameras is not None)
    targets, active = (torch.from_numpy(values[rows]).to(device) for values in (data.targets, data.active))
    with autocast(device):
        answers = shard(pictures, None if data.extents is None else torch.from_numpy(data.extents[rows]).to(device))
    value = loss(space, answers, targets, active)
    shard.zero_grad()
    (value + spread_loss(space, answers, targets, active)).backward()  # type: ignore[no-untyped-call]
    if cameras is None or pictures.grad is None:
        return value.item(), None
    by_pixel = pictures.grad[: len(some)].cpu().numpy()
    gradient = camera_gradient([data.shapes[i] for i in some], cameras, by_pixel, threads=threads)
    return value.item(), gradient * (len(rows) / len(some))


def _average_gradients(shards: list[nn.Module]) -> None:
    """Leave the mean of the shards' gradients with the first."""
    for first, *others in zip(*(shard.parameters() for shard in shards), strict=True):
        assert first.grad is not None
        for other in others:
            first.grad += other.grad
        first.grad /= len(shards)


def _validation_loss(space: ParameterSpace, network: nn.Module, validation: Dataset) -> float:
    if not len(validation):
        return math.nan
    targets, active = torch.from_numpy(validation.targets), torch.from_numpy(validation.active)
    return float(loss(space, outputs(network, validation.images, validation.extents), targets, active))
