import numpy as np
import pytest

from shapewright.comparison.surfaces import sample
from shapewright.feedback.parts.decomposition import MOST, decompose
from shapewright.feedback.surfaces.visible_surface import filled
from shapewright.modelling.solids import box, cylinder


def pieces(solid, count=1500):
    mesh = solid.mesh()
    unit = float(mesh.extent.max())
    points = sample(mesh.normalised(), count).points
    middle = mesh.bounds.mean(axis=0)
    points = mesh.normalisation().invert(filled(mesh.normalised(), points))
    return decompose(points, (middle[0], middle[2]), unit)


def test_a_column_on_a_foot_is_two_pieces():
    found = pieces(cylinder((0.1, 1, 0.1)) | cylinder((0.6, 0.06, 0.6), at=(0, -0.5, 0)))
    assert {piece.thin for piece in found} == {(False, True, False), (True, False, True)}
    assert not any(any(piece.mirrored) for piece in found) and len(found) == 2


def test_pairs_are_found_once_and_mirrored():
    leg = box((0.1, 1, 0.1), at=(3.4, 0, 0.3)).mirror("x", keep=True, about=(3, 0, 0)).mirror("z", keep=True)
    (found,) = pieces(leg)
    assert found.mirrored == (True, True) and found.middle == pytest.approx((3, 0))
    np.testing.assert_allclose(found.centre, (3.4, 0, 0.3), atol=0.02)
    np.testing.assert_allclose(found.size, (0.1, 1, 0.1), atol=0.03)


def test_an_h_of_bars_is_a_pair_and_a_bar():
    across = box((0.06, 0.06, 0.6), at=(0.5, 0, 0)).mirror("x", keep=True)
    found = pieces(across | box((1, 0.06, 0.06)))
    assert sorted(piece.mirrored for piece in found) == [(False, False), (True, False)]


def test_bars_at_equal_distances_are_slats():
    (found,) = pieces(box((0.05, 1, 0.03), at=(-0.4, 0, 0)).array(5, (0.2, 0, 0)))
    assert found.kind == "slats x" and found.count == 5
    np.testing.assert_allclose(found.size, (0.85, 1, 0.03), atol=0.03)


def test_few_points_and_many_pieces():
    assert decompose(np.zeros((5, 3)), (0, 0), 1.0) == ()
    rng = np.random.default_rng(0)
    scattered = np.concatenate([rng.uniform(-0.02, 0.02, (30, 3)) + place for place in rng.uniform(-1, 1, (20, 3))])
    assert len(decompose(scattered, (0, 0), 2.0)) == MOST
