"""Where a drawing differs from its reference: areas of either that the other does not come near."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import shapely

from shapewright.feedback.surfaces.oriented_boxes import fit_box
from shapewright.feedback.surfaces.residuals import FAR, LEAST, NEAR, Region, RegionSide
from shapewright.shapes import Drawing, Floats

Area: TypeAlias = shapely.Polygon | shapely.MultiPolygon
_SPACING = 0.01
"""Between the points of an area, half of NEAR: the thinnest area is a few points wide."""


@dataclass(frozen=True, eq=False)
class Areas:
    """In which areas two drawings differ, as ``Residuals`` has it of surfaces. Regions lie in the plane z = 0."""

    measured, dimensions = "area", 2
    regions: tuple[Region, ...]  # the weightiest first

    def __iter__(self) -> Iterator[Region]:
        return iter(self.regions)

    def of(self, side: RegionSide) -> tuple[Region, ...]:
        return tuple(region for region in self.regions if region.side == side)


def areas(reference: Drawing, replica: Drawing) -> Areas:
    """Compare two drawings in place, each normalised: neither is moved, turned or mirrored.

    An area holds a point further than FAR from the other drawing, and all points around it further than NEAR. Its share
    is of the area of its drawing.
    """
    ours, theirs = reference.normalised().geometry, replica.normalised().geometry
    regions = [*_regions("unexplained", ours, theirs), *_regions("surplus", theirs, ours)]
    return Areas(tuple(sorted(regions, key=lambda region: -region.weight)))


def _regions(side: RegionSide, own: Area, other: Area) -> Iterator[Region]:
    for piece in shapely.get_parts(own.difference(other.buffer(NEAR))):
        share = float(piece.area) / own.area
        if share < LEAST:
            continue
        points = _points(piece)
        away = shapely.distance(shapely.points(points[:, :2]), other)
        if away.max() > FAR:
            rows = np.empty(0, dtype=np.int64)
            yield Region(side, points, fit_box(points), share, float(away.mean()), None, None, rows)


def _points(piece: Area) -> Floats:
    """(N, 3): its corners, and points on a grid inside it, whose z is 0."""
    left, low, right, high = piece.bounds
    grid = np.meshgrid(np.arange(left, right, _SPACING), np.arange(low, high, _SPACING))
    inside = np.stack(grid, axis=-1).reshape(-1, 2)
    inside = inside[shapely.contains_xy(piece, inside[:, 0], inside[:, 1])]
    flat = np.concatenate([shapely.get_coordinates(piece), inside])
    return np.pad(flat, ((0, 0), (0, 1)))
