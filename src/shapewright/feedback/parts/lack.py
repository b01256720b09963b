"""What a replica lacks of its reference, and how much nearer a piece that is added brings them: by points alone."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from shapewright.comparison.surfaces import Samples
from shapewright.feedback.parts.decomposition import decompose
from shapewright.feedback.parts.pieces import Piece
from shapewright.feedback.surfaces.residuals import Residuals
from shapewright.feedback.surfaces.tangent_planes import tangent_distances
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.shapes import Floats, Mesh, Transform

# Where nothing else is said, chosen by eye on first versions of vessels and buildings.
_POINTS = 250  # of the reference, that are compared
_NEAR = 0.025  # of the reference's largest extent: points so far apart are e^-1 of a match
_NO_MATCH = 4.0  # of these: points so far apart are no match at all, e^-16 of one
_APART = (0.02, 0.05, 0.09)  # of the same: how far points are from the replica that are taken to be missing together
_FAR = 0.2  # of the same: distances beyond count as this
_BOXES, _SAME = 5, 0.6  # boxes of what is missing, at most; intersection over union from which on two are one


@dataclass(frozen=True, eq=False)
class Lack:
    """A reference beside what stays of its replica, in the replica's units.

    Attributes:
        points: (N, 3), of the reference's surface that can be seen.
        apart: (N,), their distances to what stays.
        kept: how well the points of what stays match on average, 0 to 1.
        area: of what stays.
        middle: x and z of the planes about which the reference is symmetric, where it is.
        reference: its surface, normalised.
        placement: takes the replica's units to those of that surface.
    """

    points: Floats
    apart: Floats
    kept: float
    area: float
    middle: tuple[float, float]
    reference: VisibleSurface
    placement: Transform

    @classmethod
    def of(cls, differences: Residuals, removed: tuple[str, ...]) -> Lack:
        """differences: of the whole replica. removed: labels of the parts that go."""
        theirs, ours, placement = differences.reference, differences.replica, differences.placement
        stays = ours.visible & ~_labelled(differences.mesh, removed)[ours.faces]
        points = placement.invert(theirs.points[theirs.visible])
        unit = 1.0 / placement.scale
        if not removed:
            apart = differences.to_replica[theirs.visible]
        elif stays.any():
            apart = _subset(ours, stays).nearness(theirs.points[theirs.visible], _FAR)
        else:
            apart = np.full(len(points), _FAR)
        kept = float(_matching(differences.to_reference[stays], _NEAR).mean()) if stays.any() else 0.0
        centre = placement.invert(np.zeros(3))
        area = ours.area * unit**2 * float(stays.sum()) / max(int(ours.visible.sum()), 1)
        middle = (float(centre[0]), float(centre[2]))
        return cls(points, apart * unit, kept, area, middle, theirs, placement)

    @cached_property
    def bounds(self) -> Floats:
        """(2, 3), of the reference."""
        return np.stack([self.points.min(axis=0), self.points.max(axis=0)])

    @cached_property
    def unit(self) -> float:
        """The reference's largest extent."""
        return float(np.ptp(self.bounds, axis=0).max())

    def boxes(self) -> list[Piece]:
        """Boxes that a piece may fill, the largest first: of what lies further and further from what stays."""
        found = [Piece("box", self.bounds[0], self.bounds[1], middle=self.middle)]
        for apart in _APART:
            far = self.points[self.apart > apart * self.unit]
            found += [one for piece in decompose(far, self.middle, self.unit) for one in _ways(piece)]
        different: list[Piece] = []
        for piece in sorted(found, key=lambda piece: -float(np.prod(piece.size))):
            if all(_overlap(piece, other) < _SAME for other in different):
                different.append(piece)
        return different[:_BOXES]

    def gain(self, piece: Samples) -> float:
        """How much better all match, of 1, when a piece is added. piece: points of its surface."""
        there = self.reference.nearness(self.placement.apply(piece.points), _NO_MATCH * _NEAR)
        here = float(_matching(there, _NEAR).mean())
        some, before = self._some
        spacing = math.sqrt(piece.area / len(piece.points))
        after = np.minimum(before, tangent_distances(some, piece.points, piece.normals, spacing))
        precision = (self.kept * self.area + here * piece.area) / (self.area + piece.area)
        return self._score(after, precision) - self.match

    @cached_property
    def _some(self) -> tuple[Floats, Floats]:
        step = max(1, len(self.points) // _POINTS)
        return self.points[::step], self.apart[::step]

    @cached_property
    def match(self) -> float:
        """How well the reference and what stays match, 0 to 1."""
        return self._score(self._some[1], self.kept)

    def _score(self, apart: Floats, precision: float) -> float:
        """F-score: what of the reference is there, and what is there of the reference."""
        recall = float(_matching(apart, _NEAR * self.unit).mean())
        return 2.0 * precision * recall / max(precision + recall, 1e-9)


def _matching(apart: Floats, near: float) -> Floats:
    return np.asarray(np.exp(-np.square(np.minimum(apart / near, 9.0))))


def _subset(surface: VisibleSurface, rows: NDArray[np.bool_]) -> VisibleSurface:
    share = float(rows.sum()) / max(int(surface.visible.sum()), 1)
    points, normals, faces = surface.points[rows], surface.normals[rows], surface.faces[rows]
    return VisibleSurface(points, normals, faces, np.ones(len(points), dtype=bool), surface.area * share)


def _labelled(mesh: Mesh, names: tuple[str, ...]) -> NDArray[np.bool_]:
    """(F,): the faces of parts with these labels."""
    if mesh.face_labels is None or not names:
        return np.zeros(len(mesh.faces), dtype=bool)
    return np.isin(mesh.face_labels, [mesh.label_names.index(name) for name in names if name in mesh.label_names])


def _ways(piece: Piece) -> Iterator[Piece]:
    """The box of a piece; of a mirrored one also the box around its copies."""
    yield Piece("box", piece.low, piece.high, piece.mirrored, piece.middle)
    if any(piece.mirrored):
        low, high = piece.outer
        yield Piece("box", low, high, middle=piece.middle)


def _overlap(a: Piece, b: Piece) -> float:
    """Intersection over union of two boxes, 0 where only one of them is mirrored."""
    if a.mirrored != b.mirrored:
        return 0.0
    common = float(np.prod(np.maximum(np.minimum(a.high, b.high) - np.maximum(a.low, b.low), 0.0)))
    return common / (float(np.prod(a.size)) + float(np.prod(b.size)) - common)
