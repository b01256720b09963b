"""A drawing to measure replicas against: pictures instead of light fields."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from shapewright.comparison import outline
from shapewright.comparison.blurred import PARTS, UNIT, BlurredDifference
from shapewright.comparison.gaps import Boundary
from shapewright.comparison.grouping import Group, group
from shapewright.comparison.pictures import intersection_over_union, visual_information_fidelity
from shapewright.comparison.remainders import CUT, mixed
from shapewright.judging.drawn_fidelity import DrawnFidelity
from shapewright.judging.paper import Metric, vif_metric
from shapewright.judging.target import Measures
from shapewright.judging.verdict import Evidence, Grade, grade_by
from shapewright.settings import Settings
from shapewright.shapes import Drawing, Floats, Shape

ENOUGH = 0.8  # black pixels that make no difference: half a percent of a table of thin lines


class DrawingTarget:
    """One drawing. See ``Target``, and ``MeshTarget`` for how it is kept."""

    parts = PARTS
    goal = -np.inf  # the costs say nothing of which replica is surely compatible
    enough = ENOUGH * UNIT  # at which the overlap is all but whole even where lines are thin
    surprise_cost = 0.0  # forms are told apart by their pictures

    def __init__(self, shape: Drawing, settings: Settings) -> None:
        self.shape, self._settings, self._fidelity = shape, settings, DrawnFidelity(shape)
        self._describe = functools.cache(functools.partial(_outline, shape))
        self._boundary = functools.cache(functools.partial(Boundary, shape))
        self._blurred = functools.cache(functools.partial(BlurredDifference, shape))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.shape, self._settings)

    @property
    def outline(self) -> outline.Outline | None:
        """None for a drawing so thin that no pixel shows it."""
        return self._describe()

    @property
    def visible(self) -> bool:
        return self.outline is not None

    @property
    def metric(self) -> Metric:
        return vif_metric(self._settings.vif)

    def objective(self, field: int = 0) -> BlurredDifference | None:
        """Drawings have one view only; field says nothing."""
        return self._blurred() if self.visible else None

    def cost(self, replica: Shape) -> float:
        objective = self.objective()
        residual = objective.residual(replica) if objective else None
        return np.inf if residual is None else float(np.abs(residual[PARTS[-1]]).sum())

    def nearest(self, replica: Shape | None) -> tuple[float, int]:
        """One less the visual information fidelity, and 0."""
        if not (self.visible and isinstance(replica, Drawing) and outline.silhouette(replica).any()):
            return math.nan, 0
        return max(0.0, 1.0 - visual_information_fidelity(self.shape, replica)), 0

    def fidelity(self, replica: Shape | None) -> float:
        return self.evidence(replica).value

    def evidence(self, replica: Shape | None) -> Evidence:
        return self._fidelity.evidence(replica) if self.visible else Evidence(math.nan)

    def measures(self, replica: Shape | None, distance: float | None = None, fidelity: float | None = None) -> Measures:
        distance = self.nearest(replica)[0] if distance is None else distance
        if math.isnan(distance) or not isinstance(replica, Drawing):
            return Measures()
        gaps = self._boundary().gaps(Boundary(replica))
        return Measures(
            distance,
            iou=intersection_over_union(self.shape, replica),
            chamfer=gaps.chamfer,
            fidelity=self.fidelity(replica) if fidelity is None else fidelity,
            f1=gaps.f_score(0.01),
            f2=gaps.f_score(0.02),
        )

    def compatible(self, measures: Measures) -> bool:
        return self.metric.accepts(measures.distance)

    def grade(self, measures: Measures) -> Grade:
        return grade_by(self._settings, measures.fidelity, self.compatible(measures))

    @classmethod
    def groups(
        cls, names: Sequence[str], targets: Sequence[DrawingTarget], settings: Settings, left: Floats | None = None
    ) -> tuple[Group, ...]:
        """By the likeness of their outlines."""
        described = [found for target in targets if (found := target.outline)]
        apart = outline.distances(described, align=settings.align)
        if left is None or len(names) < 2:
            # The absolute cut of the settings is a light-field distance, which has another scale.
            return group(names, apart, settings.cut)
        return group(names, mixed(apart / max(float(apart.max()), 1e-9), left, left), CUT * settings.cut, True)


def _outline(drawing: Drawing) -> outline.Outline | None:
    try:
        return outline.descriptor(drawing)
    except ValueError:
        return None
