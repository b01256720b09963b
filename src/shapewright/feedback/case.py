"""One reference of an iteration: its replicas, where they differ from it, and why."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from shapewright.feedback.surfaces.placement import Overlay
from shapewright.feedback.surfaces.residuals import Residuals
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.parameters import Parameters
from shapewright.shapes import Mesh

CauseKind = Literal[
    "out of range",
    "badly predicted",
    "wrong choice",
    "missing part",
    "surplus part",
    "wrong form",
    "not such a shape",
]


@dataclass(frozen=True, eq=False)
class Replica:
    """A shape that stands for a reference.

    Attributes:
        row: index of the reference in its collection.
        parameters: those that make the shape; they may lie outside the Ranges of the space.
        mesh: the shape.
        distance: light field distance to the reference, 0 and up.
        field: index of the light field in which the two differ least. A search goes by it.
    """

    row: int
    parameters: Parameters
    mesh: Mesh
    distance: float
    field: int = 0


@dataclass(frozen=True)
class Cause:
    """Why a reference is not replicated.

    Attributes:
        kind: one of a few kinds.
        text: the cause in words.
        evidence: what shows it, as plain values for JSON.
        label: of the part that it is about, None where it is about none.
        weight: of a part: share of the surface times distance from the other surface.
    """

    kind: CauseKind
    text: str
    evidence: Mapping[str, Any] = field(default_factory=dict)
    label: str | None = None
    weight: float = 0.0


@dataclass(frozen=True, eq=False)
class Case:
    """One reference, and what is known about it by now.

    Each step of an explanation makes a case that knows more. At first all replicas are that of the iteration. For a
    compatible reference they remain so, and there are no causes.

    Attributes:
        name: of the reference.
        row: its index in the collection.
        reference: its shape.
        compatible: whether the iteration's replica is.
        replica: the iteration's replica.
        residuals: where that differs from the reference.
        overlay: measures how much of the surfaces lies apart.
        nearest: the replica within the space that is nearest by the light field.
        covering: the replica within the space whose surface has most in common with the reference's. It may be further
            away by the light field.
        covering_residuals: where that differs from the reference: what parameters account for least.
        outside: the nearest replica with longer Ranges.
        isolation: of a reference that is unlike all others, the mean distance to the nearest of them; None for any
            other.
        causes: the chief cause first.
    """

    name: str
    row: int
    reference: Mesh
    compatible: bool
    replica: Replica
    residuals: Residuals
    overlay: Overlay
    nearest: Replica
    covering: Replica
    covering_residuals: Residuals
    outside: Replica
    isolation: float | None = None
    causes: tuple[Cause, ...] = ()

    @classmethod
    def of(cls, name: str, reference: Mesh, compatible: bool, replica: Replica, residuals: Residuals) -> Case:
        """A case that knows the iteration's replica only. residuals: of that replica."""
        return cls(
            name,
            replica.row,
            reference,
            compatible,
            replica,
            residuals,
            overlay=Overlay(residuals.reference),
            nearest=replica,
            covering=replica,
            covering_residuals=residuals,
            outside=replica,
        )

    @property
    def surface(self) -> VisibleSurface:
        """The visible surface of the normalised reference."""
        return self.residuals.reference


def updated(cases: Iterable[Case], newer: Iterable[Case]) -> list[Case]:
    """The same cases in the same order, some of them replaced by what is known about the same references now."""
    return list({case.row: case for case in [*cases, *newer]}.values())
