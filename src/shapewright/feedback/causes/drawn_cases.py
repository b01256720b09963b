"""Why drawings are not replicated: a search finds other parameters or longer Ranges, or areas that differ remain."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from shapewright.building import Workers
from shapewright.comparison.pictures import intersection_over_union
from shapewright.feedback.case import Cause, DrawnCase
from shapewright.feedback.causes.better_replicas import affordable, nearer, prediction_of
from shapewright.feedback.causes.diagnosis import overlooked, too_short
from shapewright.feedback.causes.longer_ranges import replicas_outside
from shapewright.feedback.causes.told import drawn_causes_of
from shapewright.feedback.surfaces.areas import areas
from shapewright.judging.drawing_target import DrawingTarget
from shapewright.judging.judge import Judge
from shapewright.judging.paper import Metric
from shapewright.parameters import ParameterSpace
from shapewright.prediction.predictor import Predictor
from shapewright.progress import Stages
from shapewright.search.budgets import DRAWN_THOROUGH
from shapewright.search.search import SearchStart, refine
from shapewright.shapes import Drawing, Shape

SAME = 0.1
"""Share of the area of both that lies apart (1 - IoU) up to which two drawings are the same to the eye: right for 94 %
of 150 labelled pairs."""
_SHARE = 10.0  # of the evaluations for meshes: drawings are built and measured in a tenth of the time
_APART = "share that lies apart"


class _InPlace(DrawingTarget):
    """A drawing whose distance to a replica is the share of the area of both that lies apart, 0 to 1."""

    @property
    def metric(self) -> Metric:
        return Metric(_APART, SAME, 1.0, f"{_APART} at most {SAME:g}")

    def nearest(self, replica: Shape | None) -> tuple[float, int]:
        if not (self.visible and isinstance(replica, Drawing)):
            return np.nan, 0
        return 1.0 - intersection_over_union(self.shape, replica), 0


def in_place(judge: Judge) -> Judge:
    """A judge of the same drawings by the share of the area of both that lies apart; up to SAME they are the same."""
    shapes = [reference.shape for reference in judge.references]
    targets = tuple(_InPlace(shape, judge.settings) for shape in shapes if isinstance(shape, Drawing))
    settings = replace(judge.settings, judge="paper", threshold=SAME)
    return replace(judge, targets=targets, settings=settings, lead=targets[0])


def drawn_causes(
    cases: Sequence[DrawnCase], predictor: Predictor | None, crew: Workers, judge: Judge, stages: Stages
) -> list[DrawnCase]:
    """The same cases; those that are not replicated know better replicas and their causes. judge: ``in_place``."""
    misfits = [case for case in cases if not case.replicated]
    if not misfits:
        return list(cases)
    space, known = crew.procedure.space, [case.replica for case in misfits]
    extents = [judge.references.extents[case.row] for case in misfits]
    vectors = refine(
        SearchStart(
            prediction_of(space, predictor, known, [case.reference for case in misfits], extents),
            [replica.parameters for replica in known],
        ),
        judge.criterion([case.row for case in misfits]),
        crew,
        affordable(DRAWN_THOROUGH, _SHARE, len(misfits), crew),
        judge.settings.seed,
    )
    nearest = nearer(known, vectors, crew, judge)
    stages.step(2, 4)
    outside = list(nearest)
    far = [i for i, replica in enumerate(nearest) if replica.distance > SAME]
    for i, replica in zip(far, replicas_outside([nearest[i] for i in far], crew, judge), strict=True):
        outside[i] = replica
    stages.step(3, 4)
    searched = []
    for case, inside, beyond in zip(misfits, nearest, outside, strict=True):
        assert isinstance(inside.shape, Drawing)
        left = areas(case.reference, inside.shape)
        known_better = replace(case, nearest=inside, outside=beyond, covering_residuals=left)
        searched.append(replace(known_better, causes=_diagnosed(space, known_better)))
    by_row = {case.row: case for case in [*cases, *searched]}
    return list(by_row.values())


def _diagnosed(space: ParameterSpace, case: DrawnCase) -> tuple[Cause, ...]:
    """The causes of a drawing that is not replicated, the chief one first."""
    if case.nearest.distance <= SAME < case.replica.distance:
        return (overlooked(space, case.replica, case.nearest, _APART),)
    wishes = too_short(space, case, _APART)
    if wishes and case.outside.distance <= SAME:
        return wishes
    return (*drawn_causes_of(case.covering_residuals), *wishes)
