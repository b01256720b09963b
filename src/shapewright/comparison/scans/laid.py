"""A replica laid over a scan: moved and scaled a little, and how far each is from the other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from shapewright.comparison.scans.scan import Scan
from shapewright.comparison.scans.sides import AROUND, all_sides, seen_sides, surely_seen, visible
from shapewright.comparison.surface_distance import NearSurface
from shapewright.comparison.surfaces import sample
from shapewright.shapes import Floats, Mesh

_SAMPLES = 1200  # points on a replica
_ALIGNED = 400  # of the scan's points, by which the replica is laid over it
_APART = 0.12  # distance from which on all are taken to be as far apart: less to search
_TURNS = 3  # of laying the replica over the scan: later ones move it by less than a thousandth
_ROBUST = 0.02  # distance from which on a point pulls less, in units of the largest extent
_FURTHEST = 0.08  # most that a replica is moved, and scaled, by
_STIFF = 0.01  # points that pull towards the bounding boxes, as a share of the scan's
_NEAR = 0.03  # distance up to which a point of a replica is explained by the scan
LOOSE = 0.06  # the same of a replica that is only about right


@dataclass(frozen=True, eq=False)
class Laid:
    """A replica over a scan; lengths are in units of the replica's largest extent.

    scale, shift: take places of the scan to the frame of the normalised replica.
    missing: (K,), the distance of each of the scan's points to the replica.
    samples: (M, 3), points on the replica that can be seen from outside, in its frame.
    surplus: (M,), the distance of each of these to the scan, less what its spacing explains.
    seen: (M,), which of these the scan would show, were they there.
    sides: those that the scan was seen from, bits of ``sides.all_sides``.
    """

    scale: float
    shift: Floats
    missing: Floats
    samples: Floats
    surplus: Floats
    seen: NDArray[np.bool_]
    sides: int

    def in_scan(self, places: Floats) -> Floats:
        """Places (..., 3) of the replica's frame in the scan's."""
        return np.asarray((places - self.shift) / self.scale)


def lay(scan: Scan, replica: Mesh, near: float = _NEAR) -> Laid:
    """Raises ValueError for a replica without area."""
    normal = replica.normalised()
    on = sample(normal, _SAMPLES)
    cameras = all_sides(scan.places)
    bits = visible(normal, on.points, on.normals, cameras)
    scale, shift = _aligned(scan, on.points, on.normals)
    missing = NearSurface(normal).lengths(scale * scan.points + shift)
    apart = scale * np.minimum(scan.tree.query((on.points - shift) / scale, distance_upper_bound=_APART)[0], _APART)
    surplus = np.maximum(apart - scale * scan.spacing, 0.0)
    outside = bits != 0
    sides = (1 << len(cameras)) - (1 << len(AROUND))
    if scan.places is None:
        sides = seen_sides(bits[outside], surplus[outside] <= near)
    return Laid(scale, shift, missing, on.points[outside], surplus[outside], surely_seen(bits[outside], sides), sides)


def _aligned(scan: Scan, samples: Floats, normals: Floats) -> tuple[float, Floats]:
    """Scale and shift of the scan: least squares of the distances along normals, reweighted."""
    tree, points = cKDTree(samples), scan.points[:_ALIGNED]
    scale, shift = scan.start
    first = np.array([scale, *shift])
    stiff = np.diag([1.0, 1.0, 1.0, 1.0]) * (_STIFF * len(points))
    for _ in range(_TURNS):
        apart, rows = tree.query(scale * points + shift)
        normal, at = normals[rows], samples[rows]
        table = np.concatenate([np.einsum("ni,ni->n", points, normal)[:, None], normal], axis=1)
        wanted = np.einsum("ni,ni->n", at, normal)
        weights = 1.0 / (1.0 + (apart / _ROBUST) ** 2)
        weighted = table * weights[:, None]
        found = np.linalg.solve(weighted.T @ table + stiff, weighted.T @ wanted + stiff @ first)
        found = np.clip(found, first - _FURTHEST, first + _FURTHEST)
        scale, shift = float(found[0]), found[1:]
    return scale, shift
