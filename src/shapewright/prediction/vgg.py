"""VGG19, the paper's network, in the layout of torchvision, so that its published ImageNet weights load."""

from __future__ import annotations

import warnings
from pathlib import Path

import torch
from torch import Tensor, nn

from shapewright.parameters import ParameterSpace
from shapewright.prediction.heads import Heads, SizeInput, with_size

_LAYERS = (64, 64, "M", 128, 128, "M", 256, 256, 256, 256, "M", 512, 512, 512, 512, "M", 512, 512, 512, 512, "M")
_GREY_MEAN, _GREY_DEVIATION = 0.449, 0.226  # of ImageNet's pictures, over their three colours
_SIDE = 4


class VGG19Network(nn.Module):
    """VGG19's convolutions on every view, and one MLP a parameter on the features of all views, in the cameras' order.

    Takes images (B, C, 2, S, S) in [0, 1], S at least 32; gives what Heads gives. ``features`` has the layers and the
    names of torchvision's vgg19, but its first convolution has two inputs: shading, by the sum of the filters for
    red, green and blue, which is what these do to a grey picture; and depth, by filters that start at zero. Features
    are averaged over space down to at most 4 x 4 cells a view.

    weights: a file with torchvision's vgg19, whole or its features alone. Raises ValueError when it is something else.
    """

    def __init__(
        self,
        space: ParameterSpace,
        views: int,
        size: int,
        weights: Path | None = None,
        width: int = 128,
        sized: bool = False,
    ) -> None:
        super().__init__()
        if size < 32:
            raise ValueError(f"vgg19 halves its pictures five times; it needs at least 32 pixels, not {size}")
        self.features = _features()
        side = size // 32
        cell = -(-side // _SIDE)
        self.pool = nn.AvgPool2d(cell, ceil_mode=True)
        self.size = SizeInput() if sized else None
        self.heads = Heads(space, views * 512 * (-(-side // cell)) ** 2 + sized, width)
        if weights:
            self.features.load_state_dict(_read(weights))

    def forward(self, images: Tensor, extents: Tensor | None = None) -> list[Tensor]:
        every_view = (images.flatten(0, 1) - _GREY_MEAN) / _GREY_DEVIATION
        features = self.pool(self.features(every_view))
        answers: list[Tensor] = self.heads(with_size(features.reshape(len(images), -1), self.size, extents))
        return answers


def find_weights(path: str | Path | None = None) -> Path | None:
    """The file of VGG19's ImageNet weights: the one named, or torchvision's download in torch's cache.

    None, with a warning, when neither exists. Raises ValueError when the named file is missing.
    """
    if path is not None:
        named = Path(path).expanduser()
        if not named.is_file():
            raise ValueError(
                f"{named}: no such file; give torchvision's vgg19 weights, or none to look in torch's cache"
            )
        return named
    cache = Path(torch.hub.get_dir()) / "checkpoints"
    found = sorted(cache.glob("vgg19-*.pth"))
    if not found:
        warnings.warn(
            f"no ImageNet weights of VGG19 (none named, none in {cache}): it is trained from scratch, which takes "
            "longer and may predict worse",
            stacklevel=2,
        )
    return found[0] if found else None


def _features() -> nn.Sequential:
    layers: list[nn.Module] = []
    channels = 2
    for layer in _LAYERS:
        if isinstance(layer, str):
            layers.append(nn.MaxPool2d(2, 2))
        else:
            layers += [nn.Conv2d(channels, layer, 3, padding=1), nn.ReLU(inplace=True)]
            nn.init.kaiming_normal_(layers[-2].weight, mode="fan_out", nonlinearity="relu")  # type: ignore[arg-type]
            nn.init.zeros_(layers[-2].bias)  # type: ignore[arg-type]
            channels = layer
    return nn.Sequential(*layers)


def _read(path: Path) -> dict[str, Tensor]:
    """The weights of the convolutions, the first one's made to fit shading and depth."""
    try:
        state = torch.load(path, map_location="cpu", weights_only=True)
        weights = {name.removeprefix("features."): value for name, value in state.items() if "classifier" not in name}
        first = weights["0.weight"]
        expected = {name: value.shape for name, value in _features().state_dict().items()}
        shapes = {name: value.shape for name, value in weights.items()} | {"0.weight": expected["0.weight"]}
    except Exception as error:
        raise ValueError(f"{path}: not readable as torchvision's vgg19 weights: {error}") from error
    if shapes != expected or first.shape[1] not in (2, 3):
        raise ValueError(f"{path}: not the convolutions of torchvision's vgg19 (without batch normalisation)")
    if first.shape[1] == 3:
        grey = first.sum(dim=1)
        weights["0.weight"] = torch.stack([grey, torch.zeros_like(grey)], dim=1)
    return weights
