"""A reference of points, made ready to be compared: with less noise, thinned, and with a tree of its neighbours."""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from shapewright.shapes import Floats, Points

_MOST = 20_000  # points that are looked at: more tell nothing more at a sixtieth of the largest extent
_NEIGHBOURS = 16  # through which the plane of a point is laid
_CURVED = 2.5  # times the usual unevenness: a point whose neighbours are less flat stays where it is
_CELL = 0.02  # of the largest extent: of the points in such a cell one is kept
_KEPT = 1200  # most points whose distance to a replica is taken: a mean then varies by 3 %
_SENSORS = 12  # most places from which a scan was seen that are told apart


@dataclass(frozen=True, eq=False)
class Scan:
    """Points of a normalised reference, in its frame.

    points: (K, 3), spread evenly, K at most 1200.
    positions: (N, 3), all of them, of which ``points`` are some.
    spacing: the usual distance between neighbours among ``positions``.
    noise: how far points usually lie beside the plane of their neighbours.
    places: (S, 3), from where the scan was seen; None where that is not known.
    """

    points: Floats
    positions: Floats
    spacing: float
    noise: float
    places: Floats | None

    @classmethod
    def of(cls, points: Points, seed: int = 0) -> Scan:
        """Of normalised points. Raises ValueError for fewer than 16."""
        if len(points) < _NEIGHBOURS:
            raise ValueError(f"{len(points)} points are too few to compare; there have to be {_NEIGHBOURS}")
        rng = np.random.default_rng(seed)
        if len(points) > _MOST:
            points = points.chosen(np.sort(rng.choice(len(points), _MOST, replace=False)))
        positions, spacing, noise = _flattened(points.positions)
        return cls(_thinned(positions, rng), positions, spacing, noise, _sensors(points.seen_from))

    @functools.cached_property
    def tree(self) -> cKDTree:
        return cKDTree(self.positions)

    @functools.cached_property
    def start(self) -> tuple[float, Floats]:
        """Scale and shift that normalise the points by their bounding box without noise."""
        low, high = self.positions.min(axis=0), self.positions.max(axis=0)
        scale = 1.0 / float((high - low).max())
        return scale, -scale * (low + high) / 2.0


def _flattened(positions: Floats) -> tuple[Floats, float, float]:
    """Points moved onto the plane of their neighbours, where that is flat; their spacing, and their noise."""
    distances, near = cKDTree(positions).query(positions, k=_NEIGHBOURS)
    around = positions[near]
    middle = around.mean(axis=1)
    away = around - middle[:, None]
    spread, axes = np.linalg.eigh(np.einsum("nki,nkj->nij", away, away) / _NEIGHBOURS)
    uneven = np.sqrt(np.maximum(spread[:, 0], 0.0))
    noise = float(np.median(uneven))
    normal = axes[:, :, 0]
    height = np.einsum("ni,ni->n", positions - middle, normal)
    flat = uneven <= _CURVED * noise
    moved = positions - np.where(flat, np.clip(height, -3.0 * noise, 3.0 * noise), 0.0)[:, None] * normal
    return moved, float(np.median(distances[:, 4])) / 1.25, noise


def _thinned(positions: Floats, rng: np.random.Generator) -> Floats:
    """One of the points in each cell, at most _KEPT of them."""
    order = rng.permutation(len(positions))
    cells = np.floor(positions[order] / _CELL).astype(np.int64)
    _, first = np.unique(cells, axis=0, return_index=True)
    return positions[order[np.sort(first)[:_KEPT]]]


def _sensors(seen_from: Floats | None) -> Floats | None:
    """The places that most points were seen from; None where none is known."""
    if seen_from is None:
        return None
    places, counts = np.unique(np.round(seen_from, 2), axis=0, return_counts=True)
    return np.asarray(places[np.argsort(-counts, kind="stable")[:_SENSORS]])
