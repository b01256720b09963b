"""One reference of an iteration: its replicas, where they differ from it, and why."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from shapewright.building import Build
from shapewright.feedback.remarks.proportions import Proportion
from shapewright.feedback.surfaces.areas import Areas
from shapewright.feedback.surfaces.placement import Overlay
from shapewright.feedback.surfaces.residuals import Residuals
from shapewright.judging.verdict import Standing
from shapewright.parameters import Parameters
from shapewright.shapes import Drawing, Mesh, Shape

CauseKind = Literal[
    "out of range",
    "badly predicted",
    "wrong choice",
    "another pose",
    "missing part",
    "surplus part",
    "wrong form",
    "not such a shape",
    "not built",
]


@dataclass(frozen=True, eq=False)
class Replica:
    """A shape that stands for a reference."""

    row: int  # index of the reference in its collection
    parameters: Parameters  # those that make the shape; they may lie outside the Ranges of the space
    shape: Shape
    distance: float  # to the reference, 0 and up: the light field distance; of drawings the share that lies apart
    field: int = 0  # index of the light field in which the two differ least: a search goes by it
    apart: float = math.inf  # from a perfect replica, by the judge: at most 1 is replicated
    fidelity: float = math.nan  # by the judge; NaN where it goes by the distance

    @classmethod
    def of(cls, row: int, build: Build, standing: Standing) -> Replica | None:
        """None where no shape could be built or measured."""
        if build.shape is None or math.isnan(standing.distance) or math.isnan(standing.apart):
            return None
        return cls(row, build.parameters, build.shape, **vars(standing))

    @property
    def mesh(self) -> Mesh:
        """The shape, where it is one of a mesh's replicas."""
        assert isinstance(self.shape, Mesh)
        return self.shape


@dataclass(frozen=True)
class Cause:
    """Why a reference is not replicated."""

    kind: CauseKind
    text: str  # the cause in words
    evidence: Mapping[str, Any] = field(default_factory=dict)  # what shows it, as plain values for JSON
    label: str | None = None  # of the part that it is about, None where it is about none
    weight: float = 0.0  # of a part: share of the surface times distance from the other surface
    picture: bytes | None = None  # PNG that shows it, where words are not enough


@dataclass(frozen=True, eq=False)
class Case:
    """One reference, and what is known about it by now.

    Each step of an explanation makes a case that knows more. At first all replicas are that of the iteration. For a
    replicated reference they remain so, and there are no causes.
    """

    name: str  # of the reference
    row: int  # its index in the collection
    reference: Mesh
    replicated: bool  # whether the iteration's judge says so
    replica: Replica  # the iteration's
    residuals: Residuals  # where that differs from the reference
    overlay: Overlay  # measures how much of the surfaces lies apart
    nearest: Replica  # the one within the space that is nearest by the light field
    covering: Replica  # the one within the space whose surface has most in common; it may be further by the light field
    covering_residuals: Residuals  # where that differs from the reference: what parameters account for least
    outside: Replica  # the nearest one with longer Ranges
    proportion: Proportion | None = None  # of the reference, where no parameters give it
    isolation: float | None = None  # mean distance to the nearest references, where it is unlike all others; else None
    causes: tuple[Cause, ...] = ()  # the chief cause first
    remark: Cause | None = None  # what still differs in a replica that is good enough

    @classmethod
    def of(cls, name: str, reference: Mesh, replicated: bool, replica: Replica, residuals: Residuals) -> Case:
        """A case that knows the iteration's replica only. residuals: of that replica."""
        here = Overlay(residuals.reference)
        return cls(
            name, replica.row, reference, replicated, replica, residuals, here, replica, replica, residuals, replica
        )


@dataclass(frozen=True, eq=False)
class DrawnCase:
    """One drawing, and what is known about it. Distances of its replicas are shares of both areas that lie apart."""

    name: str  # of the reference
    row: int  # its index in the collection
    reference: Drawing
    replicated: bool  # whether the iteration's judge says so
    replica: Replica  # the iteration's
    nearest: Replica  # the nearest one within the space
    outside: Replica  # the nearest one with longer Ranges
    residuals: Areas  # where the iteration's replica differs from the reference
    covering_residuals: Areas  # where the nearest one within the space does
    causes: tuple[Cause, ...] = ()  # the chief cause first

    @classmethod
    def of(cls, name: str, reference: Drawing, replicated: bool, replica: Replica, residuals: Areas) -> DrawnCase:
        """A case that knows the iteration's replica only. residuals: of that replica."""
        return cls(name, replica.row, reference, replicated, replica, replica, replica, residuals, residuals)


def updated(cases: Iterable[Case], newer: Iterable[Case]) -> list[Case]:
    """The same cases in the same order, some of them replaced by what is known about the same references now."""
    return list({case.row: case for case in [*cases, *newer]}.values())
