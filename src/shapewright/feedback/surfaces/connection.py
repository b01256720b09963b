"""What is connected with what, by pairs of neighbours."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from shapewright.shapes import Floats, Ints


def connected(count: int, first: Ints, second: Ints) -> tuple[int, NDArray[np.intp]]:
    """How many connected sets ``count`` things form, and which set each belongs to, (count,).

    first, second: indices (K,) of things that are neighbours.
    """
    if not count:
        return 0, np.empty(0, dtype=np.intp)
    links = coo_matrix((np.ones(len(first)), (first, second)), shape=(count, count))
    number, component = connected_components(links, directed=False)
    return int(number), component


def connected_points(points: Floats, reach: float) -> tuple[int, NDArray[np.intp]]:
    """The same of points (N, 3), which are neighbours within a distance."""
    pairs = cKDTree(points).query_pairs(reach, output_type="ndarray")
    return connected(len(points), pairs[:, 0], pairs[:, 1])
