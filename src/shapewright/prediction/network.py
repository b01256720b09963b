"""Networks: pictures of a shape in, one answer for each parameter out; and what they are taught by."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import torch
from torch import Tensor, nn
from torch.nn import functional

from shapewright.parameters import ParameterSpace
from shapewright.prediction.heads import Heads, SizeInput, with_size
from shapewright.prediction.vgg import VGG19Network
from shapewright.settings import Network

LAYERS = ((4, 48), (2, 96), (2, 128))
"""Stride and channels of each convolution: the first takes patches side by side, the others overlap by a pixel."""
_LOG_SPREAD = (-9.0, 2.0)
"""Least and greatest logarithm of a spread while learning: from a ten-thousandth of a Range to seven. By hand."""


class CompactNetwork(nn.Module):
    """A strided CNN over the stacked views and one MLP a parameter, small enough to train on a CPU in a minute.

    Takes images (B, C, 2, S, S) in [0, 1], S a multiple of 16, and where it is sized the longest sides (B,) of the
    shapes; gives what Heads gives.
    """

    def __init__(
        self, space: ParameterSpace, views: int, size: int = 64, width: int = 128, sized: bool = False
    ) -> None:
        super().__init__()
        layers: list[nn.Module] = []
        channels, side = 2 * views, size
        for stride, out in LAYERS:
            kernel, margin = (3, 1) if layers else (stride, 0)
            layers += [nn.Conv2d(channels, out, kernel, stride, margin, bias=False), nn.BatchNorm2d(out), nn.GELU()]
            channels, side = out, side // stride
        self.features = nn.Sequential(*layers)
        self.size = SizeInput() if sized else None
        self.summary = nn.Sequential(nn.Linear(channels * side * side + sized, 2 * width), nn.GELU())
        self.heads = Heads(space, 2 * width, width)
        self.to(memory_format=torch.channels_last)  # type: ignore[call-overload]

    def forward(self, images: Tensor, extents: Tensor | None = None) -> list[Tensor]:
        features = self.features(images.flatten(1, 2).contiguous(memory_format=torch.channels_last))
        with torch.autocast(images.device.type, enabled=False):  # these weights take longer to convert than to multiply
            flat = with_size(features.permute(0, 2, 3, 1).flatten(1).float(), self.size, extents)
            answers: list[Tensor] = self.heads(self.summary(flat))
        return answers


def make_network(
    name: Network, space: ParameterSpace, views: int, size: int, weights: Path | None = None, sized: bool = False
) -> nn.Module:
    """A network fresh from torch's random numbers; weights: a file of VGG19's, see vgg.VGG19Network.

    sized: it takes the size of a shape beside its pictures.
    """
    if name == "compact":
        return CompactNetwork(space, views, size, sized=sized)
    return VGG19Network(space, views, size, weights, sized=sized)


def loss(space: ParameterSpace, outputs: Sequence[Tensor], targets: Tensor, active: Tensor) -> Tensor:
    """Sum over parameters of L1 (scalars) or cross-entropy (others), each the mean over rows where it matters.

    targets, active: (B, P). Paper section 4.2.
    """
    total = targets.new_zeros(())
    scalars = _scalars(space)
    if scalars:
        values = torch.stack([outputs[i][:, 0] for i in scalars], dim=1).float()
        total = total + _mean((values - targets[:, scalars]).abs(), active[:, scalars])
    for i, parameter in enumerate(space):
        if parameter.classes:
            each = functional.cross_entropy(outputs[i].float(), targets[:, i].long(), reduction="none")
            total = total + _mean(each[:, None], active[:, [i]])
    return total


def spread_loss(space: ParameterSpace, outputs: Sequence[Tensor], targets: Tensor, active: Tensor) -> Tensor:
    """Sum over scalars of the Laplace negative log-likelihood of the errors made, the values taken as given."""
    scalars = _scalars(space)
    if not scalars:
        return targets.new_zeros(())
    values, log_spreads = torch.stack([outputs[i] for i in scalars], dim=1).float().unbind(2)
    errors, log_spreads = (values.detach() - targets[:, scalars]).abs(), log_spreads.clamp(*_LOG_SPREAD)
    return _mean(errors * (-log_spreads).exp() + log_spreads, active[:, scalars])


def _scalars(space: ParameterSpace) -> list[int]:
    return [i for i, parameter in enumerate(space) if not parameter.classes]


def _mean(each: Tensor, active: Tensor) -> Tensor:
    """Sum over columns (B, P) of the means over the rows where they matter."""
    weight = active.float()
    return ((each * weight).sum(dim=0) / weight.sum(dim=0).clamp(min=1.0)).sum()
