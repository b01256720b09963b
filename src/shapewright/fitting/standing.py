"""Up and front of references, found by what the procedure makes."""

from __future__ import annotations

from shapewright.building import Workers
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Stages
from shapewright.references import Collection
from shapewright.references.standing import AUTO
from shapewright.settings import Settings
from shapewright.shapes import Mesh

SAMPLES = 300
"""Shapes of the procedure that are learned from. docs/benchmarks.md has other numbers."""


def stand(
    procedure: Procedure, references: Collection, settings: Settings | None = None, progress: Listener | None = None
) -> Collection:
    """The references as they stand beside shapes of the procedure, where up is "auto"; as they are elsewhere.

    It takes seconds. Raises ProcedureError when the procedure cannot build shapes.
    """
    if references.up != AUTO or references.kind is not Mesh:
        return references
    settings, stages = settings or Settings(), Stages(progress)
    vectors = procedure.space.sample(SAMPLES, seed=settings.seed)
    stages.begin("axes", len(vectors))
    with Workers.of(procedure, settings) as crew:
        builds = crew.build(vectors, stages.step, give_up=True)
    found = references.stood([build.shape for build in builds if isinstance(build.shape, Mesh)], settings.workers)
    stages.end()
    return found
