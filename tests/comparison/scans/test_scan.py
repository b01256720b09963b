import numpy as np
import pytest

from shapewright.comparison.scans.scan import Scan
from shapewright.shapes import Points

RNG = np.random.default_rng(0)
PLANE = np.stack([RNG.uniform(-0.5, 0.5, 5000), np.zeros(5000), RNG.uniform(-0.5, 0.5, 5000)], axis=1)


def test_noise_beside_a_plane_is_found_and_taken_off():
    noisy = PLANE + np.random.default_rng(1).normal(scale=0.005, size=PLANE.shape)
    scan = Scan.of(Points(noisy))
    assert scan.noise == pytest.approx(0.005, rel=0.2)
    assert scan.positions[:, 1].std() < 0.4 * noisy[:, 1].std()


def test_the_points_that_are_kept_lie_evenly():
    uneven = np.concatenate([PLANE[PLANE[:, 0] < 0.0], PLANE[PLANE[:, 0] > 0.0][:600]])
    scan = Scan.of(Points(uneven))
    left = (scan.points[:, 0] < 0.0).mean()
    assert left < 0.75 < (uneven[:, 0] < 0.0).mean()
    assert len(scan.points) <= 1200


def test_its_start_normalises_the_points():
    scale, shift = Scan.of(Points(3.0 * PLANE + 1.0)).start
    placed = scale * (3.0 * PLANE + 1.0) + shift
    assert np.ptp(placed, axis=0).max() == pytest.approx(1.0, abs=0.01)


def test_sensors_are_told_apart():
    seen_from = np.where(PLANE[:, :1] < 0.0, [[0.0, 4.0, 0.0]], [[4.0, 1.0, 0.0]])
    places = Scan.of(Points(PLANE, seen_from=seen_from)).places
    assert sorted(map(tuple, places)) == [(0.0, 4.0, 0.0), (4.0, 1.0, 0.0)]
    assert Scan.of(Points(PLANE)).places is None


def test_too_few_points_are_refused():
    with pytest.raises(ValueError, match="too few"):
        Scan.of(Points(PLANE[:10]))
