"""When a reference counts as replicated, as the paper has it: the distances of meshes and of drawings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

FAR = 2.5  # thresholds from which on meshes have nothing in common: the paper's figures colour them red


@dataclass(frozen=True)
class Metric:
    """A distance and its threshold, for a run's record."""

    name: str  # of the distance
    threshold: float  # the largest distance of a compatible reference
    far: float  # the distance from which on shapes have nothing in common; the end of the colours in reports
    criterion: str  # when a reference is compatible, in words

    @classmethod
    def of_record(cls, record: Mapping[str, Any]) -> Metric:
        """Of a run's record; the first versions compared meshes alone, and noted only the threshold."""
        return cls(**record["metric"]) if "metric" in record else light_field_metric(record["threshold"])

    def accepts(self, distance: float | None) -> bool:
        """Whether a reference at this distance is compatible; not where the distance is NaN or None."""
        return distance is not None and distance <= self.threshold


def light_field_metric(threshold: float) -> Metric:
    """The light-field distance of meshes (paper section 4.3)."""
    return Metric("light-field distance", threshold, FAR * threshold, f"light-field distance at most {threshold:g}")


def vif_metric(least: float) -> Metric:
    """The visual information fidelity (VIF) of drawings (paper section 6.2), as a distance: 1 - VIF."""
    return Metric("1 - VIF", 1.0 - least, 1.0, f"visual information fidelity at least {least:g}")
