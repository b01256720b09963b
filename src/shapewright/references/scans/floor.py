"""The floor that a scanned thing stands on: a level plane below all of it that reaches further than it on its sides.

The plane is found by RANSAC (Fischler, Bolles 1981). A plane that the thing itself could have, such as a seat, the top
of a table, a mattress, or the plate under a lamp, is none: points lie below it, or it reaches no further than the rest.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shapewright.references.orientation import AXES, Orientation
from shapewright.references.scans.strays import strays
from shapewright.shapes import Floats

_TRIALS = 400
"""Planes that are tried: with a fifth of the lower points on the floor one of 86 has three of them."""
_SEEN = 3000  # points that a trial counts
_LOOKED_AT = 20_000  # points in which the axis that points up is looked for
_LOWER = 0.5  # share of the height in which a floor is looked for
_TILT = 0.94  # cosine of 20 degrees: scanners are set up by eye
_THICK = 0.01  # of the largest extent: how far a floor's points may be off, before its own noise is known
_BELOW = 0.01  # share of the points that may lie below a floor, as strays do
_LEAST = 0.05  # share of all points that a floor has
_SPREAD = 3.0  # standard deviations of the floor's noise that count as floor
_CLEAR, _FEET, _NEAR = 1.5, 4.0, 1.2
"""Times the floor's thickness: how high above it no point is of its noise, how low one is of a foot, and how near to
such a one the floor is under it."""
_BEYOND = 0.1  # share of the thing's width by which a floor reaches further on a side
_SIDES = 3  # of four; a wall may stand at the fourth
_WIDE = 0.75
"""Share of the thing's height that a floor is wide at least. Feet of lamps and stands reach .6 of it."""


@dataclass(frozen=True)
class _Plane:
    """Points p with normal . p = offset; the normal, of length 1, points up."""

    normal: Floats
    offset: float

    def heights(self, positions: Floats) -> Floats:
        return np.asarray(positions @ self.normal - self.offset)


def floor(positions: Floats, seed: int = 0) -> NDArray[np.bool_] | None:
    """Which points (N,) are a floor and what lies below it; None where there is no floor.

    positions: (N, 3), Y up. seed: of the planes that are tried. The points under what stands on the floor stay, so that
    a leg keeps its end.
    """
    extent = float(np.ptp(positions, axis=0).max())
    plane = _lowest_plane(positions, _THICK * extent, np.random.default_rng(seed))
    if plane is None:
        return None
    thickness = _THICK * extent
    for _ in range(3):  # the plane by its points, and these by the plane and its noise
        heights = plane.heights(positions)
        on = np.abs(heights) <= thickness
        if on.sum() < max(3, _LEAST * len(positions)):
            return None
        plane = _fitted(positions[on])
        noise = 1.4826 * float(np.median(np.abs(plane.heights(positions[on]))))  # of a normal distribution
        thickness = min(thickness, max(_SPREAD * noise, 1e-6 * extent))
    heights = plane.heights(positions)
    on, above = np.abs(heights) <= thickness, heights > thickness
    if (heights < -thickness).sum() > _BELOW * len(positions) or on.sum() < _LEAST * len(positions):
        return None
    across = _axes(plane.normal)
    thing = (heights > _CLEAR * thickness) & ~strays(positions)
    if not thing.any() or not _reaches_further(
        positions[on] @ across, positions[thing] @ across, float(heights[thing].max())
    ):
        return None
    return ~above & ~_under(positions, on, thing & (heights < _FEET * thickness), thickness)


def up_by_floor(positions: Floats, seed: int = 0) -> str | None:
    """The axis that points up by the floor with the most points, -x to z; None where there is no floor along any.

    positions: (N, 3), in the axes of a file. A few thousand of them, chosen by the seed, are looked at.
    """
    some = positions[np.random.default_rng(seed).permutation(len(positions))[:_LOOKED_AT]]
    shares = {axis: floor(some @ Orientation.of(axis).matrix.T, seed) for axis in AXES}
    found = {axis: float(on.mean()) for axis, on in shares.items() if on is not None}
    return max(found, key=lambda axis: found[axis]) if found else None


def _lowest_plane(positions: Floats, thickness: float, rng: np.random.Generator) -> _Plane | None:
    """The level plane with most points among those with hardly any below; None where there is none."""
    seen = positions[rng.permutation(len(positions))[:_SEEN]]
    low, high = np.percentile(seen[:, 1], [0.5, 99.5])
    lower = seen[seen[:, 1] < low + _LOWER * (high - low)]
    if len(lower) < 3:
        return None
    a, b, c = np.moveaxis(lower[rng.integers(len(lower), size=(_TRIALS, 3))], 1, 0)
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    level = np.abs(normals[:, 1]) >= np.maximum(_TILT * lengths, np.finfo(np.float64).tiny)
    if not level.any():
        return None
    normals = normals[level] / (lengths * np.sign(normals[:, 1]))[level, None]
    offsets = np.einsum("td,td->t", normals, a[level])
    heights = seen @ normals.T - offsets
    counts = np.where(
        (heights < -thickness).sum(axis=0) <= _BELOW * len(seen), (np.abs(heights) <= thickness).sum(axis=0), 0
    )
    best = int(counts.argmax())
    return _Plane(normals[best], float(offsets[best])) if counts[best] else None


def _fitted(points: Floats) -> _Plane:
    """The plane with the least squares of distances."""
    centre = points.mean(axis=0)
    normal = np.linalg.eigh(np.cov((points - centre).T))[1][:, 0]
    normal = normal * (1.0 if normal[1] >= 0.0 else -1.0)
    return _Plane(normal, float(normal @ centre))


def _axes(normal: Floats) -> Floats:
    """(3, 2): two directions in the plane, at right angles."""
    first = np.cross(normal, [0.0, 0.0, 1.0] if abs(normal[2]) < 0.9 else [1.0, 0.0, 0.0])
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(normal, first)], axis=1)


def _reaches_further(on: Floats, above: Floats, height: float) -> bool:
    """Whether the points of a floor (F, 2) reach further than what is above it (A, 2) on its sides."""
    thing, ground = (np.percentile(points, [0.5, 99.5], axis=0) for points in (above, on))
    width = float(np.ptp(thing, axis=0).max())
    beyond = np.concatenate([thing[0] - ground[0], ground[1] - thing[1]])
    return bool((beyond > _BEYOND * width).sum() >= _SIDES and np.ptp(ground, axis=0).min() >= _WIDE * height)


def _under(positions: Floats, on: NDArray[np.bool_], feet: NDArray[np.bool_], thickness: float) -> NDArray[np.bool_]:
    """Which points of the floor something stands on: they have feet right above them."""
    from scipy.spatial import cKDTree  # it takes half a second to load

    under = np.zeros(len(positions), dtype=bool)
    if feet.any():
        under[on] = cKDTree(positions[feet]).query(positions[on])[0] <= _NEAR * thickness
    return under
