"""Messages of shapes: meshes, residuals, drawings, what the judge says of them, and what is known of a reference."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import shapely

from shapewright.judging.target import Measures, Target
from shapewright.judging.verdict import Evidence
from shapewright.references.readers.pictures import outline
from shapewright.references.reference import Reference
from shapewright.rendering.splats import discs
from shapewright.shapes import Drawing, Mesh, Points, ReferenceShape, Shape, Views
from shapewright.studio.bench.residual_colours import LIMIT, Residual
from shapewright.studio.bench.workshop import Built
from shapewright.studio.wire.answers import (
    DrawingMessage,
    Extent,
    MeshHead,
    ResidualsHead,
    VerdictMessage,
    binary,
)
from shapewright.studio.wire.detail import About, Units
from shapewright.studio.wire.judgement import Piece
from shapewright.studio.wire.values import Slug, message_of

SIDES = ("missing", "surplus")
MOST = 8
"""Regions of either kind in a message: the largest."""
_DIGITS = 5
_LEAST = 1e-7  # of the area that a path shows; two equal edges leave slivers of rounding between them


def about(reference: Reference) -> About:
    """The triangles and notes of a reference, and the way back to its own units and axes."""
    shape, solid = reference.shape, isinstance(reference.shape, Mesh | Points)
    extent = (shape.bounds[1] - shape.bounds[0]) / reference.transform.scale
    return About(
        triangles=len(shape.faces) if isinstance(shape, Mesh) else None,
        notes=list(reference.notes),
        units=Units(
            centre=list(reference.transform.centre),
            scale=reference.transform.scale,
            axes=(reference.orientation.matrix if solid else np.eye(2)).tolist(),
            size=np.abs(reference.orientation.invert(extent) if solid else extent).tolist(),
        ),
    )


def outcome(built: Built) -> dict[str, Any]:
    """What the message of a replica says of it besides its shape."""
    shape = built.build.shape
    assert shape is not None
    return {
        "parameters": built.build.parameters,
        "active": list(built.active),
        "at_limit": list(built.at_limit),
        "units": Extent(size=(shape.bounds[1] - shape.bounds[0]).tolist()),
        "milliseconds": round(1000.0 * built.build.seconds, 2),
    }


def silhouette(views: Views) -> Drawing:
    """The object of the first view as a drawing."""
    return Drawing(outline(views.views[0].mask.astype(np.float32) / np.float32(255.0))).normalised()


def drawing_message(drawing: Drawing, reference: Drawing | None, **head: Any) -> DrawingMessage:
    """A drawing's outline, and where a reference is given, what only one of the two covers.

    head: other fields.
    """
    missing = excess = None
    if reference is not None:
        missing = path(reference.geometry.difference(drawing.geometry))
        excess = path(drawing.geometry.difference(reference.geometry))
    return DrawingMessage(**head, path=path(drawing.geometry), missing=missing, excess=excess)


def path(geometry: Any) -> str:
    """The area of a shapely geometry as SVG path data, to be filled by the even-odd rule; y up."""
    areas = [part for part in shapely.get_parts(geometry) if part.area > _LEAST]
    rings = (np.round(shapely.get_coordinates(ring), _DIGITS) for ring in shapely.get_rings(areas))
    return "".join("M" + "L".join(f"{x:g} {y:g}" for x, y in ring[:-1].tolist()) + "Z" for ring in rings)


def verdict_message(
    target: Target | None, replica: Shape, number: int, slug: Slug, same: float = 1.0
) -> VerdictMessage:
    """What can be measured of a replica, and where it differs; whoever knows the cuts says its grade.

    target: None for a reference that cannot be read. number: of the evaluation. same: how like the sizes are.
    """
    evidence = target.evidence(replica) if target else Evidence(math.nan)
    evidence = replace(evidence, value=evidence.value * same)
    measures = target.measures(replica, fidelity=evidence.value) if target else Measures()
    sides = {side: [message_of(Piece, region) for region in getattr(evidence, side)[:MOST]] for side in SIDES}
    return message_of(VerdictMessage, measures, id=number, slug=slug, measures=measures.by_name(), **sides)


def mesh_message(mesh: Mesh, **head: Any) -> bytes:
    """The binary message ``mesh``; its vertices are those of ``mesh`` as they are.

    head: other fields.
    """
    labels = {} if mesh.face_labels is None else {"labels": mesh.face_labels.astype(np.int32)}
    head |= {"vertices": len(mesh.vertices), "triangles": len(mesh.faces), "label_names": list(mesh.label_names)}
    return binary(MeshHead(**head), _triangles(mesh) | labels)


def reference_message(shape: ReferenceShape, slug: Slug) -> tuple[DrawingMessage | None, bytes]:
    """The message of a reference, or its payload: points are shown as discs, views by their first silhouette."""
    head: dict[str, Any] = {"id": 0, "slug": slug, "shape": "reference"}
    match shape:
        case Mesh():
            return None, mesh_message(shape, **head)
        case Points():
            return None, mesh_message(discs(shape), **head, discs=True)
        case _:
            return drawing_message(silhouette(shape) if isinstance(shape, Views) else shape, None, **head), b""


def residual_message(residual: Residual, **head: Any) -> bytes:
    """The binary message ``residuals``.

    head: other fields.
    """
    head |= {"vertices": len(residual.vertices), "triangles": len(residual.faces)}
    colours, distances = residual.colours.astype(np.float32).ravel(), residual.distances.astype(np.float32)
    buffers = {**_triangles(residual), "colours": colours, "distances": distances}
    return binary(ResidualsHead(**head, signed=residual.signed, limit=LIMIT), buffers)


def _triangles(of: Mesh | Residual) -> dict[str, Any]:
    return {"positions": of.vertices.astype(np.float32).ravel(), "indices": of.faces.astype(np.uint32).ravel()}
