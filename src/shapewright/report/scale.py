"""What a report orders and colours references by: their fidelity, or by the paper's judge their distance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from shapewright.judging.paper import FAR, Metric
from shapewright.judging.verdict import Grade
from shapewright.runs.result import grade_in, judge_in
from shapewright.settings import JudgeName, Settings

# The paper's colours: green for a perfect replica, yellow at the threshold, red where the metric says far.
GREEN, YELLOW, RED = (62, 166, 100), (247, 205, 70), (222, 74, 62)
NONE = "#9a9a9a"
GRADES: Mapping[Grade, tuple[int, int, int]] = {"replicated": GREEN, "close": YELLOW, "different": RED}
TINTS = 25
"""Filters that tint thumbnails by distance; each has the nearest one, not one of its own."""


@dataclass(frozen=True)
class Scale:
    """How a run's references are shown, each an entry of its record."""

    judge: JudgeName
    cuts: Mapping[str, float]  # the values at which grades begin, by what to call them
    highest: float  # the largest value that a bar shows
    tints: Sequence[str]  # #rrggbb, the colours of ``tint``
    far: float = FAR  # thresholds from which on distances are red

    @classmethod
    def of(cls, record: Mapping[str, Any]) -> Scale:
        if judge_in(record) == "fidelity":
            settings = Settings.from_record(record["settings"])
            cuts = {"replicated": settings.replicated, "close": settings.close}
            return cls("fidelity", cuts, 1.0, [_hex(colour) for colour in GRADES.values()])
        threshold, metric = record["threshold"], Metric.of_record(record)
        far = metric.far / threshold
        highest = max([min(1.5, far) * threshold, *(entry["distance"] or 0.0 for entry in record["references"])])
        tints = [colour(far * threshold * i / (TINTS - 1), threshold, far) for i in range(TINTS)]
        return cls("paper", {"threshold": threshold}, highest, tints, far)

    @property
    def name(self) -> str:
        """Of the values."""
        return "fidelity" if self.judge == "fidelity" else "distance"

    @property
    def word(self) -> str:
        """What a reference is that the procedure makes."""
        return "replicated" if self.judge == "fidelity" else "compatible"

    def value(self, entry: Mapping[str, Any]) -> float | None:
        """None without a replica."""
        value: float | None = entry.get(self.name)
        return value

    def title(self, entry: Mapping[str, Any]) -> str:
        """What its value is, and what that says: "Fidelity, close"."""
        same = "compatible" if entry["compatible"] else "incompatible"
        return f"{self.name.capitalize()}, {grade_in(entry) if self.judge == 'fidelity' else same}"

    def ordered(self, entries: Sequence[Mapping[str, Any]]) -> list[str]:
        """Their names, the best first, those without a replica last."""
        sign = -1.0 if self.judge == "fidelity" else 1.0

        def key(entry: Mapping[str, Any]) -> tuple[bool, float]:
            value = self.value(entry)
            return value is None, sign * (value or 0.0)

        return [entry["name"] for entry in sorted(entries, key=key)]

    def tint(self, entry: Mapping[str, Any]) -> int | None:
        """The index of its colour among ``tints``; None without a replica."""
        value = self.value(entry)
        if value is None:
            return None
        if self.judge == "fidelity":
            return list(GRADES).index(grade_in(entry))
        return round(min(value / (self.far * self.cuts["threshold"]), 1.0) * (TINTS - 1))

    def colour(self, entry: Mapping[str, Any]) -> str:
        """#rrggbb: of its grade, or of its distance; grey without a replica."""
        value = self.value(entry)
        if value is None:
            return NONE
        if self.judge == "fidelity":
            return _hex(GRADES[grade_in(entry)])
        return colour(value, self.cuts["threshold"], self.far)


def colour(distance: float | None, threshold: float, far: float = FAR) -> str:
    """#rrggbb of a distance: green at 0, yellow at the threshold, red at ``far`` thresholds and on; grey for None."""
    if distance is None:
        return NONE
    near = distance <= threshold
    start, end = (GREEN, YELLOW) if near else (YELLOW, RED)
    part = distance / threshold if near else min(1.0, (distance / threshold - 1.0) / (far - 1.0))
    return "#" + "".join(f"{round(a + (b - a) * part):02x}" for a, b in zip(start, end, strict=True))


def _hex(rgb: tuple[int, int, int]) -> str:
    return "#" + bytes(rgb).hex()
