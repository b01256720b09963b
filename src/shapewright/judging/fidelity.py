"""The default judge: the probability that a person calls a replica and its reference the same, and where they differ.

Both are looked at in place: nothing is turned or mirrored. The numbers here are provisional.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np
import shapely
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree
from shapely.geometry.base import BaseGeometry

from shapewright.comparison import pictures, views
from shapewright.comparison.surfaces import sample
from shapewright.judging.verdict import Evidence, Region
from shapewright.shapes import Drawing, Floats, Mesh, Shape

_POINTS = 1500  # of a surface
_FAR, _LINK = 0.05, 0.08  # of the largest extent: beyond it a point has no counterpart; up to it two are one region
_LEAST = 0.01  # share of a surface or an area that makes a region


class Fidelity:
    """A reference, described when it is first needed; any thread may ask."""

    def __init__(self, reference: Shape) -> None:
        described = _of_mesh if isinstance(reference, Mesh) else _of_drawing
        self._judge: Callable[[], Callable[[Shape], Evidence]] = functools.cache(
            functools.partial(described, reference)
        )

    def evidence(self, replica: Shape | None) -> Evidence:
        """What there is to say of a replica; a value of NaN where the two cannot be compared."""
        return Evidence(math.nan) if replica is None else self._judge()(replica)


def _of_mesh(reference: Shape) -> Callable[[Shape], Evidence]:
    assert isinstance(reference, Mesh)
    mesh, points = reference, _points(reference)
    tree = None if points is None else cKDTree(points)

    def evidence(replica: Shape) -> Evidence:
        others = _points(replica) if isinstance(replica, Mesh) else None
        if points is None or tree is None or others is None or not isinstance(replica, Mesh):
            return Evidence(math.nan)
        apart = views.depth_difference(mesh, replica) + 1.0 - views.intersection_over_union(mesh, replica)
        missing = _pieces(points, cKDTree(others).query(points)[0])
        return Evidence(_logistic(6.0 - 25.0 * apart), missing, _pieces(others, tree.query(others)[0]))

    return evidence


def _of_drawing(reference: Shape) -> Callable[[Shape], Evidence]:
    assert isinstance(reference, Drawing)
    area = reference.normalised().geometry

    def evidence(replica: Shape) -> Evidence:
        if not isinstance(replica, Drawing):
            return Evidence(math.nan)
        other = replica.normalised().geometry
        value = _logistic(20.0 * (pictures.intersection_over_union(reference, replica) - 0.8))
        return Evidence(value, _polygons(area - other, area.area), _polygons(other - area, other.area))

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


def _polygons(difference: BaseGeometry, area: float) -> tuple[Region, ...]:
    boxes = [(np.array(part.bounds), part.area / area) for part in shapely.get_parts(difference) if part.area > 0.0]
    return _sorted([_region(np.append(box[:2], 0.0), np.append(box[2:], 0.0), share) for box, share in boxes])


def _region(low: Floats, high: Floats, share: float) -> Region:
    corners = [(float(x), float(y), float(z)) for x, y, z in (low, high)]
    return Region(float((high - low).max()), corners[0], corners[1], share)


def _sorted(regions: list[Region]) -> tuple[Region, ...]:
    return tuple(sorted((r for r in regions if r.share >= _LEAST), key=lambda region: -region.size))


def _logistic(x: float) -> float:
    return 1.0 / (1.0 + math.exp(-x))
