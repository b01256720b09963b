"""The default judge of meshes: the probability that a person calls a replica and its reference the same, and where
they differ.

Both are looked at in place: nothing is turned or mirrored. The numbers here are provisional.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from shapewright.comparison import views
from shapewright.comparison.surfaces import sample
from shapewright.judging.verdict import Evidence, Region
from shapewright.shapes import Floats, Mesh, Shape

_POINTS = 1500  # of a surface
_FAR, _LINK = 0.05, 0.08  # of the largest extent: beyond it a point has no counterpart; up to it two are one region
_LEAST = 0.01  # share of a surface or an area that makes a region


class Fidelity:
    """A reference, described when it is first needed; any thread may ask."""

    def __init__(self, reference: Mesh) -> None:
        self._judge = functools.cache(functools.partial(_of_mesh, reference))

    def evidence(self, replica: Shape | None) -> Evidence:
        """What there is to say of a replica; a value of NaN where the two cannot be compared."""
        return Evidence(math.nan) if replica is None else self._judge()(replica)


def _of_mesh(mesh: Mesh) -> Callable[[Shape], Evidence]:
    points = _points(mesh)
    tree = None if points is None else cKDTree(points)

    def evidence(replica: Shape) -> Evidence:
        others = _points(replica) if isinstance(replica, Mesh) else None
        if points is None or tree is None or others is None or not isinstance(replica, Mesh):
            return Evidence(math.nan)
        apart = views.depth_difference(mesh, replica) + 1.0 - views.intersection_over_union(mesh, replica)
        missing = _pieces(points, cKDTree(others).query(points)[0])
        return Evidence(_logistic(6.0 - 25.0 * apart), missing, _pieces(others, tree.query(others)[0]))

    return evidence


def _points(mesh: Mesh) -> Floats | None:
    try:
        return sample(mesh.normalised(), _POINTS).points
    except ValueError:
        return None


def _pieces(points: Floats, distance: Floats) -> tuple[Region, ...]:
    """The regions of points (N, 3) that are far from the other surface, (N,)."""
    far = points[distance > _FAR]
    if not len(far):
        return ()
    tree = cKDTree(far)
    _, component = connected_components(tree.sparse_distance_matrix(tree, _LINK, output_type="coo_matrix"))
    found = [far[component == number] for number in np.unique(component)]
    return _sorted([_region(some.min(axis=0), some.max(axis=0), len(some) / len(points)) for some in found])


def _region(low: Floats, high: Floats, share: float) -> Region:
    corners = [(float(x), float(y), float(z)) for x, y, z in (low, high)]
    return Region(float((high - low).max()), corners[0], corners[1], share)


def _sorted(regions: list[Region]) -> tuple[Region, ...]:
    return tuple(sorted((r for r in regions if r.share >= _LEAST), key=lambda region: -region.size))


def _logistic(x: float) -> float:
    return 1.0 / (1.0 + math.exp(-x))
