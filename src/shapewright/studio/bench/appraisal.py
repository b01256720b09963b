"""What a replica is measured against: one reference, with whatever of it takes time to make."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import Literal, TypedDict

from shapewright.comparison import light_field, outline
from shapewright.comparison.overlap import intersection_over_union
from shapewright.comparison.pictures import intersection_over_union as overlap
from shapewright.comparison.pictures import visual_information_fidelity
from shapewright.comparison.surfaces import chamfer
from shapewright.references.collection import Reference
from shapewright.shapes import Drawing, Mesh, Shape
from shapewright.studio.bench.residual_colours import Residual, refined, residual
from shapewright.studio.bench.surface_distance import NearSurface


class Measures(TypedDict):
    """Distance, IoU of silhouettes and Chamfer distance, None where they cannot be measured."""

    distance: float | None
    iou: float | None
    chamfer: float | None


NOTHING: Measures = {"distance": None, "iou": None, "chamfer": None}


class MeshTarget:
    """A mesh to measure replicas against, as the judge does; all meshes here are normalised."""

    def __init__(self, mesh: Mesh, align: light_field.Align, cache: Path | None) -> None:
        self.shape = mesh
        self._align: light_field.Align = align
        self._cache = cache

    @cached_property
    def _descriptor(self) -> light_field.Descriptor | None:
        try:
            return light_field.descriptor(self.shape, cache=self._cache)
        except ValueError:
            return None

    @cached_property
    def _surface(self) -> NearSurface:
        return NearSurface(self.shape)

    @cached_property
    def _refined(self) -> Mesh:
        return refined(self.shape)

    def distance(self, replica: Shape) -> float | None:
        """Normalised light-field distance; None for a drawing, and where no view shows one of the two."""
        try:
            theirs = self._descriptor
            measurable = theirs and isinstance(replica, Mesh)
            return light_field.distance(theirs, replica, self._align) if measurable else None  # type: ignore[arg-type]
        except ValueError:
            return None

    def measures(self, replica: Shape) -> Measures:
        """All that the judge measures."""
        distance = self.distance(replica)
        if distance is None or not isinstance(replica, Mesh):
            return NOTHING
        iou = intersection_over_union([self.shape], [replica], threads=1)
        return {"distance": distance, "iou": float(iou[0]), "chamfer": chamfer(self.shape, replica)}

    def residuals(self, replica: Mesh) -> dict[Literal["replica", "reference"], Residual]:
        """Of the replica against the reference, and of the reference against the replica."""
        return {
            "replica": residual(refined(replica), self._surface),
            "reference": residual(self._refined, NearSurface(replica)),
        }


class DrawingTarget:
    """A drawing to measure replicas against, as the judge of drawings does."""

    def __init__(self, drawing: Drawing) -> None:
        self.shape = drawing

    @cached_property
    def _seen(self) -> bool:
        return bool(outline.silhouette(self.shape).any())

    def distance(self, replica: Shape) -> float | None:
        """One less the visual information fidelity; None for a mesh, and where one of them is too thin to be seen."""
        if not (self._seen and isinstance(replica, Drawing) and outline.silhouette(replica).any()):
            return None
        return max(0.0, 1.0 - visual_information_fidelity(self.shape, replica))

    def measures(self, replica: Shape) -> Measures:
        """All that the judge measures."""
        distance = self.distance(replica)
        if distance is None or not isinstance(replica, Drawing):
            return NOTHING
        return {"distance": distance, "iou": overlap(self.shape, replica), "chamfer": None}


Target = MeshTarget | DrawingTarget


def target_of(reference: Reference, align: light_field.Align, cache: Path | None) -> Target:
    """A reference to measure against. align, cache: see light_field."""
    shape = reference.shape
    return MeshTarget(shape, align, cache) if isinstance(shape, Mesh) else DrawingTarget(shape)
