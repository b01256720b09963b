"""A trained network as a piece of a fit."""

from __future__ import annotations

import io
from collections.abc import Iterable
from dataclasses import astuple
from functools import partial

import torch

from shapewright.fitting.keeping.unfinished import Form
from shapewright.parameters import ParameterSpace
from shapewright.prediction.devices import pick
from shapewright.prediction.network import make_network
from shapewright.prediction.training import Epoch, Schedule, Trained
from shapewright.rendering.cameras import Camera


def trained_form(space: ParameterSpace, schedule: Schedule, size: int, sized: bool) -> Form[Trained]:
    """How what a schedule trains is written. size: of its pictures. sized: whether it learns from sizes as well."""
    return Form(_write, partial(_read, space=space, schedule=schedule, size=size, sized=sized))


def _write(trained: Trained) -> tuple[bytes, Iterable[bytes]]:
    buffer = io.BytesIO()
    record = {
        "state": {name: tensor.cpu() for name, tensor in trained.network.state_dict().items()},
        "cameras": [list(astuple(camera)) for camera in trained.cameras],
        "curve": [list(astuple(epoch)) for epoch in trained.curve],
    }
    torch.save(record, buffer)
    return b"", [buffer.getvalue()]


def _read(
    _: bytes, content: memoryview, *, space: ParameterSpace, schedule: Schedule, size: int, sized: bool
) -> Trained:
    record = torch.load(io.BytesIO(content), map_location="cpu", weights_only=True)
    cameras = tuple(Camera(*values) for values in record["cameras"])
    network = make_network(schedule.network, space, len(cameras), size, sized=sized)
    network.load_state_dict(record["state"])
    network = network.to(pick(schedule.device)).eval()
    return Trained(network, cameras, [Epoch(*values) for values in record["curve"]])
