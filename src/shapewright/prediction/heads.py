"""Heads: an independent MLP for each parameter, on features that they share."""

from __future__ import annotations

import math

import torch
from torch import Tensor, nn

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

    def forward(self, features: Tensor) -> Tensor:
        return torch.cat([self.value(features), self.spread(features.detach())], dim=1)

    def scale_spread(self, factor: float) -> None:
        """Multiply every spread that this head will predict."""
        last = self.spread[-1]
        assert isinstance(last, nn.Linear)
        with torch.no_grad():
            last.bias.add_(math.log(factor))


class Heads(nn.ModuleDict):
    """Features (B, F) to a list with one tensor a parameter (paper section 4.2: an independent MLP each).

    (B, 2) for a scalar, see ScalarHead; (B, classes) logits for an integer, choice or binary. Each head goes by its
    parameter's name, so that it can be found again after the procedure was edited.
    """

    def __init__(self, space: ParameterSpace, features: int, width: int = 128) -> None:
        super().__init__(
            {
                f"head_{parameter.name}": _mlp(features, width, parameter.classes)
                if parameter.classes
                else ScalarHead(features, width)
                for parameter in space
            }
        )

    def forward(self, features: Tensor) -> list[Tensor]:
        return [head(features) for head in self.values()]


def head_of(network: nn.Module, name: str) -> nn.Module:
    """The head of one parameter in a network."""
    return network.get_submodule(f"heads.head_{name}")


def _mlp(features: int, width: int, out: int) -> nn.Sequential:
    return nn.Sequential(nn.Linear(features, width), nn.GELU(), nn.Linear(width, out))
