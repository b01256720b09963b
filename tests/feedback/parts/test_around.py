import numpy as np
import pytest

from shapewright.comparison.surfaces import sample
from shapewright.feedback.parts.around import spokes, turns
from shapewright.feedback.parts.decomposition import decompose
from shapewright.feedback.parts.pieces import Piece
from shapewright.modelling.solids import box, cylinder


def piece(count, turn, kind="spokes", depth=1.0):
    low, high = np.array([-0.5, -0.4, -depth / 2]), np.array([0.5, -0.3, depth / 2])
    return Piece(kind, low, high, count=count, breadth=0.08, turn=turn)


@pytest.mark.parametrize("kind", ["spokes", "sloping spokes"])
@pytest.mark.parametrize("count", [3, 4, 5, 6])
def test_bars_all_round_are_found_however_they_are_turned(kind, count):
    for turn in turns(count):
        found, explained = spokes(sample(piece(count, turn, kind).mesh(), 1000).points)
        assert found.count == count and explained.mean() > 0.5
        assert (found.turn - turn) % (360 / count) == pytest.approx(0)
        np.testing.assert_allclose(
            [found.low, found.high], [piece(count, turn).low, piece(count, turn).high], atol=0.06
        )
        assert found.breadth == pytest.approx(0.08, abs=0.04)


def test_bars_that_reach_further_one_way_fill_an_ellipse():
    found, _ = spokes(sample(piece(4, 45.0, depth=0.6).mesh(), 1000).points)
    assert found.count == 4 and found.turn == 45.0
    np.testing.assert_allclose(found.size[[0, 2]], (1, 0.6), atol=0.1)


def test_what_is_not_all_round_has_no_spokes():
    legs = box((0.08, 0.6, 0.08), at=(0.4, 0, 0.3)).mirror("x", keep=True).mirror("z", keep=True)
    for solid in (legs, box((1, 0.05, 0.8)), cylinder((1, 0.05, 1)), box((1, 0.1, 0.1))):
        assert spokes(sample(solid.mesh(), 1000).points) is None


def test_spokes_under_a_post_leave_the_post():
    mesh = piece(5, -90.0).mesh()
    post = box((0.1, 0.7, 0.1)).mesh()
    points = np.concatenate([sample(mesh, 800).points, sample(post, 400).points])
    found = decompose(points, (0.0, 0.0), 1.0, radial=True)
    assert [piece.noun for piece in found[:2]] == ["spokes", "post"] and found[0].count == 5
    assert found[0].high[1] < -0.2
    assert decompose(sample(post, 400).points, (0.0, 0.0), 1.0, radial=True) == ()
