"""The exact shapes of USD as triangles: cubes, spheres, cylinders, cones, capsules and planes, turned outward."""

from __future__ import annotations

import numpy as np

from shapewright.references.readers.scene_parts import Piece
from shapewright.shapes import Floats

AROUND = 64
"""Sides of what is round, so that its area is less than 0.2 % too small."""
_QUARTER = AROUND // 4


def cuboid(sizes: Floats) -> Piece:
    """Centred; ``sizes`` (3,) along x, y and z."""
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * sizes
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    return corners, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def plane(sizes: Floats) -> Piece:
    """A rectangle across z, centred; ``sizes`` (2,) along x and y."""
    corners = np.array([[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.5, 0.5, 0.0], [-0.5, 0.5, 0.0]])
    return corners * [*sizes, 1.0], np.array([[0, 1, 2], [0, 2, 3]])


def sphere(radius: float) -> Piece:
    angles = np.linspace(-np.pi / 2, np.pi / 2, 2 * _QUARTER + 1)
    return turned(np.stack([radius * np.cos(angles), radius * np.sin(angles)], axis=1))


def frustum(bottom: float, top: float, height: float) -> Piece:
    """A cylinder or a cone along z, centred, by its two radii."""
    half = height / 2
    return turned(np.array([[0.0, -half], [bottom, -half], [top, half], [0.0, half]]))


def capsule(bottom: float, top: float, height: float) -> Piece:
    """Along z, centred: half spheres of two radii, whose centres are ``height`` apart."""
    lower, upper = np.linspace(-np.pi / 2, 0.0, _QUARTER + 1), np.linspace(0.0, np.pi / 2, _QUARTER + 1)
    below = np.stack([bottom * np.cos(lower), bottom * np.sin(lower) - height / 2], axis=1)
    above = np.stack([top * np.cos(upper), top * np.sin(upper) + height / 2], axis=1)
    return turned(np.concatenate([below, above]))


def turned(profile: Floats) -> Piece:
    """A profile (n, 2) of radii and heights, from the bottom to the top, turned about z."""
    angles = 2 * np.pi * np.arange(AROUND) / AROUND
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    radii, heights = profile[:, 0], profile[:, 1]
    points = np.concatenate(
        [
            (radii[:, None, None] * ring).reshape(-1, 2),
            np.repeat(heights, AROUND)[:, None],
        ],
        axis=1,
    )
    row, side = np.meshgrid(np.arange(len(profile) - 1), np.arange(AROUND), indexing="ij")
    a, b = row * AROUND + side, row * AROUND + (side + 1) % AROUND
    faces = np.stack([np.stack([a, b, b + AROUND], -1), np.stack([a, b + AROUND, a + AROUND], -1)], -2).reshape(-1, 3)
    corners = points[faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return points, faces[area > 1e-12 * np.abs(profile).max(initial=0.0) ** 2]


def along(axis: str, piece: Piece) -> Piece:
    """A piece along z, turned so that it lies along another axis."""
    order = {"X": [2, 0, 1], "Y": [1, 2, 0]}.get(axis, [0, 1, 2])
    return piece[0][:, order], piece[1]
