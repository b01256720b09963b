"""Normals of points: by a plane through the neighbours of each, turned to the side that it is seen from."""

from __future__ import annotations

import numpy as np

from shapewright.shapes import Floats, Points

_NEIGHBOURS = 16
_DENSE = 100
"""Cells a point of which a whole grid is held: they take 800 bytes a point."""
_ROUNDS = 100  # of handing a side on to the neighbours
_FINE = 1.5  # cells of a view's grid, in units of the usual distance to the third neighbour


def with_normals(points: Points) -> Points:
    """The points with normals: those that are known stay, others are estimated and turned out of the surface.

    Where the sensor is known a normal looks to it. Else it looks to the sides that see the point, from 26 directions;
    one that no side sees goes by its neighbours.
    """
    from scipy.spatial import cKDTree  # it takes half a second to load

    known = np.zeros(len(points), dtype=bool) if points.normals is None else points.normals.any(axis=1)
    if known.all() or len(points) <= _NEIGHBOURS:
        return points
    distances, others = cKDTree(points.positions).query(points.positions, k=_NEIGHBOURS)
    itself = np.arange(len(points))[:, None]
    others = np.where(others < len(points), others, itself)  # beyond 1e154 the square of a distance overflows
    normals = _planes(points.positions, others)
    if points.seen_from is not None:
        side = np.einsum("nd,nd->n", points.seen_from - points.positions, normals)
    else:
        side = _seen_sides(points.positions, normals, _FINE * float(np.median(distances[:, 3])))
    normals = normals * _handed_on(np.sign(side), normals, others)[:, None]
    if points.normals is not None:
        normals[known] = points.normals[known]
    return Points(points.positions, normals, points.seen_from)


def _planes(positions: Floats, others: np.ndarray[tuple[int, int], np.dtype[np.int64]]) -> Floats:
    """(N, 3): the direction in which the neighbours of each point spread least."""
    near = positions[others]
    near = near - near.mean(axis=1, keepdims=True)
    return np.asarray(np.linalg.eigh(np.einsum("nki,nkj->nij", near, near))[1][:, :, 0])


def _seen_sides(positions: Floats, normals: Floats, cell: float) -> Floats:
    """(N,): above 0 where more is seen of a point from the side of its normal, below 0 from the other, 0 from none."""
    grid = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    side = np.zeros(len(positions))
    for direction in grid[np.abs(grid).sum(axis=1) > 0]:
        towards = direction / np.linalg.norm(direction)
        first = np.cross(towards, np.eye(3)[np.abs(towards).argmin()])
        first /= np.linalg.norm(first)
        cells = np.floor(positions @ np.stack([first, np.cross(towards, first)], axis=1) / max(cell, 1e-12))
        cells -= cells.min(axis=0)
        width, height = cells.max(axis=0) + 1.0
        if width * height <= _DENSE * len(cells):
            place = (cells[:, 0] * height + cells[:, 1]).astype(np.int64)
        else:  # points far away from all others
            place = np.unique(cells @ np.array([1.0, 1.0j]), return_inverse=True)[1]
        depth = positions @ towards
        front = np.full(place.max() + 1, -np.inf)
        np.maximum.at(front, place, depth)
        facing = normals @ towards
        seen = depth >= front[place] - 2.0 * cell  # a surface that is seen from its edge is deep in a cell
        side += np.where(seen, facing, 0.0)
    return side


def _handed_on(signs: Floats, normals: Floats, others: np.ndarray[tuple[int, int], np.dtype[np.int64]]) -> Floats:
    """(N,): the signs, and for each that is 0 the one by which its normal looks as those of its neighbours do."""
    for _ in range(_ROUNDS):
        open_ = np.flatnonzero(signs == 0.0)
        if not len(open_):
            return signs
        alike = np.einsum("nd,nkd->nk", normals[open_], normals[others[open_]])
        votes = np.sign((alike * signs[others[open_]]).sum(axis=1))
        if not votes.any():
            break
        signs[open_] = votes
    return np.where(signs == 0.0, 1.0, signs)
