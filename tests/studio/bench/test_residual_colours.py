"""Distances to a surface, and the meshes that show them."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from shapewright.comparison.surface_distance import NearSurface
from shapewright.modelling.solids import box
from shapewright.shapes import Mesh, concatenate
from shapewright.studio.bench.residual_colours import LIMIT, refined, residual, scale


def test_refined_is_the_same_surface_in_smaller_triangles() -> None:
    mesh = box((1, 0.5, 0.02)).mesh()
    fine = refined(mesh, 0.05)
    edges = fine.triangles - np.roll(fine.triangles, -1, axis=1)
    assert np.linalg.norm(edges, axis=2).max() <= 0.05
    assert np.abs(NearSurface(mesh).distances(fine.vertices)).max() < 1e-12
    assert trimesh.Trimesh(fine.vertices, fine.faces, process=False).area == pytest.approx(2 * (0.5 + 0.02 + 0.01))


def test_of_many_triangles_the_largest_are_cut_first() -> None:
    many = trimesh.creation.icosphere(6, radius=0.1)
    ball = Mesh(np.asarray(many.vertices), np.asarray(many.faces))
    fine = refined(concatenate([ball, box((1, 1, 1)).mesh()]), 0.05)
    lengths = np.linalg.norm(fine.triangles - np.roll(fine.triangles, -1, axis=1), axis=2).max(axis=1)
    assert lengths.max() < 0.06 and len(fine.faces) <= 1.25 * len(ball.faces) + 20


def test_colours() -> None:
    low, none, high, beyond = scale(np.array([-LIMIT, 0.0, LIMIT, 5.0]))
    assert np.ptp(none) < 0.05
    assert high[0] > 2 * high[2] and low[2] > 2 * low[0] and (high == beyond).all()


def test_residual_of_a_shifted_box() -> None:
    found = residual(refined(box((1, 1, 1), at=(0, 0.05, 0)).mesh()), NearSurface(box((1, 1, 1)).mesh()))
    top = found.vertices[:, 1] > 0.5499
    assert found.signed and np.allclose(found.distances[top], 0.05)
    bottom = (found.vertices[:, 1] < -0.4499) & (np.abs(found.vertices[:, [0, 2]]).max(axis=1) < 0.4)
    assert np.allclose(found.distances[bottom], -0.05)
    assert found.colours.shape == found.vertices.shape and found.colours.min() >= 0 and found.colours.max() <= 1
