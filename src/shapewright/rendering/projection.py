"""Silhouettes of meshes as drawings: the union of all triangles, seen along an axis from far away."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias, cast

import numpy as np
import shapely

from shapewright.shapes import Drawing, Mesh

View: TypeAlias = Literal["front", "side", "top"]

# The axes of the picture, right and up: seen from +Z, from +X, and from +Y with the front below.
_AXES = {
    "front": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    "side": ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0)),
    "top": ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0)),
}
_GRID = 2.0**-20  # corners are snapped to this part of the largest extent: parts that are meant to touch then do
_SLIT = 2e-4
"""Gaps and slits no wider than twice this part of the largest extent are closed, slivers as thin are dropped."""


def silhouette(mesh: Mesh, view: View = "front") -> Drawing:
    """What the triangles of a mesh cover, exact but for gaps too small to see; open, doubled or inverted ones alike.

    Raises ValueError for another view, and for a mesh that shows no area from there.
    """
    if view not in _AXES:
        raise ValueError(f"view={view!r}: there is {', '.join(_AXES)}")
    normalised, size = mesh.normalised(), float(mesh.extent.max())
    flat = normalised.triangles @ np.array(_AXES[view]).T
    a, b = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    flat = flat[np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2.0 > _GRID**2]
    triangles: Any = shapely.polygons(np.unique(np.round(flat / _GRID), axis=0) * _GRID)
    covered = shapely.union_all(shapely.make_valid(triangles), grid_size=_GRID)
    closed = covered.buffer(_SLIT, join_style="mitre").buffer(-2.0 * _SLIT, join_style="mitre")
    parts = [part for part in shapely.get_parts(closed.buffer(_SLIT, join_style="mitre")) if part.area > 0.0]
    if not parts:
        raise ValueError(f"the shape shows no area from the {view}")
    area = shapely.transform(shapely.simplify(shapely.union_all(parts), _SLIT / 4.0), lambda points: points * size)
    return Drawing(cast("shapely.Polygon | shapely.MultiPolygon", area))
