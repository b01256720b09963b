"""Which rule of a grammar made the part of a replica that a region lies on or next to."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.spatial import cKDTree

from shapewright.building import Limits, Workers
from shapewright.comparison.surfaces import sample
from shapewright.feedback.surfaces.residuals import Region, Residuals
from shapewright.parameters import Parameters
from shapewright.procedures import Procedure
from shapewright.shapes import Mesh

_POINTS = 3000


def with_rules(
    procedure: Procedure,
    parameters: Sequence[Parameters],
    found: Sequence[Residuals],
    workers: int | None = None,
    limits: Limits | None = None,
) -> list[Residuals]:
    """The same residuals, their regions with the names of the rules that made what they lie on or are nearest to.

    parameters: of the replicas, which are built once more with faces that tell their rules. Nothing changes for a
    procedure without a grammar.
    """
    if "shapewright.modelling.grammar" not in sys.modules or not found:
        return list(found)
    with Workers(procedure, workers, limits, names="rule") as crew:
        builds = crew.build(parameters)
    return [
        _told(residuals, build.shape) if isinstance(build.shape, Mesh) else residuals
        for residuals, build in zip(found, builds, strict=True)
    ]


def _told(residuals: Residuals, by_rule: Mesh) -> Residuals:
    labels = by_rule.face_labels
    if labels is None or set(by_rule.label_names) == set(residuals.mesh.label_names):
        return residuals
    drawn = sample(by_rule, _POINTS)
    tree = cKDTree(drawn.points)

    def rule(region: Region) -> str | None:
        _, nearest = tree.query(residuals.placement.invert(region.points))
        names, counts = np.unique(labels[drawn.faces[nearest]], return_counts=True)
        commonest = int(names[counts.argmax()])
        return by_rule.label_names[commonest] if commonest >= 0 else None

    return replace(residuals, regions=tuple(replace(region, rule=rule(region)) for region in residuals.regions))
