"""The network: features of several views, and an independent head for each parameter."""

from __future__ import annotations

from collections.abc import Sequence

from torch import Tensor, nn
from torch.nn import functional

from shapewright.parameters import ParameterSpace

WIDTHS = (32, 64, 96, 128)


class CompactNetwork(nn.Module):
    """A strided CNN over the stacked views and one MLP a parameter, small enough to train on a CPU in a minute.

    Takes images (B, C, 2, S, S) in [0, 1]; gives a list with one tensor a parameter: (B, 1) for a scalar, the encoded
    value, or (B, classes) logits for an integer, choice or binary (paper section 4.2: an independent MLP each).
    """

    def __init__(self, space: ParameterSpace, views: int, size: int = 64, width: int = 128) -> None:
        super().__init__()
        layers: list[nn.Module] = []
        channels = 2 * views
        for out in WIDTHS:
            layers += [nn.Conv2d(channels, out, 3, stride=2, padding=1, bias=False), nn.BatchNorm2d(out), nn.GELU()]
            channels = out
        side = size // 2 ** len(WIDTHS)
        self.features = nn.Sequential(*layers, nn.Flatten(), nn.Linear(channels * side * side, 2 * width), nn.GELU())
        self.heads = nn.ModuleList(
            nn.Sequential(nn.Linear(2 * width, width), nn.GELU(), nn.Linear(width, max(parameter.classes, 1)))
            for parameter in space
        )

    def forward(self, images: Tensor) -> list[Tensor]:
        features = self.features(images.flatten(1, 2))
        return [head(features) for head in self.heads]


def loss(space: ParameterSpace, outputs: Sequence[Tensor], targets: Tensor, active: Tensor) -> Tensor:
    """Sum over parameters of L1 (scalars) or cross-entropy (others), each the mean over rows where it matters.

    targets, active: (B, P). Paper section 4.2.
    """
    total = targets.new_zeros(())
    for column, (parameter, output) in enumerate(zip(space, outputs, strict=True)):
        target, weight = targets[:, column], active[:, column].float()
        if parameter.classes:
            each = functional.cross_entropy(output.float(), target.long(), reduction="none")
        else:
            each = (output[:, 0].float() - target).abs()
        total = total + (each * weight).sum() / weight.sum().clamp(min=1.0)
    return total
