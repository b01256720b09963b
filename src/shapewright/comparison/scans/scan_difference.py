"""How a replica differs from a scan: smooth, to search with.

The scan's points pull by their distances to the replica, from inside or outside. What the replica has besides pushes
only where it stands before what the scan shows, or before nothing, from a side that the scan was seen from.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

from shapewright.comparison.scans.laid import LOOSE, lay
from shapewright.comparison.scans.scan import Scan
from shapewright.comparison.scans.sides import all_sides
from shapewright.comparison.surface_distance import NearSurface
from shapewright.rendering.point_pictures import view as view_points
from shapewright.rendering.raster import view
from shapewright.shapes import Floats, Mesh, Points, Shape

_SIZE, _SAMPLES = 16, 8  # pixels along the side of a picture, samples of one along its side: thin legs stay thin
_MARGIN = 1  # samples around what the scan shows that may be covered or not
_SLACK = 0.02  # of the largest extent, by which a replica may stand before what the scan shows
_DEEP = 0.15  # of the largest extent: what stands before it by so much more counts whole
_POINTS = 800  # of the scan, whose distances are taken
_FURTHEST = 0.2  # of the largest extent: points that are farther pull alike
_DISTANCE, _PICTURES = 60_000.0, 6000.0
"""What a mean distance of the largest extent costs, and what pictures do where a replica covers as much too much as the
scan covers: so .1 of distance weighs like a replica that pictures in place say covers nothing, see ``posed``."""
_MOST_SIDES = 6  # sides that pictures are taken from: more show little else
_LEAST_COVERED = 0.02  # share of the pictures that a scan is taken to cover at least


class ScanDifference:
    """How a replica differs from one scan in the pose that both have. sides: bits, see ``sides.all_sides``."""

    def __init__(self, scan: Scan, sides: int) -> None:
        cameras = enumerate(all_sides(scan.places))
        self._cameras = [camera for bit, camera in cameras if sides >> bit & 1][:_MOST_SIDES]
        scale, shift = scan.start
        self._places = scale * scan.points[:_POINTS] + shift
        whole, side = Points(scale * scan.positions + shift), _SIZE * _SAMPLES
        self._depths = np.zeros((len(self._cameras), side, side))
        for depth, camera in zip(self._depths, self._cameras, strict=True):
            _mark_depths(view_points(whole, camera, side), depth)
        covered = max(float((self._depths > 0.0).mean()), _LEAST_COVERED) if self._cameras else 1.0
        self._weight = _PICTURES / (covered * max(len(self._cameras), 1) * _SIZE * _SIZE)

    def __call__(self, replica: Shape) -> float:
        """The sum of absolute residuals, infinite where the two cannot be compared."""
        residual = self.residual(replica)
        return np.inf if residual is None else float(np.abs(residual).sum())

    def residual(self, replica: Shape) -> Floats | None:
        """(K,): what a search makes small, the sum of absolute values: distances of points, then pixels of each side.

        None for a drawing, and for a replica without area.
        """
        if not isinstance(replica, Mesh):
            return None
        try:
            normal = replica.normalised()
            distances = NearSurface(normal).distances(self._places)
        except ValueError:
            return None
        pictures = np.zeros((len(self._cameras), _SIZE, _SIZE))
        for picture, depth, camera in zip(pictures, self._depths, self._cameras, strict=True):
            _pool(view(normal, camera, _SIZE * _SAMPLES)[1], depth, picture)
        pulled = np.clip(distances, -_FURTHEST, _FURTHEST) * (_DISTANCE / len(distances))
        return np.concatenate([pulled, self._weight * pictures.ravel()])


def scan_cost(reference: Points, replica: Mesh) -> float:
    """The cost of a replica that is only about right; infinite where the two cannot be compared."""
    try:
        scan = Scan.of(reference.normalised())
        sides = lay(scan, replica, LOOSE).sides
    except ValueError:
        return np.inf
    return ScanDifference(scan, sides)(replica)


@njit(nogil=True, cache=True)
def _mark_depths(inverse: Any, depths: Any) -> None:
    """Distances along the view of what the scan shows; 0 where nothing is, -1 at the border of what is shown."""
    side = len(inverse)
    for row in range(side):
        for column in range(side):
            if inverse[row, column] > 0.0:
                depths[row, column] = 1.0 / inverse[row, column]
                continue
            for i in range(max(0, row - _MARGIN), min(side, row + _MARGIN + 1)):
                for j in range(max(0, column - _MARGIN), min(side, column + _MARGIN + 1)):
                    if inverse[i, j] > 0.0:
                        depths[row, column] = -1.0


@njit(nogil=True, cache=True)
def _pool(inverse: Any, depths: Any, picture: Any) -> None:
    """Means over the samples of each pixel of what is covered too much: 1 before nothing, else by how far in front."""
    samples = len(inverse) // len(picture)
    for row in range(len(inverse)):
        for column in range(len(inverse)):
            if inverse[row, column] > 0.0 and depths[row, column] >= 0.0:
                before = 1.0
                if depths[row, column] > 0.0:
                    before = (depths[row, column] - 1.0 / inverse[row, column] - _SLACK) / _DEEP
                picture[row // samples, column // samples] += min(max(before, 0.0), 1.0)
    picture /= samples * samples
