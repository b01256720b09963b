"""The plane cut into cells painted evenly: by all lines of a drawing, or by a grid where there are too many."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, cast

import numpy as np
import shapely
from contourpy import FillType, contour_generator
from numpy.typing import NDArray

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.svg.painting.layers import Area, Fill, Painted
from shapewright.shapes import Floats

_MOST_SEGMENTS = 150_000
_MOST_CROSSINGS = 30_000
"""A drawing of more lines or crossings is painted on a grid; up to here cells take a few seconds and 500 MB."""
_ASKED = 400
"""Segments whose crossings are counted, to estimate those of all."""
MOST = 1024
"""Pixels along the longer side of the grid."""
_HALF = 0.499
"""Darker is ink: black at 50 % is, and grey 128 of 255 is not. At a half itself outlines would touch one another."""
_FINE = 2
"""Samples along each side of a pixel of the grid."""
_SNAP = 1e-10
"""Of the extent: what lies closer is at one place. Rounding in transforms leaves gaps of 1e-15."""
_PAIRS = 4_000_000
"""Points times segments that are looked at together: 32 MB for each of a handful of arrays."""


class Faces:
    """The faces between all lines: exact, but for curves.

    Attributes:
        polygons: (N,) their geometry.
    """

    def __init__(self, areas: Sequence[Area], cuts: Sequence[Any]) -> None:
        rings = [ring for area in areas for ring in area.rings]
        points, which = _joined(rings)
        drawn: Any = shapely.linestrings(points, indices=which)
        lines = [*drawn, *cuts]
        size = float(np.ptp(np.concatenate([area.bounds for area in areas]), axis=0).max())
        if not size * _SNAP > 0.0 or not np.isfinite(size):
            raise UnreadableError("too large to measure")
        noded = shapely.union_all(lines, grid_size=size * _SNAP)
        self.polygons = shapely.get_parts(shapely.polygonize(shapely.get_parts(noded)))
        self._points = shapely.get_coordinates(shapely.point_on_surface(self.polygons))
        dots: Any = shapely.points(self._points)
        tree = shapely.STRtree(dots)
        self._inside = {area: _covered(area, self._points, tree) for area in areas}

    def points(self, where: NDArray[np.int64]) -> Floats:
        """(K, 2): one inside each of some faces."""
        return self._points[where]

    def inside(self, area: Area) -> NDArray[np.int64]:
        """The faces that an area covers; it is one of those that made them."""
        return self._inside[area]

    def dark(self, painted: Painted) -> Any:
        """The union of the faces that are darker than half on white."""
        parts = self.polygons[painted.where[painted.alpha - painted.light > _HALF]]
        return shapely.coverage_union_all(parts) if len(parts) > 1 else shapely.union_all(parts)


class Grid:
    """Samples of a picture, for a drawing of so many lines that it is read like one."""

    def __init__(self, box: Floats) -> None:
        self._step = float(np.ptp(box, axis=0).max()) / (MOST * _FINE)
        self._corner = box[0]
        columns, rows = np.maximum(np.ceil(np.ptp(box, axis=0) / self._step / _FINE), 1).astype(int) * _FINE
        self._shape = int(rows), int(columns)

    def points(self, where: NDArray[np.int64]) -> Floats:
        """(K, 2): the places of some samples."""
        rows, columns = np.divmod(where, self._shape[1])
        return cast("Floats", self._corner + (np.stack([columns, rows], axis=1) + 0.5) * self._step)

    def inside(self, area: Area) -> NDArray[np.int64]:
        """The samples that an area covers."""
        pairs = (_segments([area]) - self._corner) / self._step - 0.5
        left, top = (int(max(np.ceil(side), 0)) for side in pairs.min(axis=(0, 1)))
        right, bottom = (
            min(int(np.floor(side)) + 1, most)
            for side, most in zip(pairs.max(axis=(0, 1)), self._shape[::-1], strict=True)
        )
        if left >= right or top >= bottom:
            return np.empty(0, dtype=np.int64)
        rows, columns = bottom - top, right - left
        pairs = pairs - [left, top]
        turns = np.zeros(rows * (columns + 1), dtype=np.int32)
        low, high = (
            np.ceil(np.clip(ends, 0, rows)).astype(np.int64) for ends in (pairs[..., 1].min(1), pairs[..., 1].max(1))
        )
        for some in np.array_split(np.arange(len(pairs)), (high - low).sum() // _PAIRS + 1):
            crossed = (high - low)[some]
            segment = np.repeat(some, crossed)
            row = np.arange(len(segment)) - np.repeat(crossed.cumsum() - crossed - low[some], crossed)
            (x, y), (dx, dy) = pairs[segment, 0].T, (pairs[segment, 1] - pairs[segment, 0]).T
            column = np.ceil(np.clip(x + (row - y) / dy * dx, 0, columns)).astype(np.int64)
            np.add.at(turns, row * (columns + 1) + column, np.where(dy > 0.0, 1, -1).astype(np.int32))
        winding = turns.reshape(rows, columns + 1)[:, :-1].cumsum(axis=1)
        row, column = np.nonzero(winding % 2 if area.evenodd else winding)
        return np.asarray((row + top) * self._shape[1] + column + left, dtype=np.int64)

    def dark(self, painted: Painted) -> Any:
        """The outline of what is dark, by marching squares."""
        rows, columns = self._shape
        dark = np.zeros(rows * columns, dtype=np.float32)
        dark[painted.where] = painted.alpha - painted.light
        picture = dark.reshape(rows // _FINE, _FINE, columns // _FINE, _FINE).mean(axis=(1, 3), dtype=np.float64)
        grid, step = np.pad(picture, 1), self._step * _FINE
        (y, x), kind = map(np.arange, grid.shape), FillType.ChunkCombinedOffsetOffset
        found: Any = contour_generator(x - 0.5, y - 0.5, grid, fill_type=kind).filled(_HALF, np.inf)
        (points,), (offsets,), (parts,) = found
        if points is None:
            return shapely.Polygon()
        ring = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
        rings: Any = shapely.linearrings(self._corner + points * step, indices=ring)
        part = np.repeat(np.arange(len(parts) - 1), np.diff(parts.astype(np.int64)))
        return shapely.multipolygons(shapely.polygons(rings, indices=part))


def divided(fills: Sequence[Fill], box: Floats) -> Faces | Grid:
    """Cells on which a drawing can be painted; ``box`` (2, 2) is around all of it."""
    areas = list(dict.fromkeys(fill.area for fill in fills if fill.paint is not None))
    segments = sum(len(ring) - 1 for area in areas for ring in area.rings)
    if segments > _MOST_SEGMENTS or (segments > _ASKED and _crossings(areas, segments) > _MOST_CROSSINGS):
        return Grid(box)
    return Faces(areas, [cut for fill in fills if fill.paint for cut in fill.paint.cuts(fill.area.bounds)])


def _crossings(areas: Sequence[Area], segments: int) -> float:
    """About how often segments cross one another."""
    lines: Any = shapely.linestrings(_segments(areas))
    asked = np.random.default_rng(0).choice(segments, _ASKED, replace=False)
    met = shapely.STRtree(lines).query(lines[asked], predicate="crosses").shape[1]
    return float(met / _ASKED * segments / 2.0)


def _segments(areas: Sequence[Area]) -> Floats:
    """(S, 2, 2): the ends of all sides of areas."""
    return np.concatenate([np.stack([ring[:-1], ring[1:]], axis=1) for area in areas for ring in area.rings])


def _joined(rings: Sequence[Floats]) -> tuple[Floats, NDArray[np.int64]]:
    """The points of all rings, and of which ring each is."""
    return np.concatenate(rings), np.repeat(np.arange(len(rings)), [len(ring) for ring in rings])


def _covered(area: Area, points: Floats, tree: Any) -> NDArray[np.int64]:
    """Which of the points are inside an area, by its rule."""
    corners, which = _joined(area.rings)
    rings: Any = shapely.linearrings(corners, indices=which)
    polygons: Any = shapely.polygons(rings)
    valid: Any = shapely.is_valid(polygons)
    turns = np.zeros(len(points), dtype=np.int32)
    ring, point = tree.query(polygons[valid], predicate="contains")
    np.add.at(turns, point, np.where(shapely.is_ccw(rings[valid]), 1, -1)[ring])
    for line, good in zip(area.rings, valid, strict=True):
        if not good:
            near = np.flatnonzero(((points >= line.min(axis=0)) & (points <= line.max(axis=0))).all(axis=1))
            for some in np.array_split(near, len(near) * len(line) // _PAIRS + 1):
                turns[some] += _winding(line, points[some])
    return np.flatnonzero(turns % 2 if area.evenodd else turns)


def _winding(line: Floats, points: Floats) -> NDArray[np.int64]:
    """How often a closed line goes round each point, counter-clockwise."""
    x, y = line[:-1, 0] - points[:, :1], line[:-1, 1] - points[:, 1:]
    dx, dy = np.diff(line, axis=0).T
    side = dy * x - dx * y
    upward, downward = (y <= 0.0) & (y + dy > 0.0), (y > 0.0) & (y + dy <= 0.0)
    return cast("NDArray[np.int64]", (upward & (side > 0.0)).sum(axis=1) - (downward & (side < 0.0)).sum(axis=1))
