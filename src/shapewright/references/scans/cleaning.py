"""Points as they come from a file or a scanner, made ready to be compared: each step with a note, and a switch."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from shapewright.references.scans.floor import floor
from shapewright.references.scans.normals import with_normals
from shapewright.references.scans.steps import Kept
from shapewright.references.scans.strays import strays
from shapewright.references.scans.thinning import evened, thinned
from shapewright.shapes import Points

MOST = 20_000
"""Points of a reference. Pictures of 64 pixels and the judge's measures change by less than their noise beyond it."""
_BEFORE = 60_000  # points that are cleaned: three times as many, so that a floor may take two thirds


def cleaned(points: Points, keep: Collection[Kept] = (), seed: int = 0) -> tuple[Points, tuple[str, ...]]:
    """Points (Y up) without floor and strays, evened and thinned to MOST, with normals; and notes on what was done.

    keep: the steps that are left out. seed: of the search for a floor.
    """
    notes: list[str] = []
    count = len(points)
    points = _thinned(points, _BEFORE)
    if "floor" not in keep and (found := floor(points.positions, seed)) is not None:
        points = points.chosen(~found)
        notes.append(f"a floor left out, {found.mean():.0%} of the points")
    if "strays" not in keep and (lost := strays(points.positions)).any():
        points = points.chosen(~lost)
        notes.append(f"{lost.sum()} stray point{'' if lost.sum() == 1 else 's'} left out")
    if "density" not in keep and len(rows := evened(points.positions)) < len(points):
        notes.append(f"of uneven density: {len(points) - len(rows)} points left out where they are dense")
        points = points.chosen(rows)
    before, points = len(points), _thinned(points, MOST)
    if count > _BEFORE or len(points) < before:
        notes.append(f"thinned evenly: {len(points):,} of {count:,} points are used")
    estimated = points.normals is None or not points.normals.any(axis=1).all()
    if estimated:
        points = with_normals(points)
        notes.append("normals estimated, " + ("towards the sensor" if points.seen_from is not None else "outwards"))
    return points, tuple(notes)


def _thinned(points: Points, most: int) -> Points:
    rows = thinned(points.positions, most)
    return points if len(rows) == len(points) else points.chosen(np.asarray(rows))
