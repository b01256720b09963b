"""The 24 ways to turn a shape by quarter turns, and what six pictures of it become by each."""

from __future__ import annotations

from itertools import permutations, product

import numpy as np

from shapewright.rendering.surround import AXES
from shapewright.shapes import Floats, Ints

VIEWS = AXES[:6]
"""(6, 3, 3): right, up and towards the viewer, from the front (+Z), right, back, left, above and below."""
FRONT, RIGHT, BACK, LEFT, ABOVE, BELOW = range(6)


def _turns() -> Floats:
    """The rotations among the matrices that permute the axes, as it stands first; none of them mirrors."""
    found = []
    for order, signs in product(permutations(range(3)), product((1.0, -1.0), repeat=3)):
        matrix = np.zeros((3, 3))
        matrix[range(3), order] = signs
        if np.linalg.det(matrix) > 0.0:
            found.append(matrix)
    return np.array(sorted(found, key=lambda matrix: not np.array_equal(matrix, np.eye(3))))


TURNS = _turns()
"""(24, 3, 3). A mirror image is none of them."""
AS_IT_IS = 0  # of TURNS
UPRIGHT = np.flatnonzero(TURNS[:, 1, 1] == 1.0)
"""(4,): of TURNS, those about the up axis."""


def turn_index(matrix: Floats) -> int:
    """Which of TURNS a matrix is."""
    return int(np.flatnonzero((matrix == TURNS).all(axis=(1, 2)))[0])


AFTER = np.array([[turn_index(second @ first) for first in TURNS] for second in TURNS])
"""(24, 24): the turn that is the first (column) and then the second (row)."""
INVERSE = np.argmax(AFTER == AS_IT_IS, axis=0)
"""(24,): the turn that undoes each."""
UPS = AFTER[UPRIGHT].min(axis=0)
"""(24,): the same number for turns that bring the same axis up."""


def _sources() -> Ints:
    sources = np.empty((len(TURNS), len(VIEWS), 2), dtype=np.int64)
    for number, turn in enumerate(TURNS):
        for view, (right, _, towards) in enumerate(VIEWS @ turn):  # in the frame of the shape as it was
            source = int(np.argmax(VIEWS[:, 2] @ towards))
            x, y = VIEWS[source, :2]
            quarters = next(q for q, axis in enumerate((x, -y, -x, y)) if np.allclose(axis, right))
            sources[number, view] = source, quarters
    return sources


SOURCES = _sources()
"""(24, 6, 2): the view of the shape as it was that shows each view after a turn, and its ``np.rot90``, in quarters."""
