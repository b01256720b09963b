"""Which way references face, where nobody knows: the quarter turn about the up axis at which a replica fits best."""

from __future__ import annotations

import numpy as np

from shapewright.building import Workers
from shapewright.comparison.posed import PosedDifference
from shapewright.comparison.scans.scan_difference import scan_cost
from shapewright.prediction.predictor import Predictor
from shapewright.progress import Stages
from shapewright.references import Collection
from shapewright.settings import Searching
from shapewright.shapes import Drawing, Mesh, ReferenceShape, Shape, Views

_CLEARLY = 0.9
"""A turn is made only if it lowers the cost to this share: what fits about equally well both ways is not turned."""


def quarter_turns(
    references: Collection, predictor: Predictor, crew: Workers, settings: Searching, stages: Stages
) -> list[int]:
    """How many quarter turns, 0 to 3, bring each reference to face as the procedure's shapes do.

    Each mesh is predicted and built in all four positions; the costs of the replicas decide. Drawings and
    views are not turned, and nothing where the settings take the facing as given.
    """
    if settings.facing == "given" or references.kind is not Mesh or references.in_views:
        return [0] * len(references)
    stages.begin("face", len(references))
    positions = [references.turned([quarters] * len(references)) for quarters in range(4)]
    costs = np.array([_costs(position, predictor, crew) for position in positions])
    turns: list[int] = np.where(costs.min(axis=0) <= _CLEARLY * costs[0], costs.argmin(axis=0), 0).tolist()
    return turns


def _costs(references: Collection, predictor: Predictor, crew: Workers) -> list[float]:
    shapes = [reference.shape for reference in references]
    builds = crew.build(predictor.predict(shapes, references.extents))
    return crew.each(_cost, [(shape, build.shape) for shape, build in zip(shapes, builds, strict=True)])


def _cost(pair: tuple[ReferenceShape, Shape | None]) -> float:
    reference, replica = pair
    if isinstance(reference, Drawing | Views) or not isinstance(replica, Mesh):
        return np.inf
    return PosedDifference(reference)(replica) if isinstance(reference, Mesh) else scan_cost(reference, replica)
