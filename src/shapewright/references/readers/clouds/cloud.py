"""The points of a file as it holds them, and those of them that can be used."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.shapes import Floats, Points

LEAST = 100
"""Fewer points than these show no surface: with a hundred a chair's seat has some ten of them."""
MOST = 20_000_000
"""Points of a file, whose positions take half a gigabyte. A packed file can announce any number."""
_LARGEST = 1e100  # coordinates whose cubes are numbers still


@dataclass(frozen=True, eq=False)
class Cloud:
    """The points of a file.

    Attributes:
        positions: (N, 3) float64, in the file's own units and axes; those that are not known are not finite.
        normals: (N, 3), of any length, not finite or 0 where one is not known; None where none is.
        seen_from: (N, 3), or one place (3,) for all: where the sensor stood; None where that is not known.
        notes: what of the file was left out.
        unit: in metres, where the format states it; else None.
        up: the axis that points up, where the format states it; else None.
    """

    positions: Floats
    normals: Floats | None = None
    seen_from: Floats | None = None
    notes: tuple[str, ...] = ()
    unit: float | None = None
    up: str | None = None


def usable(cloud: Cloud) -> tuple[Points, tuple[str, ...]]:
    """The points that have a place, and the cloud's notes with what was left out.

    Raises UnreadableError where fewer than LEAST remain, or all lie at one place.
    """
    finite = np.asarray(np.isfinite(cloud.positions).all(axis=1))
    lost = len(finite) - int(finite.sum())
    told = f"{lost} of {len(finite)} points left out: their places are not finite"
    notes = (*cloud.notes, told) if lost else cloud.notes
    if len(finite) - lost < LEAST:
        few = f"only {len(finite) - lost} points, too few to show a surface: {LEAST} at least"
        raise UnreadableError("; ".join([few, *notes]))
    positions = cloud.positions[finite] if lost else cloud.positions
    size = float(np.ptp(positions, axis=0).max()) if np.abs(positions).max() < _LARGEST else np.inf
    if not 1.0 / _LARGEST < size < np.inf:
        raise UnreadableError("all its points lie at one place" if size < 1.0 else "too large to measure")
    normals, seen_from = cloud.normals, cloud.seen_from
    if normals is not None:
        normals = np.nan_to_num(normals[finite] if lost else normals, nan=0.0, posinf=0.0, neginf=0.0)
        normals = normals if normals.any() else None  # programs write zeros where they know none
    if seen_from is not None:
        seen_from = seen_from[finite] if lost and seen_from.ndim == 2 else seen_from
        seen_from = seen_from if np.isfinite(seen_from).all() else None
    return Points(positions, normals, seen_from), notes


def refuse_count(declared: int, held: int) -> None:
    """Raise UnreadableError for more points than are read, or than so many bytes can hold.

    Packed points take a bit or more each: LAZ and E57 of real scans take 20 to 60 bits (measured on PDAL's test data).
    """
    if declared > 8 * held:
        raise UnreadableError(f"broken: it declares {declared:,} points in {held:,} bytes")
    if declared > MOST:
        raise UnreadableError(f"{declared:,} points, more than the {MOST:,} that are read; thin it first")
