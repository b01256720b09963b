"""Everything that decides how an iteration runs, in one value."""

from __future__ import annotations

from dataclasses import asdict, dataclass, fields
from typing import Any, Literal


@dataclass(frozen=True)
class Settings:
    """How an iteration runs.

    seed: of everything random. samples: parameter vectors drawn from the space.

    network: "compact" is made for CPUs, "vgg19" is the paper's; weights: a file of its ImageNet weights, by default
    those in torch's cache. device: what it is trained on, "auto" the fastest there is. epochs, batch, learning_rate,
    weight_decay: training; optimiser: "adamw" with a learning rate that rises and falls, or "adam" at a constant one.
    image_size: pixels of a view, a multiple of 16. views: cameras; camera_distance: of each at the start, in units of
    the shape's largest extent. cameras: "learned" moves them with the network, at the learning rate camera_rate, in
    radians and units of distance.

    augment: train on shapes that are turned, stretched and jittered a little, as scanned and modelled references are.

    warm_epochs, warm_samples: of a network that goes on from an earlier one. rounds: of adaptive sampling, each with
    round_samples more samples around what was found for the references and warm_epochs more of training.

    facing: "given" takes references as they are, "found" turns each about the up axis by the quarter turns at which the
    procedure fits it best.

    refine: how long to search for better parameters from the predicted ones, by the judge's measure; refine_seconds:
    what building shapes for that may cost for each reference, on one core (ten times as much when thorough). Only slow
    procedures reach it, from about 40 ms a mesh and 4 ms a drawing; how far they are searched depends on the machine.

    threshold: the largest normalised light-field distance of a compatible reference (paper: 0.18); fidelity: of a
    drawing instead the least visual information fidelity (VIF), above which the paper counts from 0.05. metric: decides
    in place of the threshold, if given: bias and weights of distance, IoU and depth difference, learned from marks.

    cut: groups are merged up to this share of the largest distance between incompatible references (paper: 0.4), or up
    to this distance itself when cut_absolute. align: "free" compares in all rotations as the paper does, "upright"
    about the up axis only.

    shape_seconds, shape_memory_mb: what building one shape may cost. workers: processes and threads; all cores by
    default.
    """

    seed: int = 0
    samples: int = 3000
    network: Literal["compact", "vgg19"] = "compact"
    weights: str | None = None
    device: Literal["auto", "cpu", "cuda", "mps"] = "auto"
    epochs: int = 15
    batch: int = 64
    learning_rate: float = 2e-3
    weight_decay: float = 1e-2
    optimiser: Literal["adamw", "adam"] = "adamw"
    image_size: int = 64
    views: int = 3
    camera_distance: float = 2.6
    cameras: Literal["fixed", "learned"] = "fixed"
    camera_rate: float = 0.03
    augment: bool = False
    warm_epochs: int = 5
    warm_samples: int = 2000
    rounds: int = 0
    round_samples: int = 1000
    facing: Literal["given", "found"] = "given"
    refine: Literal["off", "quick", "thorough"] = "quick"
    refine_seconds: float = 5.0
    threshold: float = 0.18
    metric: tuple[float, float, float, float] | None = None
    fidelity: float = 0.05
    cut: float = 0.4
    cut_absolute: bool = False
    align: Literal["free", "upright"] = "free"
    shape_seconds: float = 10.0
    shape_memory_mb: int = 2048
    workers: int | None = None

    def __post_init__(self) -> None:
        for name in (
            "samples",
            "epochs",
            "batch",
            "learning_rate",
            "refine_seconds",
            "threshold",
            "shape_seconds",
            "shape_memory_mb",
        ):
            if not getattr(self, name) > 0:
                raise ValueError(f"{name}={getattr(self, name)} must be greater than 0")
        if not 0.0 < self.fidelity < 1.0:
            raise ValueError(f"fidelity={self.fidelity} must lie between 0 and 1")
        if self.batch < 8:
            raise ValueError(f"batch={self.batch}: a training step needs at least 8 samples")
        if self.samples < 20:
            raise ValueError(f"samples={self.samples}: a network needs at least 20 samples to learn from")
        if not 1 <= self.views <= 32:
            raise ValueError(f"views={self.views} must lie between 1 and 32")
        if not 1.8 <= self.camera_distance <= 6.0:
            raise ValueError(f"camera_distance={self.camera_distance} must lie between 1.8 and 6")
        if not (self.camera_rate > 0 and self.weight_decay >= 0):
            raise ValueError("camera_rate must be greater than 0, and weight_decay at least 0")
        if self.network == "vgg19" and self.image_size < 32:
            raise ValueError(f"image_size={self.image_size}: vgg19 needs at least 32")
        if self.image_size < 16 or self.image_size % 16:
            raise ValueError(f"image_size={self.image_size} must be a multiple of 16")
        if not 0.0 < self.cut <= 1.0 and not self.cut_absolute:
            raise ValueError(f"cut={self.cut} must lie in (0, 1]")

    @classmethod
    def preset(cls, name: Literal["fast", "paper"], **changes: Any) -> Settings:
        """The settings of that name, with changes: "fast" is the default, made for laptops; "paper" is the paper's.

        The paper's network, training and cameras are those of its section 4.2; it takes hours without a GPU.
        Raises ValueError for another name.
        """
        if name not in _PRESETS:
            raise ValueError(f"preset={name!r}: there is {' and '.join(_PRESETS)}")
        return cls(**{**_PRESETS[name], **changes})

    def record(self) -> dict[str, Any]:
        """As plain values, for a file."""
        return asdict(self)

    @classmethod
    def from_record(cls, record: dict[str, Any]) -> Settings:
        """The inverse of ``record``; entries of other versions are left out."""
        known = {field.name for field in fields(cls)}
        plain: dict[str, Any] = {name: tuple(v) if isinstance(v, list) else v for name, v in record.items()}
        return cls(**{name: value for name, value in plain.items() if name in known})


_PRESETS: dict[str, dict[str, Any]] = {
    "fast": {},
    "paper": {
        "samples": 3000,
        "network": "vgg19",
        "epochs": 50,
        "batch": 32,
        "learning_rate": 1e-5,
        "weight_decay": 1e-8,
        "optimiser": "adam",
        "image_size": 256,
        "views": 3,
        "cameras": "learned",
        "camera_rate": 5e-4,
        "refine": "off",
    },
}
