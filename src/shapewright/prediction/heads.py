"""Heads: an independent MLP for each parameter, on features that they share."""

from __future__ import annotations

import math
from collections.abc import Sequence

import torch
from torch import Tensor, nn
from torch.nn import functional

from shapewright.parameters import ParameterSpace


class ScalarHead(nn.Module):
    """A scalar's encoded value and the logarithm of its spread, the scale of a Laplace distribution: (B, 2).

    The spread's part learns from the features but teaches them nothing, so the value is the one that a network
    without it would predict.
    """

    def __init__(self, features: int, width: int) -> None:
        super().__init__()
        self.value = _mlp(features, width, 1)
        self.spread = _mlp(features, width, 1)

    def scale_spread(self, factor: float) -> None:
        """Multiply every spread that this head will predict."""
        with torch.no_grad():
            _layer(self.spread, -1).bias.add_(math.log(factor))


class Heads(nn.ModuleDict):
    """Features (B, F) to a list with one tensor a parameter (paper section 4.2: an independent MLP each).

    (B, 2) for a scalar, see ScalarHead; (B, classes) logits for an integer, choice or binary. Each head goes by its
    parameter's name, so that it can be found again after the procedure was edited.
    """

    def __init__(self, space: ParameterSpace, features: int, width: int = 128) -> None:
        super().__init__(
            {
                _key(parameter.name): _mlp(features, width, parameter.classes)
                if parameter.classes
                else ScalarHead(features, width)
                for parameter in space
            }
        )

    def forward(self, features: Tensor) -> list[Tensor]:
        """As each head by itself, but the many small products of all heads are a few large ones."""
        heads = dict(enumerate(self.values()))
        scalars = {i: head for i, head in heads.items() if isinstance(head, ScalarHead)}
        others = {i: head for i, head in heads.items() if isinstance(head, nn.Sequential)}
        answers: dict[int, Tensor] = {}
        if scalars:
            values = _numbers(features, [head.value for head in scalars.values()])
            spreads = _numbers(features.detach(), [head.spread for head in scalars.values()])
            answers |= zip(scalars, torch.stack([values, spreads], dim=2).unbind(1), strict=True)
        if others:
            hidden = _hidden(features, list(others.values())).unbind(1)
            answers |= {i: others[i][-1](row) for i, row in zip(others, hidden, strict=True)}
        return [answers[i] for i in heads]


def head_of(network: nn.Module, name: str) -> nn.Module:
    """The head of one parameter in a network."""
    return network.get_submodule(f"heads.{_key(name)}")


def _key(name: str) -> str:
    """Of a parameter's head: torch allows no point in it, and values of vectors and records have one, as ``size.x``."""
    return f"head_{name.replace('.', '/')}"


def _mlp(features: int, width: int, out: int) -> nn.Sequential:
    return nn.Sequential(nn.Linear(features, width), nn.GELU(), nn.Linear(width, out))


def _layer(mlp: nn.Sequential, index: int) -> nn.Linear:
    layer = mlp[index]
    assert isinstance(layer, nn.Linear)
    return layer


def _joined(layers: Sequence[nn.Linear]) -> tuple[Tensor, Tensor]:
    """Weight and bias of the layer that gives what all of these give, one after the other."""
    return torch.cat([layer.weight for layer in layers]), torch.cat([layer.bias for layer in layers])


def _hidden(features: Tensor, mlps: Sequence[nn.Sequential]) -> Tensor:
    """(B, M, W): what the last layers of M MLPs are given."""
    weight, bias = _joined([_layer(mlp, 0) for mlp in mlps])
    return functional.gelu(functional.linear(features, weight, bias)).reshape(len(features), len(mlps), -1)


def _numbers(features: Tensor, mlps: Sequence[nn.Sequential]) -> Tensor:
    """(B, M): the answers of MLPs that give one number each."""
    weight, bias = _joined([_layer(mlp, -1) for mlp in mlps])
    return (_hidden(features, mlps) * weight).sum(dim=2) + bias


class SizeInput(nn.Module):
    """The size of a shape as one more feature: the logarithm of its longest side, standardised as in training."""

    mean_and_spread: Tensor

    def __init__(self) -> None:
        super().__init__()
        self.register_buffer("mean_and_spread", torch.tensor([0.0, 1.0]))

    def learn(self, extents: Tensor) -> None:
        """Take the mean and the spread of the logarithms of these sides (N,)."""
        logs = extents.log()
        self.mean_and_spread = torch.stack([logs.mean(), logs.std(correction=0).clamp(min=1e-6)])

    def forward(self, extents: Tensor) -> Tensor:
        """(B,) sides to (B, 1)."""
        mean, spread = self.mean_and_spread
        standardised: Tensor = (extents.log() - mean) / spread
        return standardised[:, None]


def with_size(features: Tensor, size: SizeInput | None, extents: Tensor | None) -> Tensor:
    """The features (B, K) of pictures, with the size where the network has that input."""
    if size is None or extents is None:
        return features
    return torch.cat([features, size(extents)], dim=1)
