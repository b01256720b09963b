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
    threads = judge.settings.workers
    pairs = [(replica, _mesh(judge, replica.row)) for replica in _replicas(iteration, crew)]
    surfaces = in_threads(VisibleSurface.of, [reference for _, reference in pairs], threads)
    compared = in_threads(
        lambda pair: residuals(*pair),
        [(surface, replica.mesh) for surface, (replica, _) in zip(surfaces, pairs, strict=True)],
        threads,
    )
    return [
        Case.of(iteration.names[replica.row], reference, iteration.results[replica.row].compatible, replica, where)
        for (replica, reference), where in zip(pairs, compared, strict=True)
    ]


def _replicas(iteration: Iteration, crew: Workers) -> list[Replica]:
    """The iteration's replicas, built again: those that it keeps on disk have no labels."""
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


def _mesh(judge: Judge, row: int) -> Mesh:
    shape = judge.references.references[row].shape
    assert isinstance(shape, Mesh)
    return shape
