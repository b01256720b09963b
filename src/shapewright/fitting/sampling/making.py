"""What is made of one built shape: the bytes of its file, and its soundness."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from shapewright.building import Build, Failure
from shapewright.parameters import Parameters
from shapewright.procedures import Facts
from shapewright.shapes import Drawing, Mesh
from shapewright.shapes.files import Format, encode
from shapewright.shapes.soundness import Soundness

MEASURES = ("sound", *(field.name for field in fields(Soundness)))


@dataclass(frozen=True)
class Form:
    """How shapes are written.

    format: of meshes; drawings are written as SVG.
    origin: what each file says of where it comes from.
    facts: of the procedure.
    """

    format: Format
    origin: Mapping[str, Any]
    facts: Facts


@dataclass(frozen=True)
class Made:
    """One sample.

    parameters: what it was built from.
    extension: of its file, without the dot.
    data: the bytes of its file; None where there is no shape.
    measures: by the names in ``MEASURES``; empty for a drawing, and where there is no shape.
    failure: why there is no shape.
    """

    parameters: Parameters
    extension: str
    data: bytes | None
    measures: Mapping[str, bool | int]
    failure: Failure | None = None


def made(build: Build, form: Form) -> Made:
    """The sample of a build, in the procedure's axes but for GLB, which is Y up."""
    extension = "svg" if isinstance(build.shape, Drawing) else form.format
    if build.shape is None:
        return Made(build.parameters, extension, None, {}, build.failure)
    extras = {**form.origin, "parameters": dict(build.parameters), **form.facts.stated}
    shape = build.shape if form.format == "glb" else form.facts.laid(build.shape)
    data = encode(shape, form.format, extras, form.facts.metres)
    if not isinstance(build.shape, Mesh):
        return Made(build.parameters, extension, data, {})
    state = build.shape.soundness()
    return Made(build.parameters, extension, data, {name: getattr(state, name) for name in MEASURES})
