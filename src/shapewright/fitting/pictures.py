"""What pictures are to a procedure: drawings, or views of the objects that it makes."""

from __future__ import annotations

from shapewright.building import Workers
from shapewright.procedures import Procedure
from shapewright.references import Collection
from shapewright.settings import Settings
from shapewright.shapes import Drawing, Mesh


def suited(references: Collection, crew: Workers) -> Collection:
    """The references as the crew's procedure can replicate them: pictures are views of objects where it builds meshes.

    Its defaults are built to see what it builds, and only where the references are drawings. Raises CollectionError
    where no picture can be read as one of an object.
    """
    if references.kind is not Drawing:
        return references
    made = crew.build([crew.procedure.space.defaults])[0].shape
    return references.as_views() if isinstance(made, Mesh) else references


def suited_to(procedure: Procedure, references: Collection, settings: Settings) -> Collection:
    """The same for a procedure, in workers of its own. Raises ProcedureError where it cannot be loaded."""
    if references.kind is not Drawing:
        return references
    with Workers.of(procedure, settings) as crew:
        return suited(references, crew)
