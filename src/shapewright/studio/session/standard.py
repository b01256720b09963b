"""What a collection is judged by: the judge and its cuts, and the paper's measure beside."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from shapewright.judging.paper import Metric, light_field_metric, vif_metric
from shapewright.judging.verdict import Grade, grade_of
from shapewright.report.scale import GRADES, colour
from shapewright.settings import JudgeName, Settings

CUTS = ("judge", "replicated", "close")
"""The settings that a collection may be judged by anew, without measuring it again."""


@dataclass(frozen=True)
class Standard:
    """What gives the grades of a collection."""

    settings: Settings  # the judge and its cuts
    metric: Metric  # the paper's

    @classmethod
    def of(cls, settings: Settings, dimension: int) -> Standard:
        """What a fit with these settings judges by. dimension: 2 for drawings, 3 for meshes."""
        metric = light_field_metric(settings.threshold) if dimension == 3 else vif_metric(settings.vif)
        return cls(settings, metric)

    @classmethod
    def of_run(cls, record: Mapping[str, Any], chosen: Mapping[str, Any] | None = None) -> Standard:
        """What a run was judged by.

        chosen: CUTS to take instead; not where the run has no fidelity to apply them to.
        """
        settings = Settings.from_record(record["settings"])
        known = any(entry.get("fidelity") is not None for entry in record["references"])
        return cls(replace(settings, **chosen) if chosen and known else settings, Metric.of_record(record))

    @property
    def judge(self) -> JudgeName:
        return self.settings.judge

    def by(self, judge: JudgeName) -> Standard:
        """The same with another judge."""
        return replace(self, settings=replace(self.settings, judge=judge))

    def value(self, entry: Mapping[str, Any]) -> float | None:
        """What decides of an entry of a run's record: its fidelity, or by the paper's judge its distance."""
        value: float | None = entry.get("fidelity" if self.judge == "fidelity" else "distance")
        return value

    def grade(self, fidelity: float | None, compatible: bool) -> Grade:
        """The grade of a replica; different where nothing was measured."""
        if self.judge == "paper":
            return "replicated" if compatible else "different"
        return grade_of(math.nan if fidelity is None else fidelity, self.settings)

    def colour(self, grade: Grade, fidelity: float | None, distance: float | None) -> str | None:
        """#rrggbb: of the grade, or by the paper's judge of the distance; None for what is not measured."""
        if self.judge == "fidelity":
            return None if fidelity is None else "#" + bytes(GRADES[grade]).hex()
        metric = self.metric
        return None if distance is None else colour(distance, metric.threshold, metric.far / metric.threshold)

    def judged(self, fidelity: float | None, distance: float | None) -> dict[str, Any]:
        """The fields of ``wire.judgement.Judged`` that follow from what was measured, but for the colour."""
        compatible = self.metric.accepts(distance)
        return {"compatible": compatible, "grade": self.grade(fidelity, compatible)}
