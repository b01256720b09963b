"""The cameras of the light field descriptor: ten rotated dodecahedra, and the rotations that map one to another.

A light field has a camera on every vertex of a dodecahedron; opposite vertices see mirrored silhouettes, so ten of the
twenty are rendered (Chen et al. 2003, section 3). The figures below are those of the original program.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from scipy.spatial.transform import Rotation

from shapewright.shapes import Floats, Ints

LIGHT_FIELDS = 10
VIEWS = 10

# One vertex of each opposite pair, in the original's order and to its five digits.
_VERTICES = np.array(
    [
        [0.52573, 0.38197, 0.85065],
        [-0.20081, 0.61803, 0.85065],
        [-0.64984, 0.0, 0.85065],
        [-0.20081, -0.61803, 0.85065],
        [0.52573, -0.38197, 0.85065],
        [0.85065, -0.61803, 0.20081],
        [1.0515, 0.0, -0.20081],
        [0.85065, 0.61803, 0.20081],
        [0.32492, 1.0, -0.20081],
        [-0.32492, 1.0, 0.20081],
    ]
)

# Rotation vectors: the axis times the angle in radians.
_ROTATIONS = Rotation.from_rotvec(
    [
        [0.0, 0.0, 0.0],
        [-0.1465218, 0.5461549, 0.3315385],
        [0.0974377, -0.5929207, 0.5542729],
        [-0.0071129, -0.6019277, -0.4602872],
        [0.0317895, -0.4787862, 0.0815962],
        [0.5115268, -0.1102437, -0.0809637],
        [0.0035672, -0.0175852, -0.4166787],
        [0.5700900, -0.1912870, 0.3855966],
        [-0.4756066, -0.1419810, 0.2627057],
        [0.0141072, 0.0057610, 0.4314941],
    ]
)

_UPRIGHT_TILT = 12.0  # degrees, see upright_rotations
_NEIGHBOUR_COSINE = np.sqrt(5.0) / 3.0  # of the angle between a vertex and the three nearest to it


@cache
def directions() -> Floats:
    """Unit vectors (10, 10, 3) to the cameras: light field, view."""
    vertices = np.stack([rotation.apply(_VERTICES) for rotation in _ROTATIONS])
    return np.asarray(vertices / np.linalg.norm(vertices, axis=-1, keepdims=True))


def symmetries() -> Floats:
    """The sixty rotations (60, 3, 3) that map the first dodecahedron to itself, the identity first.

    A rotation is known by where it takes an edge with a direction: the 20 x 3 of them give the sixty.
    """
    vertices = np.concatenate([_VERTICES, -_VERTICES])
    vertices /= np.linalg.norm(vertices, axis=-1, keepdims=True)
    edges = np.argwhere(np.abs(vertices @ vertices.T - _NEIGHBOUR_COSINE) < 1e-3)
    frames = np.stack([_frame(vertices[start], vertices[end]) for start, end in edges])
    return np.asarray(frames @ frames[0].T)


def alignments() -> Ints:
    """Which view each view becomes under each of the sixty symmetries (60, 10), the identity first."""
    moved = np.einsum("kij,vj->kvi", symmetries(), _VERTICES)
    return np.asarray(np.abs(moved @ _VERTICES.T).argmax(axis=-1))


def relative_rotations() -> Floats:
    """The 6,000 rotations (10, 10, 60, 3, 3) that the distance tries between shape a and shape b.

    Element (i, j, k) compares light field i of a with light field j of b under alignment k: it supposes that
    b is a turned by this rotation.
    """
    frames = _ROTATIONS.as_matrix()
    return np.asarray(np.einsum("jab,kbc,idc->ijkad", frames, symmetries(), frames))


def upright_rotations() -> Ints:
    """The indices (R, 3), as in ``relative_rotations``, of the rotations that nearly keep the Y axis: 73 of the 6,000.

    Their tilt is at most 12 degrees, the least whole number with which the nearest of the 6,000 to any rotation about
    Y is among them (7 degrees away from it on average, 14 at most).
    """
    tilt_cosines = relative_rotations()[..., 1, 1]
    return np.argwhere(tilt_cosines >= np.cos(np.radians(_UPRIGHT_TILT)))


def _frame(first: Floats, second: Floats) -> Floats:
    """A right-handed orthonormal frame, as columns, whose first axis is ``first``."""
    third = np.cross(first, second)
    third /= np.linalg.norm(third)
    return np.stack([first, np.cross(third, first), third], axis=-1)
