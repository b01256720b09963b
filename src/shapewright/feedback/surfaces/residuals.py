"""Where a replica differs from its reference: regions of either surface that the other does not come near."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from shapewright.feedback.surfaces.connection import connected_points
from shapewright.feedback.surfaces.oriented_boxes import OrientedBox, fit_box
from shapewright.feedback.surfaces.placement import place
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.shapes import Floats, Ints, Mesh, Transform

RegionSide = Literal["unexplained", "surplus"]
SIDES: tuple[RegionSide, RegionSide] = ("unexplained", "surplus")
FAR, NEAR = 0.04, 0.02
"""A region holds a point further than FAR from the other surface, and all points around it further than NEAR."""
LEAST = 0.004
"""Share of the visible surface below which a region is left out."""

_FEWEST = 8  # points of a region
_VOTERS = 200  # points of a region that tell which part it is nearest to
_LINK = 2.5  # spacings of a surface's points within which two are neighbours


@dataclass(frozen=True, eq=False)
class Region:
    """A connected part of one surface that the other does not come near.

    All lengths are in units of the reference's largest extent. All places are in the frame of the normalised reference
    (Y up, front towards +Z, bounding box centred).
    """

    side: RegionSide  # "unexplained", of the reference; "surplus", of the replica
    points: Floats  # (N, 3), spread evenly over it
    box: OrientedBox  # around it
    share: float  # of that side's visible surface, 0 to 1
    distance: float  # mean, to the other surface
    label: str | None  # of the replica's part that it lies on or is nearest to, None where that has none
    rule: str | None  # of the grammar that made that part, None where there is none
    rows: Ints  # of that side's ``VisibleSurface``

    @property
    def weight(self) -> float:
        """How much it matters: share times distance."""
        return self.share * self.distance


@dataclass(frozen=True, eq=False)
class Residuals:
    """How far two surfaces are from each other, and where."""

    measured, dimensions = "surface", 3
    regions: tuple[Region, ...]  # the weightiest first
    placement: Transform  # takes units of the replica's mesh to the frame of the normalised reference
    mesh: Mesh  # the replica as it was given
    reference: VisibleSurface
    replica: VisibleSurface  # in the reference's frame
    to_replica: Floats  # (N,), distances of the reference's points to the replica, in units of the reference's extent
    to_reference: Floats  # (M,), the same of the replica's points

    def __iter__(self) -> Iterator[Region]:
        return iter(self.regions)

    def of(self, side: RegionSide) -> tuple[Region, ...]:
        return tuple(region for region in self.regions if region.side == side)

    @property
    def reference_bounds(self) -> Floats:
        """(2, 3): of what can be seen of the reference."""
        points = self.reference.points[self.reference.visible]
        return np.stack([points.min(axis=0), points.max(axis=0)])


def residuals(reference: Mesh | VisibleSurface, replica: Mesh) -> Residuals:
    """Compare the surfaces of a reference and its replica, of which only what can be seen from outside is judged.

    The replica is first laid over the reference: both are upright, but a missing part moves the bounding box, so
    besides the two boxes' middles their sides are tried. reference: the mesh, or the surface of the normalised mesh
    where that is known. Raises ValueError for a mesh without area.
    """
    of_reference = VisibleSurface.of(reference.normalised()) if isinstance(reference, Mesh) else reference
    of_replica = VisibleSurface.of(replica.normalised())
    shift = place(of_reference, of_replica)
    of_replica = of_replica.moved(shift)
    to_replica, to_reference = of_replica.distance(of_reference.points), of_reference.distance(of_replica.points)
    regions = [
        *_regions("unexplained", of_reference, to_replica, of_replica, replica),
        *_regions("surplus", of_replica, to_reference, of_replica, replica),
    ]
    own = replica.normalisation()
    centre = np.array(own.centre) + np.array(shift.centre) / own.scale
    placement = Transform(tuple(float(value) for value in centre), own.scale * shift.scale)
    ordered = tuple(sorted(regions, key=lambda region: -region.weight))
    return Residuals(ordered, placement, replica, of_reference, of_replica, to_replica, to_reference)


def pieces(surface: VisibleSurface, mesh: Mesh) -> NDArray[np.intp]:
    """Which piece of the mesh each point lies on, (N,): a piece is connected and of one label; -1 where none is."""
    result = np.full(len(surface.points), -1, dtype=np.intp)
    labels = np.full(len(surface.points), -1) if mesh.face_labels is None else mesh.face_labels[surface.faces]
    count = 0
    for label in np.unique(labels[labels >= 0]):
        rows = np.flatnonzero(surface.visible & (labels == label))
        number, component = connected_points(surface.points[rows], _LINK * surface.spacing)
        result[rows] = component + count
        count += number
    return result


def _regions(
    side: RegionSide, surface: VisibleSurface, distance: Floats, replica: VisibleSurface, mesh: Mesh
) -> Iterator[Region]:
    """The regions of one of the surfaces. distance: of its points to the other. replica: the surface of the mesh."""
    visible = int(surface.visible.sum())
    for rows in _components(surface, distance):
        if len(rows) < max(LEAST * visible, _FEWEST):
            continue
        points = surface.points[rows]
        some = points[:: max(1, len(points) // _VOTERS)]
        faces = surface.faces[rows] if side == "surplus" else replica.faces[replica.tree.query(some)[1]]
        yield Region(
            side,
            points,
            fit_box(points),
            len(rows) / visible,
            float(distance[rows].mean()),
            _commonest(mesh.face_labels, mesh.label_names, faces),
            _commonest(mesh.face_rules, mesh.rule_names, faces),
            rows,
        )


def _components(surface: VisibleSurface, distance: Floats) -> list[NDArray[np.intp]]:
    """Rows of the points of each region: connected, all beyond NEAR and some beyond FAR."""
    rows = np.flatnonzero(surface.visible & (distance > NEAR))
    count, component = connected_points(surface.points[rows], _LINK * surface.spacing)
    far = np.zeros(count, dtype=bool)
    far[component[distance[rows] > FAR]] = True
    return [rows[component == number] for number in np.flatnonzero(far)]


def _commonest(indices: Ints | None, names: Sequence[str], faces: Ints) -> str | None:
    """The name that most of these faces have, None where most have none."""
    if indices is None:
        return None
    different, counts = np.unique(indices[faces], return_counts=True)
    commonest = int(different[counts.argmax()])
    return names[commonest] if commonest >= 0 else None
