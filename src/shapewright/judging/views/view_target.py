"""An object in pictures to measure replicas against: silhouettes, from cameras that are found for each replica."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from shapewright.comparison.blurred import UNIT
from shapewright.comparison.grouping import Group, group
from shapewright.judging.paper import Metric
from shapewright.judging.target import Measures
from shapewright.judging.verdict import Evidence, Grade, grade_by
from shapewright.judging.views.view_fidelity import InView, ViewFidelity
from shapewright.search.views.camera_search import ViewsDifference, parts_of
from shapewright.settings import Settings
from shapewright.shapes import Floats, Mesh, Shape
from shapewright.shapes.views import Views

ENOUGH = 2.0  # pixels of 64 x 64 that make no difference
_LEAST_IOU = 0.9  # of the silhouettes of compatible shapes; the paper has no measure of pictures
_FAR = 0.5  # one less the IoU, from which on two shapes have nothing in common


class ViewTarget:
    """One object; see ``Target``, and ``MeshTarget`` for how it is kept.

    most: the number of views of the reference that has most of them, so that all residuals have one form.
    """

    goal = -np.inf  # the costs say nothing of which replica is surely compatible
    enough = ENOUGH * UNIT
    surprise_cost = 100.0
    """What no picture shows goes by what is likely: one that is e times as likely is worth two of 64 x 64 pixels."""

    def __init__(self, shape: Views, settings: Settings, most: int = 1) -> None:
        self.shape, self._settings, self._most = shape, settings, most
        self.parts = parts_of(most)
        self._difference = ViewsDifference(shape, most)
        self._fidelity = ViewFidelity(shape, self._difference)
        self._last = functools.lru_cache(maxsize=2)(self._in_view)

    def __reduce__(self) -> tuple[Any, ...]:
        return ViewTarget, (self.shape, self._settings, self._most)

    @property
    def visible(self) -> bool:
        return True

    @property
    def metric(self) -> Metric:
        return Metric("1 - IoU in view", 1.0 - _LEAST_IOU, _FAR, f"IoU of the silhouettes at least {_LEAST_IOU:g}")

    def objective(self, field: int = 0) -> ViewsDifference:
        """Cameras are found anew for each replica; field says nothing."""
        return self._difference

    def in_view(self, replica: Shape | None) -> InView | None:
        """The replica in the reference's pictures; None where the two cannot be compared."""
        return self._last(replica)

    def cost(self, replica: Shape) -> float:
        residual = self._difference.residual(replica)
        return np.inf if residual is None else float(np.abs(residual[self.parts[-1]]).sum())

    def nearest(self, replica: Shape | None) -> tuple[float, int]:
        """One less the IoU of the silhouettes, and 0."""
        found = self.in_view(replica)
        return (1.0 - found.iou, 0) if found else (math.nan, 0)

    def fidelity(self, replica: Shape | None) -> float:
        return self.evidence(replica).value

    def evidence(self, replica: Shape | None) -> Evidence:
        found = self.in_view(replica)
        return Evidence(found.value, found.missing, found.surplus) if found else Evidence(math.nan)

    def measures(self, replica: Shape | None, distance: float | None = None, fidelity: float | None = None) -> Measures:
        found = self.in_view(replica) if fidelity is None or distance is None or math.isnan(distance) else None
        distance = (1.0 - found.iou if found else math.nan) if distance is None else distance
        if math.isnan(distance) or not isinstance(replica, Mesh):
            return Measures()
        value = (found.value if found else math.nan) if fidelity is None else fidelity
        return Measures(distance, iou=1.0 - distance, fidelity=value)

    def compatible(self, measures: Measures) -> bool:
        return self.metric.accepts(measures.distance)

    def grade(self, measures: Measures) -> Grade:
        return grade_by(self._settings, measures.fidelity, self.compatible(measures))

    @classmethod
    def groups(
        cls, names: Sequence[str], targets: Sequence[ViewTarget], settings: Settings, left: Floats | None = None
    ) -> tuple[Group, ...]:
        """By the overlap of the first silhouettes: pictures of like objects from other sides are not alike."""
        masks = np.array([target.shape.views[0].mask.ravel() / 255.0 for target in targets])
        apart = np.zeros((len(names), len(names)))
        for row, mask in enumerate(masks):
            apart[row] = 1.0 - np.minimum(masks, mask).sum(axis=1) / np.maximum(masks, mask).sum(axis=1)
        return group(names, apart, settings.cut)

    def _in_view(self, replica: Shape | None) -> InView | None:
        return self._fidelity.in_view(replica)
