import numpy as np
import pytest
from scipy.spatial import cKDTree

from scanned import sampled
from shapewright.modelling.solids import box
from shapewright.references.scans.thinning import evened, thinned

POINTS = sampled(box((1.0, 0.4, 0.7)).mesh(), 50_000).positions


@pytest.mark.parametrize("most", [100, 2000, 20_000])
def test_nearly_as_many_points_as_asked_for_stay_and_no_more(most):
    rows = thinned(POINTS, most)
    assert 0.85 * most < len(rows) <= most
    assert (np.diff(rows) > 0).all()
    assert (thinned(POINTS, most) == rows).all()


def test_the_points_that_stay_are_spread_evenly_and_leave_no_gaps():
    kept = POINTS[thinned(POINTS, 2000)]
    drawn = POINTS[np.random.default_rng(0).permutation(len(POINTS))[: len(kept)]]
    gaps = [cKDTree(some).query(POINTS)[0].max() for some in (kept, drawn)]
    assert gaps[0] < 0.75 * gaps[1]


def test_thinning_evens_what_is_dense_in_places():
    dense = np.concatenate([POINTS, *[POINTS[POINTS[:, 0] > 0.0]] * 3])
    dense = dense + np.random.default_rng(0).normal(scale=1e-3, size=dense.shape)
    kept = dense[thinned(dense, 5000)]
    assert (kept[:, 0] > 0.0).mean() == pytest.approx(0.5, abs=0.05)


@pytest.mark.parametrize("far", [1e3, 1e6])
def test_one_point_far_away_does_not_make_all_others_one(far):
    rows = thinned(np.vstack([POINTS, [[far, 0.0, 0.0]]]), 5000)
    assert 1000 < len(rows) <= 5000


def test_few_points_stay_as_they_are():
    assert (thinned(POINTS[:100], 100) == np.arange(100)).all()
    assert (evened(POINTS[:3]) == np.arange(3)).all()


def test_points_of_even_density_stay_all():
    assert len(evened(POINTS)) == len(POINTS)


def test_where_points_are_much_denser_than_elsewhere_some_are_left_out():
    chance = np.where(POINTS[:, 0] > 0.0, 1.0, 0.03)
    uneven = POINTS[np.random.default_rng(1).random(len(POINTS)) < chance]
    kept = uneven[evened(uneven)]
    assert (kept[:, 0] <= 0.0).sum() > 0.75 * (uneven[:, 0] <= 0.0).sum()
    assert (kept[:, 0] > 0.0).sum() < 0.15 * (uneven[:, 0] > 0.0).sum()
