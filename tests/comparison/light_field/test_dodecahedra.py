from pathlib import Path

import numpy as np
import pytest

from shapewright.comparison.light_field.dodecahedra import (
    alignments,
    directions,
    relative_rotations,
    symmetries,
    upright_rotations,
)

SHARED = Path(__file__).resolve().parents[3].parent / "shared"


def test_cameras_stand_on_dodecahedra():
    cameras = directions()
    assert cameras.shape == (10, 10, 3)
    cosines = np.abs(np.einsum("fva,fwa->fvw", cameras, cameras))
    expected = np.sort([1.0] + [np.sqrt(5) / 3] * 3 + [1 / 3] * 6)
    assert np.allclose(np.sort(cosines, axis=-1), expected, atol=1e-4)


def test_symmetries_are_a_group_of_sixty_rotations():
    rotations = symmetries()
    assert rotations.shape == (60, 3, 3)
    assert np.allclose(rotations[0], np.eye(3))
    assert np.allclose(np.linalg.det(rotations), 1.0)
    products = np.einsum("aij,bjk->abik", rotations, rotations).reshape(-1, 1, 9)
    nearest = np.abs(products - rotations.reshape(1, 60, 9)).max(axis=-1).min(axis=-1)
    assert nearest.max() < 1e-3  # the vertices have five digits


def test_alignments_permute_views_and_have_inverses():
    rows = {tuple(row) for row in alignments()}
    assert len(rows) == 60
    assert tuple(range(10)) in rows
    assert all(sorted(row) == list(range(10)) for row in rows)
    assert {tuple(np.argsort(row)) for row in rows} == rows  # so that distances are symmetric


def test_a_relative_rotation_turns_the_views_of_one_field_into_those_of_another():
    cameras, rows, rotations = directions(), alignments(), relative_rotations()
    for i, j, k in ((0, 0, 7), (2, 5, 31), (9, 1, 59)):
        turned = cameras[i] @ rotations[i, j, k].T
        assert np.allclose(np.abs((turned * cameras[j, rows[k]]).sum(axis=-1)), 1.0, atol=1e-4)


def test_upright_rotations_hold_the_nearest_to_any_turn_about_y():
    kept = upright_rotations()
    rotations = relative_rotations()
    assert len(kept) == 73
    assert {(i, i, 0) for i in range(10)} <= {tuple(row) for row in kept}
    angles = np.radians(np.arange(0.0, 360.0, 0.5))
    zeros, ones = np.zeros_like(angles), np.ones_like(angles)
    turns = np.stack(
        [np.cos(angles), zeros, np.sin(angles), zeros, ones, zeros, -np.sin(angles), zeros, np.cos(angles)], axis=-1
    )
    alike = turns @ rotations.reshape(-1, 9).T  # the trace of the rotation between them
    alike_kept = turns @ rotations[tuple(kept.T)].reshape(-1, 9).T
    assert np.array_equal(alike.max(axis=1), alike_kept.max(axis=1))


@pytest.mark.skipif(not (SHARED / "data" / "lfd").is_dir(), reason="needs ../shared/data/lfd")
def test_cameras_and_alignments_are_the_originals():
    original = np.load(SHARED / "data" / "lfd" / "cameras.npz")
    theirs = original["directions"][:, :10]
    assert np.allclose(directions(), theirs / np.linalg.norm(theirs, axis=-1, keepdims=True), atol=1e-6)
    assert {tuple(row) for row in alignments()} == {tuple(row) for row in original["alignments"]}
