"""What a replica is measured against: one reference, with whatever of it takes time to make."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import Any, Literal, TypedDict

import numpy as np

from shapewright.comparison import light_field
from shapewright.comparison.silhouettes import intersection_over_union
from shapewright.comparison.surfaces import chamfer
from shapewright.references.collection import Reference
from shapewright.shapes import Mesh
from shapewright.studio.built import Built
from shapewright.studio.frames import binary
from shapewright.studio.nearness import NearSurface
from shapewright.studio.residuals import LIMIT, Residual, refined, residual


class Measures(TypedDict):
    """Distance, IoU of silhouettes and Chamfer distance, None where they cannot be measured."""

    distance: float | None
    iou: float | None
    chamfer: float | None


NOTHING: Measures = {"distance": None, "iou": None, "chamfer": None}


class Target:
    """A reference to measure replicas against, as the judge does; all meshes here are normalised."""

    def __init__(self, reference: Reference, align: light_field.Align, cache: Path | None) -> None:
        self.reference = reference
        self._align: light_field.Align = align
        self._cache = cache

    @cached_property
    def _descriptor(self) -> light_field.Descriptor | None:
        try:
            return light_field.descriptor(self.reference.shape, cache=self._cache)
        except ValueError:
            return None

    @cached_property
    def _surface(self) -> NearSurface:
        return NearSurface(self.reference.shape)

    @cached_property
    def _refined(self) -> Mesh:
        return refined(self.reference.shape)

    def distance(self, replica: Mesh) -> float | None:
        """Normalised light-field distance; None where no view shows one of the two."""
        try:
            theirs = self._descriptor
            return light_field.distance(theirs, replica, self._align) if theirs else None
        except ValueError:
            return None

    def measures(self, replica: Mesh) -> Measures:
        """All that the judge measures."""
        distance = self.distance(replica)
        if distance is None:
            return NOTHING
        iou = intersection_over_union([self.reference.shape], [replica], threads=1)
        return {"distance": distance, "iou": float(iou[0]), "chamfer": chamfer(self.reference.shape, replica)}

    def residuals(self, replica: Mesh) -> dict[Literal["replica", "reference"], Residual]:
        """Of the replica against the reference, and of the reference against the replica."""
        return {
            "replica": residual(refined(replica), self._surface),
            "reference": residual(self._refined, NearSurface(replica)),
        }


def about(reference: Reference) -> dict[str, Any]:
    """What the page tells of a reference: its triangles, notes, and the way back to its own units and axes."""
    extent = reference.orientation.invert(reference.shape.extent / reference.transform.scale)
    return {
        "triangles": len(reference.shape.faces),
        "notes": list(reference.notes),
        "units": {
            "centre": list(reference.transform.centre),
            "scale": reference.transform.scale,
            "axes": reference.orientation.matrix.tolist(),
            "size": np.abs(extent).tolist(),
        },
    }


def replica_header(built: Built) -> dict[str, Any]:
    """What the message of a replica says of it."""
    shape = built.build.shape
    assert isinstance(shape, Mesh)
    return {
        "shape": "replica",
        "parameters": built.build.parameters,
        "active": list(built.active),
        "at_limit": list(built.at_limit),
        "units": {"size": shape.extent.tolist()},
        "milliseconds": round(1000.0 * built.build.seconds, 2),
    }


def mesh_message(mesh: Mesh, header: dict[str, Any]) -> bytes:
    """The binary message ``mesh``; its vertices are those of ``mesh`` as they are."""
    buffers: dict[str, Any] = {
        "positions": mesh.vertices.astype(np.float32).ravel(),
        "indices": mesh.faces.astype(np.uint32).ravel(),
    }
    if mesh.face_labels is not None:
        buffers["labels"] = mesh.face_labels.astype(np.int32)
    counts = {"vertices": len(mesh.vertices), "triangles": len(mesh.faces)}
    return binary({"type": "mesh", **header, **counts, "label_names": list(mesh.label_names)}, buffers)


def residual_message(found: Residual, header: dict[str, Any]) -> bytes:
    """The binary message ``residuals``."""
    counts = {"vertices": len(found.vertices), "triangles": len(found.faces)}
    buffers = {
        "positions": found.vertices.astype(np.float32).ravel(),
        "indices": found.faces.astype(np.uint32).ravel(),
        "colours": found.colours.astype(np.float32).ravel(),
        "distances": found.distances.astype(np.float32),
    }
    return binary({"type": "residuals", **header, **counts, "signed": found.signed, "limit": LIMIT}, buffers)
