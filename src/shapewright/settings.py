"""Everything that decides how an iteration runs, in one value."""

from __future__ import annotations

from dataclasses import asdict, dataclass, fields
from typing import Any, Literal


@dataclass(frozen=True)
class Settings:
    """How an iteration runs.

    seed: of everything random. samples: parameter vectors drawn from the space. epochs, batch, learning_rate: training.
    image_size: pixels of a view, a multiple of 16. refine: how long to search for better parameters from the predicted
    ones, by the judge's measure. threshold: the largest normalised light-field distance of a
    compatible reference (paper: 0.18). cut: groups are merged up to this share of the largest distance between
    incompatible references (paper: 0.4), or up to this distance itself when cut_absolute. align: "free" compares in
    all rotations as the paper does, "upright" about the up axis only. shape_seconds, shape_memory_mb: what building
    one shape may cost. workers: processes and threads used; all cores by default.
    """

    seed: int = 0
    samples: int = 3000
    epochs: int = 20
    batch: int = 64
    learning_rate: float = 2e-3
    image_size: int = 64
    refine: Literal["off", "quick", "thorough"] = "quick"
    threshold: float = 0.18
    cut: float = 0.4
    cut_absolute: bool = False
    align: Literal["free", "upright"] = "free"
    shape_seconds: float = 10.0
    shape_memory_mb: int = 2048
    workers: int | None = None

    def __post_init__(self) -> None:
        for name in ("samples", "epochs", "batch", "learning_rate", "threshold", "shape_seconds", "shape_memory_mb"):
            if not getattr(self, name) > 0:
                raise ValueError(f"{name}={getattr(self, name)} must be greater than 0")
        if self.samples < 20:
            raise ValueError(f"samples={self.samples}: a network needs at least 20 samples to learn from")
        if self.image_size < 16 or self.image_size % 16:
            raise ValueError(f"image_size={self.image_size} must be a multiple of 16")
        if not 0.0 < self.cut <= 1.0 and not self.cut_absolute:
            raise ValueError(f"cut={self.cut} must lie in (0, 1]")

    def record(self) -> dict[str, Any]:
        """As plain values, for a file."""
        return asdict(self)

    @classmethod
    def from_record(cls, record: dict[str, Any]) -> Settings:
        """The inverse of ``record``; entries of other versions are left out."""
        known = {field.name for field in fields(cls)}
        return cls(**{name: value for name, value in record.items() if name in known})
