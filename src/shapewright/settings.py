"""Everything that decides how an iteration runs, in one value.

Each field is one line: its name, its type, its bounds, what it is, and its default. Checks, messages, the options of
the command line and the studio's page are made from these lines.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import cache
from typing import Annotated, Any, Literal, TypeAlias

from shapewright.fields import Field, Within, either, fields_of, meant

Align: TypeAlias = Literal["free", "upright"]
Cameras: TypeAlias = Literal["fixed", "learned"]
Device: TypeAlias = Literal["auto", "cpu", "cuda", "mps"]
Facing: TypeAlias = Literal["given", "found"]
Duplicates: TypeAlias = Literal["each", "once", "near"]
JudgeName: TypeAlias = Literal["fidelity", "paper"]
Network: TypeAlias = Literal["compact", "vgg19"]
Optimiser: TypeAlias = Literal["adamw", "adam"]
Preset: TypeAlias = Literal["fast", "paper"]
Refine: TypeAlias = Literal["off", "quick", "thorough"]
Split: TypeAlias = Literal["off", "apart", "names"]
Weights: TypeAlias = tuple[float, float, float, float]

DROPPED = ("sure", "ground", "backdrop", "frustum", "loose", "nothing")
"""Words of ``drop``: what is found without doubt, or all of a kind."""


@dataclass(frozen=True, kw_only=True)
class Preparing:
    """What of a collection is fitted."""

    drop: Annotated[str, "What is no part of a shape: sure, ground, backdrop, frustum, loose, or nothing."] = "sure"
    split: Annotated[Split, "Makes references of objects in one file: those far apart, or each name."] = "off"
    duplicates: Annotated[Duplicates, "once: equal references follow the first; near: similar ones too."] = "once"
    leave_out: Annotated[str, "References that are not fitted: names or patterns, with commas between."] = ""

    @property
    def dropped(self) -> tuple[str, ...]:
        """The words of ``drop``."""
        return tuple(word for word in _words(self.drop) if word != "nothing")

    @property
    def patterns(self) -> tuple[str, ...]:
        """Those of ``leave_out``."""
        return _words(self.leave_out)


@dataclass(frozen=True, kw_only=True)
class Building:
    """What building may cost.

    ``within`` is divided between samples and search by what a shape costs; a run records the numbers that this gave as
    its ``samples`` and ``refine_shapes``, and no ``within``, so that its settings give the same again.
    """

    shape_seconds: Annotated[float, Within(above=0), "Seconds that building one shape may take."] = 10.0
    within: Annotated[
        float | None, Within(above=0), "Seconds that a whole fit may take; None: as long as it takes."
    ] = None
    shape_memory_mb: Annotated[int, Within(least=1), "Megabytes that building one shape may take."] = 2048
    verbose: Annotated[bool, "Show all that the procedure prints; else the last lines, with a failure."] = False


@dataclass(frozen=True, kw_only=True)
class Learning:
    """How a network learns to predict parameters from pictures of shapes."""

    samples: Annotated[int, Within(least=20), "Parameter vectors to learn from."] = 3000
    network: Annotated[Network, "compact is made for CPUs; vgg19 is the paper's."] = "compact"
    weights: Annotated[str | None, "File of vgg19's ImageNet weights; None takes those in torch's cache."] = None
    device: Annotated[Device, "What trains the network; auto takes the fastest there is."] = "auto"
    epochs: Annotated[int, Within(least=1), "Passes of training over the samples."] = 15
    batch: Annotated[int, Within(least=8), "Samples of one training step."] = 64
    learning_rate: Annotated[float, Within(above=0), "Largest step of the network's training."] = 2e-3
    weight_decay: Annotated[float, Within(least=0), "How strongly training keeps the network's weights small."] = 1e-2
    optimiser: Annotated[Optimiser, "adamw's learning rate rises and falls; adam's is constant."] = "adamw"
    image_size: Annotated[int, Within(least=16, step=16), "Pixels along the side of a picture."] = 64
    views: Annotated[int, Within(least=1, most=32), "Number of cameras."] = 3
    camera_distance: Annotated[float, Within(least=1.8, most=6), "Of a camera at first, in sizes of the shape."] = 2.6
    cameras: Annotated[Cameras, "learned moves the cameras while the network learns."] = "fixed"
    camera_rate: Annotated[float, Within(above=0), "Step of learned cameras, in radians and units of distance."] = 0.03
    augment: Annotated[bool, "Train on shapes that are turned, stretched and jittered a little."] = False
    warm_epochs: Annotated[int, Within(least=1), "Passes of training that resumes an earlier network."] = 5
    warm_samples: Annotated[int, Within(least=20), "Most parameter vectors that it learns from then."] = 2000
    rounds: Annotated[int, Within(least=0), "Rounds of more samples around the parameters found so far."] = 0
    round_samples: Annotated[int, Within(least=1), "Parameter vectors of a round; it trains for warm_epochs."] = 1000


@dataclass(frozen=True, kw_only=True)
class Searching:
    """How parameters better than the predicted ones are searched for, by the judge's measure.

    Only procedures that need more than about 40 ms a mesh, or 4 ms a drawing, reach ``refine_seconds``. How far these
    are searched depends on the machine, but for few references: a search may build as many shapes as the samples are.
    """

    facing: Annotated[Facing, "found turns each reference by the quarter turns that fit best."] = "given"
    refine: Annotated[Refine, "How long to search from the prediction."] = "quick"
    refine_seconds: Annotated[float, Within(above=0), "For each reference, of building; thorough: ten times."] = 5.0
    refine_shapes: Annotated[int | None, Within(least=1), "The same in shapes; None: by refine_seconds."] = None


@dataclass(frozen=True, kw_only=True)
class Judging:
    """When a replica counts as its reference, and how the other references are grouped.

    The paper's measure, with threshold and vif, is always taken; it decides where it is the judge.
    """

    judge: Annotated[JudgeName, "fidelity: as a person sees it; paper: by light-field distance or VIF."] = "fidelity"
    replicated: Annotated[float, Within(above=0, below=1), "Least fidelity of a replicated reference."] = 0.65
    close: Annotated[float, Within(above=0, below=1), "Least fidelity of a close one; at most replicated."] = 0.35
    threshold: Annotated[float, Within(above=0), "Largest light-field distance of a compatible mesh."] = 0.18
    metric: Annotated[Weights | None, "Learned from marks: bias; weights of distance, IoU and depth difference."] = None
    vif: Annotated[float, Within(above=0, below=1), "Least visual information fidelity of a compatible drawing."] = 0.05
    cut: Annotated[float, Within(above=0), "Groups merge up to this share of the largest distance."] = 0.4
    cut_absolute: Annotated[bool, "Groups merge up to the distance cut itself."] = False
    align: Annotated[Align, "Compare in all rotations, or about the up axis only."] = "free"


@dataclass(frozen=True, kw_only=True)
class Settings(Judging, Searching, Learning, Building, Preparing):
    """How an iteration runs: ``Settings(seed=1, refine="off")``. Every field of the five groups is one of its own.

    Raises ValueError for a value that its field does not allow, TypeError for an unknown name.
    """

    seed: Annotated[int, Within(least=0), "Of everything random: the same seed gives the same result."] = 0
    workers: Annotated[int | None, Within(least=1), "Processes and threads; None takes all cores."] = None

    def __new__(cls, **given: Any) -> Settings:
        unknown = [name for name in given if name not in described()]
        if unknown:
            raise TypeError(f"there is no setting {unknown[0]!r}{meant(unknown[0], described())}")
        return super().__new__(cls)

    def __post_init__(self) -> None:
        for name, field in described().items():
            object.__setattr__(self, name, field.checked(getattr(self, name)))
        if self.network == "vgg19" and self.image_size < 32:
            raise ValueError(f"image_size={self.image_size} must be at least 32 for network='vgg19'")
        if self.cut > 1.0 and not self.cut_absolute:
            raise ValueError(f"cut={self.cut} must be at most 1, or a distance together with cut_absolute=True")
        for word in _words(self.drop):
            if word not in DROPPED:
                raise ValueError(f"drop={self.drop!r}: {word!r} must be {either(DROPPED)}{meant(word, DROPPED)}")
        if self.close > self.replicated:
            raise ValueError(f"close={self.close} must be at most replicated={self.replicated}")

    @classmethod
    def preset(cls, name: Preset, **changes: Any) -> Settings:
        """The settings of that name, with changes: "fast" is the default, made for laptops; "paper" is the paper's.

        The paper's network, training and cameras are those of its section 4.2; it takes hours without a GPU.
        Raises ValueError for another name.
        """
        if name not in _PRESETS:
            raise ValueError(f"preset={name!r}: there is {' and '.join(_PRESETS)}{meant(name, _PRESETS)}")
        return cls(**{**_PRESETS[name], **changes})

    def record(self) -> dict[str, Any]:
        """All fields as plain values, for a file."""
        return {name: getattr(self, name) for name in described()}

    @classmethod
    def from_record(cls, record: Mapping[str, Any]) -> Settings:
        """The inverse of ``record``, of this or an older version.

        Unknown entries are left out. So are values that are not allowed: older versions took them for the default.
        The first versions had the paper's judge alone, and called ``vif`` fidelity.
        """
        known = described()
        if "judge" not in record:
            record = {"judge": "paper", "vif": record.get("fidelity"), **record}
        return cls(**{name: value for name, value in record.items() if name in known and known[name].allows(value)})


@cache
def described() -> Mapping[str, Field]:
    """What each setting may be, by name."""
    return fields_of(Settings)


@cache
def groups() -> Mapping[str, tuple[str, ...]]:
    """The names of the settings of each group, by the group's name in small letters."""
    kinds = (Preparing, Building, Learning, Searching, Judging)
    return {kind.__name__.lower(): tuple(field.name for field in fields(kind)) for kind in kinds}


def _words(text: str) -> tuple[str, ...]:
    return tuple(word.strip() for word in text.split(",") if word.strip())


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
        "judge": "paper",
    },
}
