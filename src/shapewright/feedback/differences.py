"""Where each replica of an iteration differs from its reference."""

from __future__ import annotations

import numpy as np

from shapewright.building import Workers
from shapewright.feedback.case import Case, Replica
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.judging.judge import Judge
from shapewright.runs.iteration import Iteration
from shapewright.shapes import Mesh
from shapewright.threads import in_threads


def differences(iteration: Iteration, crew: Workers, judge: Judge) -> list[Case]:
    """A case for each reference whose replica can be built and measured.

    judge: knows the iteration's references, in its order.
    """

    def case(replica: Replica) -> Case:
        result, reference = iteration.results[replica.row], judge.references.references[replica.row].shape
        assert isinstance(reference, Mesh)
        where = residuals(VisibleSurface.of(reference), replica.mesh)
        return Case.of(result.name, reference, result.compatible, replica, where)

    return in_threads(case, _replicas(iteration, crew), judge.settings.workers)


def _replicas(iteration: Iteration, crew: Workers) -> list[Replica]:
    """The iteration's replicas, built again: the files of a run keep them in single precision."""
    names = crew.procedure.space.names
    results = iteration.results
    vectors = {
        row: {name: result.parameters[name] for name in names}
        for row, result in enumerate(results)
        if result.replica is not None and result.parameters
    }
    builds = crew.build(list(vectors.values()), give_up=True)
    return [
        Replica(row, build.parameters, build.shape, results[row].distance)
        for row, build in zip(vectors, builds, strict=True)
        if isinstance(build.shape, Mesh) and np.isfinite(results[row].distance)
    ]
