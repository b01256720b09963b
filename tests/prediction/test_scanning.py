import numpy as np
import pytest

from shapewright.modelling.solids import box
from shapewright.parameters import ParameterSpace, Scalar
from shapewright.prediction.dataset import make_dataset
from shapewright.prediction.scanning import Scanner, scanned, side_cameras
from shapewright.shapes import Mesh, Points

BOX = box((1.0, 0.6, 0.8)).mesh()


def scan(seed=0, sides=((0.0,), (30.0,)), **options):
    return Scanner(side_cameras(*sides), **options).scan(BOX, np.random.default_rng(seed))


def test_a_scan_holds_what_its_side_shows_and_nothing_else():
    points = scan(noise=0.0).positions
    before, above = np.abs(points[:, 2] - 0.4) < 1e-3, np.abs(points[:, 1] - 0.3) < 1e-3
    assert (before | above).all()
    assert before.any() and above.any()


def test_every_point_knows_its_sensor():
    points = scan(sides=((0.0, 90.0), (0.0, 0.0)))
    assert points.seen_from is not None
    front = points.seen_from[:, 2] > 1.0
    assert np.allclose(points.seen_from[front], [0.0, 0.0, 4.0])
    assert (np.abs(points.positions[front][:, 2] - 0.4) < 0.05).mean() > 0.999


def test_noise_count_and_seed_are_kept():
    noisy, plain = scan(noise=0.01, count=3000), scan(noise=0.0, count=3000)
    assert len(noisy) == len(plain) == 3000
    beside = np.min(np.abs(noisy.positions - [np.inf, 0.3, 0.4])[:, 1:], axis=1)
    assert 0.004 < beside.std() < 0.02
    assert (scan(seed=3).positions == scan(seed=3).positions).all()


def test_holes_leave_places_without_points_and_uneven_density_some_with_fewer():
    whole, holed = scan(count=10**6), scan(count=10**6, holes=3)
    assert len(holed) < 0.99 * len(whole)
    even, uneven = scan(count=4000), scan(count=4000, uneven=1.0)
    spread = [np.histogram(points.positions[:, 0], 4)[0] for points in (even, uneven)]
    assert np.ptp(spread[1]) > np.ptp(spread[0])


def test_a_mesh_that_nobody_sees_is_refused():
    flat = Mesh(np.array([[0.0, 0, 0], [1, 0, 0], [0, 0, 1]]), np.array([[0, 1, 2]]))
    with pytest.raises(ValueError, match="no camera"):
        Scanner(side_cameras((0.0,), (0.0,))).scan(flat, np.random.default_rng(0))


def test_a_share_of_the_samples_becomes_scans_with_their_own_pictures():
    space = ParameterSpace((Scalar("a", 0.0, 1.0, 0.5),))
    data = make_dataset(space, [{"a": i / 40} for i in range(40)], [BOX.normalised()] * 40)
    mixed = scanned(data, seed=1)
    as_points = np.array([isinstance(shape, Points) for shape in mixed.shapes])
    assert 20 < as_points.sum() < 40
    assert (mixed.images[~as_points] == data.images[~as_points]).all()
    assert all((a != b).any() for a, b in zip(mixed.images[as_points], data.images[as_points], strict=True))
    assert (scanned(data, seed=1).images == mixed.images).all()
    assert mixed.kind is Mesh
