"""Geometries of the plane: shapely's, and closed rings."""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike

from shapewright.shapes.conversion.naming import called
from shapewright.shapes.drawing import Drawing


def convert(value: Any) -> Any:
    """The drawing of a shapely geometry, of the geometries of a geopandas table, or of their column."""
    if hasattr(value, "geom_type") and hasattr(value, "wkb"):
        return drawing_of(value)
    return list(getattr(value, "geometry", value))


def drawing_of(geometry: Any) -> Drawing:
    """The areas of a geometry or of a list of them. Raises ValueError, with the reason, where there are none."""
    import shapely

    parts = [part for part in shapely.get_parts(geometry) if part.area > 0.0]
    if not parts:
        raise ValueError(_why_empty(geometry))
    if not np.isfinite(shapely.get_coordinates(parts)).all():
        raise ValueError("some coordinates of the drawing are not finite (NaN or infinity)")
    return Drawing(cast("shapely.Polygon | shapely.MultiPolygon", shapely.union_all(parts)))


def rings(outlines: Iterable[ArrayLike]) -> Drawing:
    """What an odd number of closed outlines (N, 2) surrounds."""
    import shapely

    areas: list[Any] = [shapely.Polygon(), *(shapely.Polygon(np.asarray(ring)) for ring in outlines)]
    return drawing_of(reduce(shapely.symmetric_difference, areas))


def _why_empty(geometry: Any) -> str:
    import shapely

    crossing = [part for part in shapely.get_parts(geometry) if not part.is_empty and not part.is_valid]
    if crossing:
        why = shapely.is_valid_reason(crossing[0])
        return f"the outline crosses itself ({why}), so that it has no area; order its points, or use .buffer(0)"
    if any(not part.is_empty for part in shapely.get_parts(geometry)):
        return "the drawing is empty: give lines a width, for example with .buffer(0.01)"
    return f"the drawing is empty: {called(geometry)} without points"
