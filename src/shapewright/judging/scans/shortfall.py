"""How a replica differs from a scan: as numbers, and as regions.

What was scanned has to be there. What the replica has besides counts only where the scan would show it.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from shapewright.comparison.scans.laid import Laid, lay
from shapewright.comparison.scans.scan import Scan
from shapewright.judging import pixels
from shapewright.judging.verdict import Region
from shapewright.shapes import Floats, Mesh

_MOST = 0.08  # of the largest extent: what is farther apart counts alike, as for meshes
_NEAR, _FAR = 0.025, 0.06  # of the largest extent: as for meshes
_STANDS_OUT = 4.0  # usual gaps beyond which a gap stands out
_LEAST = 0.006  # share of the points below which a region is left out: seven of them; for meshes it is .004


@dataclass(frozen=True)
class Shortfall:
    """What the judge of scans goes by; 0 is equal."""

    gap: float  # mean distance of the scan to the replica, in units of the largest extent
    usual_gap: float  # the median of that distance
    near_missing: float  # share of the scan beyond _NEAR of the replica
    far_missing: float  # share of the scan beyond _FAR
    missing: float  # side of the largest region of the scan beyond _NEAR, as the root of its share
    missing_beside: float  # the same of what stands out: beyond _STANDS_OUT usual gaps
    excess: float  # mean distance to the scan of what the scan would show of the replica
    near_surplus: float  # share of that beyond _NEAR of the scan
    far_surplus: float  # share of that beyond _FAR
    surplus: float  # side of the largest region of that beyond _NEAR, as the root of its share
    surplus_beside: float  # the same of what stands out
    hidden: float  # share of the replica's surface that the scan would not show

    def row(self) -> Floats:
        """(12,): all of them, in their order."""
        return np.array([getattr(self, field.name) for field in fields(self)])


@dataclass(frozen=True, eq=False)
class Compared:
    """A scan and a replica, compared."""

    shortfall: Shortfall
    laid: Laid


def compare(scan: Scan, replica: Mesh) -> Compared:
    """Raises ValueError for a replica without area."""
    laid = lay(scan, replica)
    lost, extra = np.minimum(laid.missing, _MOST), np.minimum(laid.surplus, _MOST)[laid.seen]
    places = laid.samples[laid.seen]
    usual = float(np.median(lost))
    beside = min(max(_NEAR, _STANDS_OUT * usual), 0.99 * _MOST)
    own = laid.scale * scan.points + laid.shift
    return Compared(
        Shortfall(
            gap=float(lost.mean()),
            usual_gap=usual,
            near_missing=_share(lost > _NEAR),
            far_missing=_share(lost > _FAR),
            missing=_largest(own, lost > _NEAR),
            missing_beside=_largest(own, lost > beside),
            excess=float(extra.mean()) if len(extra) else 0.0,
            near_surplus=_share(extra > _NEAR),
            far_surplus=_share(extra > _FAR),
            surplus=_largest(places, extra > _NEAR),
            surplus_beside=_largest(places, extra > beside),
            hidden=1.0 - _share(laid.seen),
        ),
        laid,
    )


def regions(scan: Scan, compared: Compared) -> tuple[tuple[Region, ...], tuple[Region, ...]]:
    """The missing and the surplus regions, the largest first, in the frame of the scan."""
    laid = compared.laid
    extra = laid.seen & (laid.surplus > _NEAR)
    return _regions(scan.points, laid.missing > _NEAR), _regions(laid.in_scan(laid.samples), extra)


def _share(which: NDArray[np.bool_]) -> float:
    return float(which.mean()) if len(which) else 0.0


def _largest(places: Floats, apart: NDArray[np.bool_]) -> float:
    """The root of the share of the points that the largest connected region of those apart holds."""
    if np.count_nonzero(apart) < 2:
        return 0.0
    numbers = _numbered(places[apart])
    return float(np.sqrt(np.bincount(numbers).max() / len(places)))


def _numbered(places: Floats) -> NDArray[np.int64]:
    """(N,): the number, from 0, of the connected region of cells that holds each place."""
    steps = np.clip(((places + 0.5) * pixels.CELLS).astype(np.int64), 0, pixels.CELLS - 1) + 1
    cells = (steps[:, 0] * pixels.GRID + steps[:, 1]) * pixels.GRID + steps[:, 2]
    inside = np.zeros(pixels.GRID**3, dtype=np.bool_)
    inside[cells] = True
    numbers = np.zeros(len(inside), dtype=np.int64)
    pixels.connect(inside, numbers)
    return np.asarray(numbers[cells] - 1)


def _regions(places: Floats, apart: NDArray[np.bool_]) -> tuple[Region, ...]:
    if not apart.any():
        return ()
    far, found = places[apart], []
    numbers = _numbered(far)
    for number in range(numbers.max() + 1):
        own = far[numbers == number]
        share = len(own) / len(places)
        if share >= _LEAST:
            low, high = own.min(axis=0), own.max(axis=0)
            found.append(Region(float((high - low).max()), tuple(low.tolist()), tuple(high.tolist()), share))
    return tuple(sorted(found, key=lambda region: -region.size))
